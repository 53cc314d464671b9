// The one place where units of settings files (seconds, millimetres) become those of the program.
#pragma once

#include <chrono>
#include <cmath>
#include <string_view>

namespace poolhall::settings {

struct PlainUnit {
  using Value = double;
  static constexpr std::string_view words = "a number";
  [[nodiscard]] static constexpr Value from_file(double number) { return number; }
  [[nodiscard]] static constexpr double to_file(Value value) { return value; }
};

struct SecondsUnit {
  using Value = std::chrono::microseconds;
  static constexpr std::string_view words = "seconds, a number";
  [[nodiscard]] static Value from_file(double seconds) {
    return Value{std::llround(seconds * 1e6)};
  }
  [[nodiscard]] static constexpr double to_file(Value value) {
    return static_cast<double>(value.count()) / 1e6;
  }
};

// Metres in the program.
struct MillimetresUnit {
  using Value = double;
  static constexpr std::string_view words = "millimetres, a number";
  [[nodiscard]] static constexpr Value from_file(double millimetres) { return millimetres / 1e3; }
  [[nodiscard]] static constexpr double to_file(Value metres) { return metres * 1e3; }
};

}  // namespace poolhall::settings
