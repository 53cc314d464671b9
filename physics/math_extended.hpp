// What math.hpp is made of in the 80-bit long double of x86: Taylor polynomials of fixed length,
// within about one ulp. A precise simulation's cue strike spends most of its time here, so that the
// series of math_generic.hpp with their divisions would cost as much as two collisions.
// Include math.hpp instead.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "physics/math_generic.hpp"

namespace poolhall::physics::extended_precision {

// Whether long double has the 64 bits that the polynomials below are long enough for.
inline constexpr bool is_available = std::numeric_limits<long double>::digits == 64;

// sign^i / (first * (first + 1) ... (first + step i)!), the coefficients of a Taylor series.
template <std::size_t n>
[[nodiscard]] constexpr std::array<long double, n> inverse_factorials(int first, int step,
                                                                      long double sign) {
  std::array<long double, n> series{};
  long double factorial = 1;  // exact up to 25!
  int reached = 1;
  long double alternating = 1;
  for (std::size_t i = 0; i < n; ++i) {
    for (const int wanted = first + step * static_cast<int>(i); reached < wanted;)
      factorial *= static_cast<long double>(++reached);
    series[i] = alternating / factorial;
    alternating *= sign;
  }
  return series;
}

template <std::size_t n>
[[nodiscard]] constexpr long double polynomial(const std::array<long double, n>& coefficients,
                                               long double x) {
  long double sum = coefficients[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    sum = sum * x + coefficients[i];
  return sum;
}

// |degrees| <= 45.
[[nodiscard]] inline Direction<long double> small_angle(long double degrees) {
  if (degrees == 45 || degrees == -45) {
    const long double half_root = square_root(0.5L);
    return {half_root, degrees < 0 ? -half_root : half_root};
  }
  constexpr long double degree = 0x1.1df46a2529d3915c1d8becdd290cp-6L;  // pi / 180
  // 1/3! - x^2/5! + ... x^18/21! and 1/2! - x^2/4! + ... x^18/20!, to 2^-70 at pi / 4.
  constexpr auto sine_series = inverse_factorials<10>(3, 2, -1);
  constexpr auto cosine_series = inverse_factorials<10>(2, 2, -1);
  const long double x = degrees * degree;
  const long double z = x * x;
  return {1 - z * polynomial(cosine_series, z), x - x * (z * polynomial(sine_series, z))};
}

[[nodiscard]] inline long double exponential(long double x) {
  if (x != x)
    return x;
  if (x > 11400)
    return std::numeric_limits<long double>::infinity();
  if (x < -11400)
    return 0;
  // `high` has 32 bits, so that its product with any exponent is exact.
  constexpr long double ln2_high = 0x1.62e42ffp-1L;
  constexpr long double ln2_low = -0x1.718432a1b0e2633fe0684a85f866p-35L;
  constexpr auto series = inverse_factorials<16>(2, 1, 1);  // to 2^-72 at ln 2 / 2
  const int k = static_cast<int>(x * 1.4426950408889634074L + (x < 0 ? -0.5L : 0.5L));
  const long double scale = static_cast<long double>(k);
  const long double rest = (x - scale * ln2_high) - scale * ln2_low;
  const long double value = 1 + (rest + rest * rest * polynomial(series, rest));
  return generic_precision::scaled_by_power(value, k);
}

}  // namespace poolhall::physics::extended_precision
