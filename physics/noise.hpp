// Gaussian noise on the five parameters of a shot, and the standard normal deviates it needs.
//
//   CueShot<double> executed = with_noise(intended, *preset_noise("olympiad"), deviates);
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "physics/cue_strike.hpp"

namespace poolhall::physics {

// Standard deviations. On the wire and in files a, b are mm and theta, phi degrees.
struct NoiseLevel {
  double a = 0;      // m
  double b = 0;      // m
  double theta = 0;  // rad
  double phi = 0;    // rad
  double speed = 0;  // m/s
};

// none, low, olympiad, high. (`variable` is a factor on olympiad, drawn per game by the server.)
[[nodiscard]] std::optional<NoiseLevel> preset_noise(std::string_view name);

[[nodiscard]] NoiseLevel scaled(const NoiseLevel& level, double factor);

// Standard normal deviates for a, b, theta, phi, speed, in this order.
using ShotDeviates = std::array<double, 5>;

// `intended` with noise added in millimetres and degrees, so that `given` of the result is exactly
// what is played; may be an impossible shot (nearest_possible_shot).
[[nodiscard]] CueShot<double> with_noise(const CueShot<double>& intended, const NoiseLevel& level,
                                         const ShotDeviates& deviates);

// Inverse of the standard normal distribution function, Wichura 1988, algorithm AS 241
// (PPND16), with the project's own logarithm; 0 < p < 1.
[[nodiscard]] double normal_quantile(double p);

// The uniform deviate in (0, 1) of 64 random bits: ((bits >> 11) + 0.5) * 2^-53,
// and 1 - 2^-53 where that rounds to 1.
[[nodiscard]] double uniform_deviate(std::uint64_t bits);

}  // namespace poolhall::physics
