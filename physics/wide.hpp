// The number type in which a precise simulation (lean.hpp) keeps its balls. Contacts are looked for
// in Real; what is found is refined, and balls move and collide, in Wide<Real>: for double the
// 80-bit long double of x86, whose eleven more bits keep a shot of many collisions exact to the
// last digits of a double at the cost of some eighty nanoseconds an event. Where long double is no
// wider (or is made of software, as binary128 is) double stays double.
#pragma once

#include <limits>
#include <type_traits>

#include "physics/ball.hpp"

namespace poolhall::physics {

template <class Real>
struct WideOf {
  using Type = Real;
};
template <>
struct WideOf<double> {
  using Type =
      std::conditional_t<std::numeric_limits<long double>::digits == 64, long double, double>;
};

template <class Real>
using Wide = typename WideOf<Real>::Type;

template <class To, class From>
[[nodiscard]] Vec2<To> converted(const Vec2<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y)};
}
template <class To, class From>
[[nodiscard]] Vec3<To> converted(const Vec3<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}
template <class To, class From>
[[nodiscard]] Ball<To> converted(const Ball<From>& b) {
  return {b.id,
          b.state,
          converted<To>(b.position),
          converted<To>(b.velocity),
          converted<To>(b.angular_velocity),
          b.pocket};
}

}  // namespace poolhall::physics
