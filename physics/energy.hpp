// Kinetic energy of a ball: translation and rotation, I = 2/5 m R^2.
#pragma once

#include "physics/ball.hpp"
#include "physics/coefficients.hpp"

namespace poolhall::physics {

template <class Real>
[[nodiscard]] Real kinetic_energy(const Ball<Real>& ball, const Coefficients<Real>& c) {
  const Real turning = c.radius * c.radius * dot(ball.angular_velocity, ball.angular_velocity);
  return c.mass / Real(2) * (dot(ball.velocity, ball.velocity) + Real(2) / Real(5) * turning);
}

// What the motion of p and that of q win together beyond what each has: E(p + q) - E(p) - E(q).
template <class Real>
[[nodiscard]] Real shared_energy(const Ball<Real>& p, const Ball<Real>& q,
                                 const Coefficients<Real>& c) {
  const Real turning = c.radius * c.radius * dot(p.angular_velocity, q.angular_velocity);
  return c.mass * (dot(p.velocity, q.velocity) + Real(2) / Real(5) * turning);
}

}  // namespace poolhall::physics
