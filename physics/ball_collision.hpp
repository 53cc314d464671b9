// Two balls of equal mass meet: momentum, angular momentum and Coulomb friction (Marlow) with
// the stick limit made explicit; physics.md 4. Resolves, never searches.
//
//   collide(first, second, c, friction);  // both balls right after the impact
#pragma once

#include <utility>

#include "physics/ball_friction.hpp"
#include "physics/lean.hpp"
#include "physics/motion.hpp"

namespace poolhall::physics {

// The unit vector from the centre of `first` to that of `second`.
template <class Real>
[[nodiscard]] Vec2<Real> contact_normal(const Vec2<Real>& first, const Vec2<Real>& second) {
  const Vec2<Real> d = second - first;
  return (Real(1) / length(d)) * d;
}

// The slip of `first` over `second` at their contact without its normal part, three-dimensional:
// s = (v1 - v2) - g n + R (w1 + w2) x n. `t` is n turned left, so that s = along t + up k.
template <class Real>
struct ContactSlip {
  Real along{};
  Real up{};
};
template <class Real>
[[nodiscard]] ContactSlip<Real> contact_slip(const Ball<Real>& first, const Ball<Real>& second,
                                             const Vec2<Real>& n, const Real& radius) {
  const Vec2<Real> v = first.velocity - second.velocity;
  const Vec3<Real> w = first.angular_velocity + second.angular_velocity;
  return {(v.y * n.x - v.x * n.y) + radius * w.z, radius * (w.x * n.y - w.y * n.x)};
}

// Takes the friction impulse of the normal impulse `normal` (per mass) from both balls, for the
// slip s before the impact: Jt = min(mu_b(|s|) Jn, m |s| / 7), against s on the first ball and
// along it on the second; both w change by -(5 Jt / (2 m R)) (n x s^).
template <class Real>
void rub(Ball<Real>& first, Ball<Real>& second, const Vec2<Real>& n, const Real& normal,
         const ContactSlip<Real>& s, const Coefficients<Real>& c, const BallFriction& friction) {
  const Real speed = length(Vec2<Real>{s.along, s.up});
  if (!(speed > Real(0))) {
    return;
  }
  const Real sliding = ball_friction_coefficient(friction, speed) * normal;
  const Real sticking = speed / Real(7);
  const Real impulse = sliding < sticking ? sliding : sticking;
  const Real along = impulse * (s.along / speed);
  const Real up = impulse * (s.up / speed);
  // With t = k x n: s^ = along t + up k, and n x t = k, n x k = -t.
  const Vec2<Real> push{-along * n.y, along * n.x};
  const Vec3<Real> twist{c.lever * up * n.y, -(c.lever * up * n.x), c.lever * along};
  first.velocity = first.velocity - push;
  second.velocity = second.velocity + push;
  first.angular_velocity = first.angular_velocity - twist;
  second.angular_velocity = second.angular_velocity - twist;
}

[[nodiscard]] inline bool has_friction(const BallFriction& friction) {
  const auto* constant = std::get_if<ConstantFriction>(&friction);
  return constant == nullptr || constant->coefficient > 0;
}

template <class Real>
struct Impact {
  Real closing{};       // m/s, along the normal before the impact
  bool raised = false;  // the separation speed was more than the model's
};

// Gives both balls the velocities that they have right after their impact; they leave each other
// at the separation speed at least, and friction comes from the impulse so raised.
template <class Policy = Lean, class Real>
[[nodiscard]] Impact<Real> strike_together(Ball<Real>& first, Ball<Real>& second,
                                           const Coefficients<Real>& c,
                                           const BallFriction& friction) {
  const Vec2<Real> n = contact_normal(first.position, second.position);
  const Real closing = dot(first.velocity - second.velocity, n);
  const Real leaving = c.restitution * closing;
  const bool raised = leaving < c.separation_speed;
  const Real normal = (closing + (raised ? c.separation_speed : leaving)) / Real(2);
  const bool rubs = !Policy::omits(Omission::ball_friction) || has_friction(friction);
  const ContactSlip<Real> slip =
      rubs ? contact_slip(first, second, n, c.radius) : ContactSlip<Real>{};
  const Vec2<Real> push = normal * n;
  first.velocity = first.velocity - push;
  second.velocity = second.velocity + push;
  if (rubs) {
    rub(first, second, n, normal, slip, c, friction);
  }
  settle(first, c.radius);
  settle(second, c.radius);
  return {closing, raised};
}

template <class Real>
struct PairAfter {
  Ball<Real> first;
  Ball<Real> second;
  Impact<Real> impact;
};

template <class Real>
[[nodiscard]] PairAfter<Real> collide(const Ball<Real>& first, const Ball<Real>& second,
                                      const Coefficients<Real>& c, const BallFriction& friction) {
  PairAfter<Real> after{first, second, {}};
  after.impact = strike_together(after.first, after.second, c, friction);
  return after;
}

}  // namespace poolhall::physics
