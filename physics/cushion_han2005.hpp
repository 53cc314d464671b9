// Han 2005, "Dynamics in carom and three cushion billiards", J. Mech. Sci. Technol. 19: an
// impulse along the line from the ball's centre to the nose, with restitution, and Coulomb
// friction or sticking at the nose; the ball stays on the cloth, whose friction is left out.
// Parameters: restitution 0..1, friction >= 0, nose height between 0 and 2 R.
#pragma once

#include "physics/cushion_contact.hpp"

namespace poolhall::physics {

// The impact with given restitution and friction; the spring model shares it.
template <class Real>
[[nodiscard]] CushionContact<Real> han2005_impact(const CushionContact<Real>& before,
                                                  const Real& restitution, const Real& friction,
                                                  const Real& radius, const NoseAngle<Real>& nose) {
  const Vec2<Real>& v = before.velocity;
  const Vec3<Real>& w = before.angular_velocity;
  // Slip at the nose, and the impulses as speeds (divided by m).
  const Real slip_x = v.x * nose.sine + radius * w.y;
  const Real slip_y = radius * (w.x * nose.sine - w.z * nose.cosine) - v.y;
  const Real normal = (Real(1) + restitution) * v.x * nose.cosine;
  const Real slip = square_root(Real(slip_x * slip_x + slip_y * slip_y));
  const Real sticking = Real(2) * slip / Real(7);
  const Real limit = friction * normal;
  // Size of the friction impulse over that of the slip.
  const Real share = sticking <= limit ? Real(2) / Real(7) : limit / slip;
  const Real along_x = share * slip_x;
  const Real along_y = share * slip_y;

  // dw = (R / I) (-PY sin, PX sin - PZ cos, PY cos): the normal impulse drops out of the middle
  // one, which is -Px; R / I = 5 / (2 m R).
  const Real turn = Real(2.5) / radius;
  return {
      {v.x - (along_x * nose.sine + normal * nose.cosine), v.y + along_y},
      {w.x - turn * along_y * nose.sine, w.y - turn * along_x, w.z + turn * along_y * nose.cosine}};
}

template <class Real>
[[nodiscard]] CushionContact<Real> cushion_response(const CushionContact<Real>& before,
                                                    const Han2005Cushion& cushion,
                                                    const Materials& materials,
                                                    const NoseAngle<Real>& nose) {
  return han2005_impact(before, Real(cushion.restitution), Real(cushion.friction),
                        Real(materials.ball_radius), nose);
}

}  // namespace poolhall::physics
