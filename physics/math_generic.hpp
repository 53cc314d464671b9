// What math.hpp is made of for every floating type: square root, constants, the exact reduction
// of angles, and series that run until they no longer change the sum.
// Include math.hpp instead.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace poolhall::physics {

// A unit vector in a plane: cosine and sine of one angle.
template <class Real>
struct Direction {
  Real cosine{1};
  Real sine{0};
};

template <class Real>
[[nodiscard]] Real square_root(const Real& x) {
  using std::sqrt;
  return sqrt(x);
}

#ifdef __SIZEOF_FLOAT128__
__extension__ using Float128 = __float128;

// The standard library has no square root of this type: one of 64 bits, and a Newton step.
template <>
[[nodiscard]] inline Float128 square_root<Float128>(const Float128& x) {
  const long double estimate = std::sqrt(static_cast<long double>(x));
  if (!(estimate > 0))
    return static_cast<Float128>(estimate);
  const Float128 root = static_cast<Float128>(estimate);
  return root + (x - root * root) / (root + root);
}
#endif

template <class Real>
[[nodiscard]] Real absolute(const Real& x) {
  return x < Real(0) ? Real(-x) : x;
}

// pi and ln 2 as sums of doubles, each the rounded rest: 140 digits.
inline constexpr std::array<double, 9> pi_parts{
    0x1.921fb54442d18p+1,   0x1.1a62633145c07p-53,  -0x1.f1976b7ed8fbcp-109,
    0x1.4cf98e804177dp-163, 0x1.31d89cd9128a5p-217, 0x1.0f31c6809bbdfp-275,
    0x1.519b3cd3a431bp-330, 0x1.8158536f92f8ap-385, 0x1.ba7f09ab6b6a9p-441};
inline constexpr std::array<double, 9> ln2_parts{
    0x1.62e42fefa39efp-1,    0x1.abc9e3b39803fp-56,   0x1.7b57a079a1934p-111,
    -0x1.ace93a4ebe5d1p-165, -0x1.23a2a82ea0c24p-219, 0x1.d881b7aeb2615p-274,
    0x1.9552fb4afa1b1p-328,  0x1.da5d5c6b82704p-385,  0x1.4427573b29117p-440};

template <class Real>
[[nodiscard]] Real sum_of_parts(const std::array<double, 9>& parts) {
  if constexpr (std::is_same_v<Real, float> || std::is_same_v<Real, double>) {
    return static_cast<Real>(parts[0]);
  } else {
    Real sum(0);
    for (std::size_t i = parts.size(); i-- > 0;)
      sum = sum + Real(parts[i]);
    return sum;
  }
}

// degrees = remainder + 90 quarter (mod 360), or its negative where `negative`;
// |remainder| <= 45. No rounding anywhere.
template <class Real>
struct ReducedDegrees {
  Real remainder{};
  int quarter = 0;
  Real sign{1};
};

template <class Real>
[[nodiscard]] ReducedDegrees<Real> reduced_degrees(const Real& degrees) {
  ReducedDegrees<Real> reduced;
  reduced.sign = degrees < Real(0) ? Real(-1) : Real(1);
  Real rest = absolute(degrees);
  if (!(rest - rest == Real(0)))
    return {rest - rest, 0, Real(1)};
  // Long division in binary: whatever is subtracted is at least half of what it is taken from.
  Real step(360);
  while (step <= rest / Real(2))
    step = step + step;
  for (; step >= Real(360); step = step / Real(2)) {
    if (rest >= step)
      rest = rest - step;
  }
  while (rest >= Real(45)) {
    rest = rest - Real(90);
    ++reduced.quarter;
  }
  reduced.remainder = rest;
  return reduced;
}

// The direction `small` of the remainder, turned back to the whole angle.
template <class Real>
[[nodiscard]] Direction<Real> turned(const Direction<Real>& small,
                                     const ReducedDegrees<Real>& reduced) {
  Direction<Real> whole = small;
  switch (reduced.quarter % 4) {
    case 1:
      whole = {-small.sine, small.cosine};
      break;
    case 2:
      whole = {-small.cosine, -small.sine};
      break;
    case 3:
      whole = {small.sine, -small.cosine};
      break;
    default:
      break;
  }
  // Adding zero turns -0 into 0.
  return {whole.cosine + Real(0), reduced.sign * whole.sine + Real(0)};
}

namespace generic_precision {

// |degrees| <= 45.
template <class Real>
[[nodiscard]] Direction<Real> small_angle(const Real& degrees) {
  // Both of 45 degrees from one root, so that mirror images agree.
  if (absolute(degrees) == Real(45)) {
    const Real half_root = square_root(Real(Real(1) / Real(2)));
    return {half_root, degrees < Real(0) ? Real(-half_root) : half_root};
  }
  const Real x = degrees * sum_of_parts<Real>(pi_parts) / Real(180);
  const Real square = x * x;
  Real sine(0);
  Real cosine(0);
  Real sine_term = x;
  Real cosine_term(1);
  // Every term is less than a third of the one before: 300 are enough for 140 digits.
  for (int n = 1; n < 600; n += 2) {
    const Real next_sine = sine + sine_term;
    const Real next_cosine = cosine + cosine_term;
    if (next_sine == sine && next_cosine == cosine)
      break;
    sine = next_sine;
    cosine = next_cosine;
    cosine_term = -cosine_term * square / Real(n * (n + 1));
    sine_term = -sine_term * square / Real((n + 1) * (n + 2));
  }
  return {cosine, sine};
}

// 2^k x by repeated exact multiplication.
template <class Real>
[[nodiscard]] Real scaled_by_power(Real x, int k) {
  const Real factor = k < 0 ? Real(Real(1) / Real(2)) : Real(2);
  for (int i = k < 0 ? -k : k; i > 0; --i)
    x = x * factor;
  return x;
}

template <class Real>
[[nodiscard]] Real exponential(const Real& x) {
  if (x != x)
    return x;
  // Beyond the range of every built-in type.
  const Real bound(12000);
  const Real y = x > bound ? bound : (x < -bound ? Real(-bound) : x);
  const Real ln2 = sum_of_parts<Real>(ln2_parts);
  const Real quotient = y / ln2;
  const int k = static_cast<int>(quotient + (y < Real(0) ? Real(-0.5) : Real(0.5)));
  const Real rest = y - Real(k) * ln2;
  Real sum(0);
  Real term(1);
  for (int n = 1; n < 600; ++n) {
    const Real next = sum + term;
    if (next == sum)
      break;
    sum = next;
    term = term * rest / Real(n);
  }
  return scaled_by_power(sum, k);
}

template <class Real>
[[nodiscard]] Real natural_logarithm(const Real& x) {
  int k = 0;
  Real m = x;
  for (; m > Real(1.5); m = m / Real(2))
    ++k;
  for (; m < Real(0.75); m = m * Real(2))
    --k;
  // log m = 2 artanh s.
  const Real s = (m - Real(1)) / (m + Real(1));
  const Real square = s * s;
  Real sum(0);
  Real power = s;
  for (int n = 1; n < 600; n += 2) {
    const Real next = sum + power / Real(n);
    if (next == sum)
      break;
    sum = next;
    power = power * square;
  }
  return Real(k) * sum_of_parts<Real>(ln2_parts) + Real(2) * sum;
}

template <class Real>
[[nodiscard]] Real arc_sine(const Real& x) {
  const Real size = absolute(x);
  const bool is_large = size > Real(0.5);
  const Real t = is_large ? square_root(Real((Real(1) - size) / Real(2))) : size;
  const Real square = t * t;
  Real sum(0);
  Real term = t;
  for (int n = 1; n < 1200; n += 2) {
    const Real next = sum + term / Real(n);
    if (next == sum)
      break;
    sum = next;
    term = term * square * Real(n) / Real(n + 1);
  }
  const Real angle = is_large ? Real(sum_of_parts<Real>(pi_parts) / Real(2) - Real(2) * sum) : sum;
  return x < Real(0) ? Real(-angle) : angle;
}

}  // namespace generic_precision
}  // namespace poolhall::physics
