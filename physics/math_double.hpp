// What math.hpp is made of in double: arguments and constants in two doubles where one would cost
// bits, Taylor polynomials, the leading terms added last. Within one ulp.
// Include math.hpp instead.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "physics/math_generic.hpp"

namespace poolhall::physics::double_precision {

// An unevaluated sum; |low| is at most half an ulp of high.
struct TwoDoubles {
  double high = 0;
  double low = 0;
};

// Knuth's sum without error.
[[nodiscard]] constexpr TwoDoubles two_sum(double p, double q) {
  const double sum = p + q;
  const double q_part = sum - p;
  return {sum, (p - (sum - q_part)) + (q - q_part)};
}

// Dekker's product without error, for factors below 1e290.
[[nodiscard]] constexpr TwoDoubles two_product(double p, double q) {
  constexpr double splitter = 0x1p27 + 1;
  const double p_shift = splitter * p;
  const double q_shift = splitter * q;
  const double p_high = p_shift - (p_shift - p);
  const double q_high = q_shift - (q_shift - q);
  const double p_low = p - p_high;
  const double q_low = q - q_high;
  const double product = p * q;
  return {product, ((p_high * q_high - product) + p_high * q_low + p_low * q_high) + p_low * q_low};
}

template <std::size_t n>
[[nodiscard]] constexpr double polynomial(const std::array<double, n>& coefficients, double x) {
  double sum = coefficients[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    sum = sum * x + coefficients[i];
  return sum;
}

// sin(x + y) for |x| <= pi / 4 and y below an ulp of x.
[[nodiscard]] constexpr double sine_kernel(double x, double y) {
  // -1/3!, 1/5!, ... -1/19!
  constexpr std::array<double, 9> series{-1.0 / 6,
                                         1.0 / 120,
                                         -1.0 / 5040,
                                         1.0 / 362880,
                                         -1.0 / 39916800,
                                         1.0 / 6227020800.0,
                                         -1.0 / 1307674368000.0,
                                         1.0 / 355687428096000.0,
                                         -1.0 / 121645100408832000.0};
  const double z = x * x;
  return x + (x * z * polynomial(series, z) + y * (1 - z / 2));
}

// cos(x + y) for |x| <= pi / 4 and y below an ulp of x.
[[nodiscard]] constexpr double cosine_kernel(double x, double y) {
  // 1/4!, -1/6!, ... 1/20!
  constexpr std::array<double, 9> series{1.0 / 24,
                                         -1.0 / 720,
                                         1.0 / 40320,
                                         -1.0 / 3628800,
                                         1.0 / 479001600,
                                         -1.0 / 87178291200.0,
                                         1.0 / 20922789888000.0,
                                         -1.0 / 6402373705728000.0,
                                         1.0 / 2432902008176640000.0};
  // x^2 / 2 without error: its rounding alone would be a quarter of an ulp of the cosine.
  const TwoDoubles square = two_product(x, x);
  const double half = square.high / 2;
  const double rest = square.high * square.high * polynomial(series, square.high);
  const double lead = 1 - half;
  return lead + (((1 - lead) - half) + (rest - (square.low / 2 + x * y)));
}

// |degrees| <= 45.
[[nodiscard]] inline Direction<double> small_angle(double degrees) {
  if (degrees == 45 || degrees == -45) {
    const double half_root = std::sqrt(0.5);
    return {half_root, degrees < 0 ? -half_root : half_root};
  }
  // pi / 180 in two doubles.
  constexpr TwoDoubles degree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
  const TwoDoubles product = two_product(degrees, degree.high);
  const TwoDoubles angle = two_sum(product.high, product.low + degrees * degree.low);
  return {cosine_kernel(angle.high, angle.low), sine_kernel(angle.high, angle.low)};
}

// 2^k for -1022 <= k <= 1023.
[[nodiscard]] constexpr double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

// ln 2: `high` has 31 bits, so that its product with any exponent is exact.
inline constexpr TwoDoubles ln2{0x1.62e42fee00000p-1, 0x1.a39ef35793c76p-33};

[[nodiscard]] constexpr double exponential(double x) {
  if (x != x)
    return x;
  if (x > 709.79)
    return std::numeric_limits<double>::infinity();
  if (x < -745.2)
    return 0;
  // 1/2!, 1/3!, ... 1/15!
  constexpr std::array<double, 14> series{1.0 / 2,
                                          1.0 / 6,
                                          1.0 / 24,
                                          1.0 / 120,
                                          1.0 / 720,
                                          1.0 / 5040,
                                          1.0 / 40320,
                                          1.0 / 362880,
                                          1.0 / 3628800,
                                          1.0 / 39916800,
                                          1.0 / 479001600,
                                          1.0 / 6227020800.0,
                                          1.0 / 87178291200.0,
                                          1.0 / 1307674368000.0};
  const int k = static_cast<int>(x * 0x1.71547652b82fep0 + (x < 0 ? -0.5 : 0.5));
  const double high = x - k * ln2.high;
  const TwoDoubles rest = two_sum(high, -k * ln2.low);
  const double curve = rest.high * rest.high * polynomial(series, rest.high);
  const TwoDoubles lead = two_sum(1, rest.high);
  const double value = lead.high + (lead.low + (curve + (rest.low + rest.low * rest.high)));
  // In two factors, so that neither leaves the range before the product does.
  const int half = k / 2;
  return value * power_of_two(half) * power_of_two(k - half);
}

[[nodiscard]] constexpr double natural_logarithm(double x) {
  // x = 2^k m with m in about [0.7, 1.41].
  const bool is_subnormal = x < 0x1p-1022;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(is_subnormal ? x * 0x1p54 : x);
  int k = static_cast<int>(bits >> 52) - 1023 - (is_subnormal ? 54 : 0);
  double m = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  if (m > 1.4142135623730951) {
    m /= 2;
    ++k;
  }
  // With s = f / (2 + f): log(1 + f) = 2 artanh s = f - (f^2 / 2 - s (f^2 / 2 + R)),
  // R = 2 s^2 / 3 + 2 s^4 / 5 + ...
  constexpr std::array<double, 11> series{2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,
                                          2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17,
                                          2.0 / 19, 2.0 / 21, 2.0 / 23};
  const double f = m - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  const double half_square = f * f / 2;
  const double r = z * polynomial(series, z);
  const double low = s * (half_square + r) + k * ln2.low;
  return k * ln2.high - ((half_square - low) - f);
}

[[nodiscard]] inline double arc_sine(double x) {
  const double size = std::abs(x);
  const bool is_large = size > 0.5;
  // Above 1/2: asin x = pi / 2 - 2 asin t, t = sqrt((1 - x) / 2), in two doubles.
  const double square = is_large ? (1 - size) / 2 : size * size;
  const double t = is_large ? std::sqrt(square) : size;
  double sum = 0;
  double term = 0.5;
  // asin t = t + t^3 (1/6 + 3/40 t^2 + ...)
  std::array<double, 28> coefficients{};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double n = 2.0 * static_cast<double>(i) + 1;
    coefficients[i] = term / (n + 2);
    term = term * (n + 2) / (n + 3);
  }
  sum = t * square * polynomial(coefficients, square);
  if (!is_large)
    return x < 0 ? -(t + sum) : t + sum;
  const TwoDoubles root_square = two_product(t, t);
  const double missing = t > 0 ? ((square - root_square.high) - root_square.low) / (2 * t) : 0.0;
  constexpr TwoDoubles half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  const TwoDoubles lead = two_sum(half_pi.high, -2 * t);
  const double angle = lead.high + (lead.low + (half_pi.low - 2 * (sum + missing)));
  return x < 0 ? -angle : angle;
}

}  // namespace poolhall::physics::double_precision
