#include "protocol/units.hpp"

#include <cmath>

#include "physics/noise_presets.hpp"

namespace poolhall::protocol {

physics::CueShot<double> to_physics(const ShotParams& params) {
  return physics::cue_shot(params);
}

std::optional<NoiseParams> noise_preset(std::string_view name) {
  for (const physics::NoisePreset& preset : physics::noise_presets()) {
    if (preset.name == name) {
      const ShotParams& d = preset.deviations;
      return NoiseParams{d.a, d.b, d.theta, d.phi, d.v};
    }
  }
  return std::nullopt;
}

NoiseParams scaled(const NoiseParams& noise, double factor) {
  return {noise.a * factor, noise.b * factor, noise.theta * factor, noise.phi * factor,
          noise.v * factor};
}

ShotParams with_noise(const ShotParams& intended, const NoiseParams& noise,
                      const physics::ShotDeviates& deviates) {
  return {intended.a + noise.a * deviates[0], intended.b + noise.b * deviates[1],
          intended.theta + noise.theta * deviates[2],
          std::fmod(intended.phi, 360.0) + noise.phi * deviates[3],
          intended.v + noise.v * deviates[4]};
}

ExecutedShot executed_shot(const ShotParams& intended, const NoiseParams& noise,
                           const physics::ShotDeviates& deviates,
                           const physics::BallSet<double>& balls, const physics::Table& table,
                           const physics::Materials& materials) {
  const physics::NearestShot nearest = physics::nearest_possible_shot(
      to_physics(with_noise(intended, noise, deviates)), balls, table, materials);
  // `given` is what the shot was made from, to the last bit: making it again gives the same shot.
  return {nearest.shot.given, nearest.moved};
}

}  // namespace poolhall::protocol
