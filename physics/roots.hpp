// Roots by +, -, *, / and sqrt only, so that every machine finds the same bits.
#pragma once

#include <cmath>
#include <limits>

namespace poolhall::physics {

// The real roots of q0 + q1 t + q2 t^2, ascending, without cancellation.
template <class Real>
struct QuadraticRoots {
  Real first{};
  Real second{};
  int count = 0;
};

template <class Real>
[[nodiscard]] QuadraticRoots<Real> quadratic_roots(const Real& q0, const Real& q1, const Real& q2) {
  using std::sqrt;
  if (q2 == Real(0)) {
    if (q1 == Real(0)) {
      return {};
    }
    const Real only = -q0 / q1;
    return {only, only, 1};
  }
  const Real discriminant = q1 * q1 - Real(4) * q2 * q0;
  if (discriminant < Real(0)) {
    return {};
  }
  const Real root = sqrt(discriminant);
  const Real sum = q1 < Real(0) ? Real(root - q1) : Real(-root - q1);
  const Real one = sum / (Real(2) * q2);
  const Real other = sum != Real(0) ? Real(Real(2) * q0 / sum) : one;
  return one < other ? QuadraticRoots<Real>{one, other, 2} : QuadraticRoots<Real>{other, one, 2};
}

// The first t >= 0 at which gap(t) = gap + speed t + acceleration t^2 / 2 is <= 0 and shrinking,
// or shrinks next; `forever` if there is none. A gap that is closed and opening is no event.
template <class Real>
[[nodiscard]] Real first_closing(const Real& gap, const Real& speed, const Real& acceleration,
                                 const Real& none) {
  using std::sqrt;
  const bool closing = speed < Real(0) || (speed == Real(0) && acceleration < Real(0));
  if (gap <= Real(0) && closing) {
    return Real(0);
  }
  if (!closing && acceleration >= Real(0)) {
    return none;
  }
  const Real discriminant = speed * speed - Real(2) * acceleration * gap;
  if (closing) {
    return discriminant >= Real(0) ? Real(Real(2) * gap / (sqrt(discriminant) - speed)) : none;
  }
  if (discriminant <= Real(0)) {
    return speed / -acceleration;
  }
  return (speed + sqrt(discriminant)) / -acceleration;
}

// One step of Newton's from a root that is right but for rounding; where the slope is so small that
// the step is not, the root stays.
template <class Real>
[[nodiscard]] Real nearer_root(const Real& t, const Real& value, const Real& slope) {
  using std::abs;
  if (slope == Real(0)) {
    return t;
  }
  const Real step = value / slope;
  const Real next = t - step;
  return abs(step) <= Real(1e-9) && next > Real(0) ? next : t;
}

// A root of `value` between `low` and `high`, where its sign differs; `slope` is its derivative.
// Newton's steps, halving where they leave the bracket or shrink too slowly.
template <class Real, class Value, class Slope>
[[nodiscard]] Real bracketed_root(const Value& value, const Slope& slope, Real low, Real high) {
  using std::abs;
  const bool rising = value(low) < Real(0);
  Real at = low;
  Real previous_step = high - low;
  // Each halving gives a bit, and Newton's steps only replace those that would give less; it takes
  // 1200 halvings to come from the last time of all (instant.hpp) to 1e-300 s.
  const int bound = 4 * std::numeric_limits<Real>::digits + 1500;
  for (int i = 0; i < bound; ++i) {
    const Real here = value(at);
    if (here == Real(0)) {
      return at;
    }
    ((here < Real(0)) == rising ? low : high) = at;
    const Real derivative = slope(at);
    Real next = derivative != Real(0) ? Real(at - here / derivative) : low;
    const Real step = next - at;
    if (!(next > low && next < high) || abs(step) > previous_step / Real(2)) {
      next = low + (high - low) / Real(2);
    }
    if (next == at || next <= low || next >= high) {
      return at;
    }
    if (abs(next - at) <= std::numeric_limits<Real>::epsilon() * abs(at)) {
      return next;
    }
    previous_step = abs(next - at);
    at = next;
  }
  return at;
}

}  // namespace poolhall::physics
