// Shots in the wire's units (mm, degrees, m/s) and the one place where they become SI.
//
// An executed shot is authoritative in the wire's units: noise is added there, so that whoever
// simulates the executed parameters of a stored shot gets the same bits.
//
//   ExecutedShot executed =
//       executed_shot(intended, noise, deviates, balls, table, materials);
//   physics::CueShot<double> strike = to_physics(executed.params);
#pragma once

#include <optional>
#include <string_view>

#include "physics/cue_strike.hpp"
#include "physics/noise.hpp"

namespace poolhall::protocol {

// a, b in mm, theta, phi in degrees, v in m/s.
using ShotParams = physics::ShotParameters<double>;

// Standard deviations, in the same units.
struct NoiseParams {
  double a = 0;
  double b = 0;
  double theta = 0;
  double phi = 0;
  double v = 0;

  friend bool operator==(const NoiseParams&, const NoiseParams&) = default;
};

[[nodiscard]] physics::CueShot<double> to_physics(const ShotParams& params);

// none, low, olympiad, high.
[[nodiscard]] std::optional<NoiseParams> noise_preset(std::string_view name);
[[nodiscard]] NoiseParams scaled(const NoiseParams& noise, double factor);

// Without phi's whole turns, exactly: beyond 2^50 degrees noise would be lost in rounding.
[[nodiscard]] ShotParams with_noise(const ShotParams& intended, const NoiseParams& noise,
                                    const physics::ShotDeviates& deviates);

// What is played of what was intended. `balls` has the cue ball where it will be struck.
struct ExecutedShot {
  ShotParams params;
  bool moved = false;  // noise had made it impossible: moved to the nearest possible shot
};
[[nodiscard]] ExecutedShot executed_shot(const ShotParams& intended, const NoiseParams& noise,
                                         const physics::ShotDeviates& deviates,
                                         const physics::BallSet<double>& balls,
                                         const physics::Table& table,
                                         const physics::Materials& materials);

}  // namespace poolhall::protocol
