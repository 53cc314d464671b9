#include "physics/number_check.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace poolhall::physics {

std::string decimal(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

Expected<void> check_number(const CheckedNumber& number) {
  const double value = number.value;
  if (!std::isfinite(value)) {
    return tl::unexpected(Error{Fault::not_finite, std::string(number.field),
                                "got " + decimal(value) + ", expected a finite number"});
  }
  const Bound& low = number.lowest;
  const Bound& high = number.highest;
  const bool is_high_enough = low.is_included ? value >= low.value : value > low.value;
  const bool is_low_enough = high.is_included ? value <= high.value : value < high.value;
  if (is_high_enough && is_low_enough)
    return {};
  return tl::unexpected(Error{
      Fault::out_of_range, std::string(number.field),
      "got " + decimal(value) + ", expected a number " + (low.is_included ? "from " : "above ") +
          decimal(low.value) + (high.is_included ? " to " : " and below ") + decimal(high.value)});
}

Expected<void> check_all(std::initializer_list<CheckedNumber> numbers) {
  for (const CheckedNumber& number : numbers) {
    if (Expected<void> checked = check_number(number); !checked)
      return checked;
  }
  return {};
}

}  // namespace poolhall::physics
