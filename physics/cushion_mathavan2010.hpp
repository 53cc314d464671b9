// Mathavan, Jackson, Parkin 2010, "A theoretical analysis of billiard ball dynamics under cushion
// impacts", Proc. IMechE C 224: Coulomb friction at the cushion and at the cloth, integrated over
// the normal impulse; compression until the ball stops, restitution until e^2 of the work is
// given back.
// Parameters: restitution 0..1, friction >= 0, the cloth's mu_slide, nose height in (0, 2 R).
//
// Departures from the source: slips are vectors, not angles; a contact whose slip ends sticks where
// its cone of friction allows it; the cloth never pulls; the steps adapt to about 1e-13, and to
// about 1e-12 where a stuck contact breaks loose. With both frictions above about 0.75 the ball can
// wedge between nose and cloth: it stays there. With frictions far above 1 a rigid ball may have no
// consistent motion; where the bound on steps is met Han's impact takes its place.
#pragma once

#include <limits>

#include "physics/cushion_contact.hpp"
#include "physics/cushion_han2005.hpp"
#include "physics/pressed_impact.hpp"

namespace poolhall::physics {

// A speed into the cushion below this part of the ball's other speeds changes none of their digits.
template <class Real>
[[nodiscard]] constexpr Real negligible_speed() {
  return std::numeric_limits<Real>::max_exponent > 200 ? Real(1e-100) : Real(1e-9);
}

template <class Real>
[[nodiscard]] CushionContact<Real> cushion_response(const CushionContact<Real>& before,
                                                    const Mathavan2010Cushion& cushion,
                                                    const Materials& materials,
                                                    const NoseAngle<Real>& nose) {
  // The dynamics do not depend on the unit of speed: the speed into the cushion is 1.
  const Real unit = before.velocity.x;
  if (!(unit > Real(0)))
    return before;
  const Real radius(materials.ball_radius);
  const Real restitution(cushion.restitution);
  // In units of a speed that is nothing beside the ball's others, their squares would overflow.
  const Vec3<Real>& turning = before.angular_velocity;
  const Real other = absolute(before.velocity.y) +
                     radius * (absolute(turning.x) + absolute(turning.y) + absolute(turning.z));
  if (unit < negligible_speed<Real>() * other) {
    return han2005_impact(before, restitution, Real(cushion.friction), radius, nose);
  }
  const Vec2<Real> velocity{Real(1), before.velocity.y / unit};
  const Vec3<Real>& w = before.angular_velocity;
  const Vec3<Real> spin{radius * w.x / unit, radius * w.y / unit, radius * w.z / unit};
  const NoseAndCloth<Real> contacts(nose, Real(cushion.friction), Real(materials.mu_slide));
  PressedImpact<Real> impact(contacts, velocity, spin, restitution);
  if (!impact.run()) {
    return han2005_impact(before, restitution, Real(cushion.friction), radius, nose);
  }
  const PressedState<Real>& y = impact.state();
  return {{unit * y[pressed::vx], unit * y[pressed::vy]},
          {unit * y[pressed::spin_x] / radius, unit * y[pressed::spin_y] / radius,
           unit * y[pressed::spin_z] / radius}};
}

}  // namespace poolhall::physics
