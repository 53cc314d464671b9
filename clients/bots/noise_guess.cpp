#include "clients/bots/noise_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace poolhall::bots {
namespace {

constexpr std::size_t parameters = 5;
constexpr std::size_t enough_shots = 3;  // for the shots alone to tell

// The squares of the five errors, each in standard deviations of the Olympiad's noise.
double squares(const client::SeenShot& shot, const protocol::NoiseParams& unit) {
  const auto& p = shot.intended;
  const auto& q = shot.executed;
  const std::array<double, parameters> errors{(q.a - p.a) / unit.a, (q.b - p.b) / unit.b,
                                              (q.theta - p.theta) / unit.theta,
                                              (q.phi - p.phi) / unit.phi, (q.v - p.v) / unit.v};
  double sum = 0;
  for (const double error : errors) {
    sum += error * error;
  }
  return sum;
}

}  // namespace

protocol::NoiseParams guessed_noise(std::span<const client::SeenShot> shots) {
  const auto unit = protocol::noise_preset("olympiad").value();
  double sum = 0;
  std::size_t count = 0;
  for (const auto& shot : shots) {
    if (!shot.moved) {
      sum += squares(shot, unit);
      ++count;
    }
  }
  if (count < enough_shots) {
    sum += parameters;
    ++count;
  }
  return protocol::scaled(unit, std::sqrt(sum / static_cast<double>(count * parameters)));
}

}  // namespace poolhall::bots
