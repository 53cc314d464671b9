// The noise levels of config/noise, compiled in. For use through preset_noise (noise.hpp).
#pragma once

#include <string>
#include <vector>

#include "physics/cue_strike.hpp"

namespace poolhall::physics {

struct NoisePreset {
  std::string name;
  ShotParameters<double> deviations;  // mm, degrees, m/s
};

[[nodiscard]] std::vector<NoisePreset> noise_presets();

}  // namespace poolhall::physics
