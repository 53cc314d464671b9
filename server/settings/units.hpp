// The one place where units of settings files (seconds, millimetres) become those of the program.
#pragma once

#include <chrono>
#include <cmath>

namespace poolhall::settings {

[[nodiscard]] inline std::chrono::microseconds microseconds_of_seconds(double seconds) {
  return std::chrono::microseconds{std::llround(seconds * 1e6)};
}
[[nodiscard]] inline double seconds_of(std::chrono::microseconds duration) {
  return static_cast<double>(duration.count()) / 1e6;
}

[[nodiscard]] constexpr double metres_of_millimetres(double millimetres) {
  return millimetres / 1e3;
}
[[nodiscard]] constexpr double millimetres_of_metres(double metres) {
  return metres * 1e3;
}

}  // namespace poolhall::settings
