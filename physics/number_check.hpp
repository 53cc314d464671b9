// Checks lists of numbers against their ranges; the first that fails is the error.
//
//   return check_all({{"/mu_slide", m.mu_slide, at_least(0), at_most(1e9)}, ...});
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "physics/expected.hpp"

namespace poolhall::physics {

struct Bound {
  double value = 0;
  bool is_included = true;
};
[[nodiscard]] constexpr Bound at_least(double value) {
  return {value, true};
}
[[nodiscard]] constexpr Bound above(double value) {
  return {value, false};
}
[[nodiscard]] constexpr Bound at_most(double value) {
  return {value, true};
}
[[nodiscard]] constexpr Bound below(double value) {
  return {value, false};
}

struct CheckedNumber {
  std::string_view field;  // JSON Pointer
  double value = 0;
  Bound lowest;
  Bound highest;
};

// Fault::not_finite or Fault::out_of_range.
[[nodiscard]] Expected<void> check_number(const CheckedNumber& number);
[[nodiscard]] Expected<void> check_all(std::initializer_list<CheckedNumber> numbers);

// The shortest decimal that reads back as `value`, "nan", "inf" or "-inf".
[[nodiscard]] std::string decimal(double value);

}  // namespace poolhall::physics
