// Elementary functions made of + - * / and square roots only, so that every compiler, every
// optimisation level and every machine gets the same bits; within one ulp in double. For any
// floating type: float, double, long double, __float128, Boost.Multiprecision numbers.
//
//   Direction<double> d = direction_of_degrees(30.0);   // d.sine == 0.5
//
// The implementations are in math_double.hpp, math_extended.hpp and math_generic.hpp.
#pragma once

#include <type_traits>

#include "physics/math_double.hpp"
#include "physics/math_extended.hpp"
#include "physics/math_generic.hpp"

namespace poolhall::physics {

// Whether `Real` is the 80-bit number that has polynomials of its own.
template <class Real>
inline constexpr bool is_extended =
    std::is_same_v<Real, long double>&& extended_precision::is_available;

// pi, to the last bit of the type.
template <class Real>
[[nodiscard]] Real pi() {
  return sum_of_parts<Real>(pi_parts);
}

// Cosine and sine, exact at multiples of 90 degrees and, but for signs and order, the same at all
// mirror images of an angle, however large. Not a number for what is not finite.
template <class Real>
[[nodiscard]] Direction<Real> direction_of_degrees(const Real& degrees) {
  const ReducedDegrees<Real> reduced = reduced_degrees(degrees);
  if constexpr (std::is_same_v<Real, double>) {
    return turned(double_precision::small_angle(reduced.remainder), reduced);
  } else if constexpr (is_extended<Real>) {
    return turned(extended_precision::small_angle(reduced.remainder), reduced);
  } else {
    return turned(generic_precision::small_angle(reduced.remainder), reduced);
  }
}

template <class Real>
[[nodiscard]] Real exponential(const Real& x) {
  if constexpr (std::is_same_v<Real, double>) {
    return double_precision::exponential(x);
  } else if constexpr (is_extended<Real>) {
    return extended_precision::exponential(x);
  } else {
    return generic_precision::exponential(x);
  }
}

// x > 0 and finite.
template <class Real>
[[nodiscard]] Real natural_logarithm(const Real& x) {
  if constexpr (std::is_same_v<Real, double>) {
    return double_precision::natural_logarithm(x);
  } else {
    return generic_precision::natural_logarithm(x);
  }
}

// -1 <= x <= 1.
template <class Real>
[[nodiscard]] Real arc_sine(const Real& x) {
  if constexpr (std::is_same_v<Real, double>) {
    return double_precision::arc_sine(x);
  } else {
    return generic_precision::arc_sine(x);
  }
}

}  // namespace poolhall::physics
