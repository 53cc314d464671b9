// The paper's choice, after Marlow: in the normal a damped linear spring, released when its force
// reaches zero; friction and sticking at the nose as in Han 2005.
// Parameters: stiffness > 0, damping ratio 0 <= z < 1, friction >= 0.
#pragma once

#include "physics/cushion_contact.hpp"
#include "physics/cushion_han2005.hpp"

namespace poolhall::physics {

// Restitution and duration of x'' + 2 z w x' + w^2 x = 0, x(0) = 0, until w x + 2 z x' = 0, where
// w^2 = stiffness / mass.
template <class Real>
struct SpringRelease {
  Real restitution{};
  Real contact_time{};  // s; reported, not added to the clock
};

template <class Real>
[[nodiscard]] SpringRelease<Real> spring_release(const SpringCushion& cushion,
                                                 const Real& ball_mass) {
  const Real z(cushion.damping_ratio);
  const Real root = square_root(Real((Real(1) - z) * (Real(1) + z)));
  const Real phase = (pi<Real>() - Real(2) * arc_sine(z)) / root;
  return {exponential(Real(-z * phase)),
          phase / square_root(Real(Real(cushion.stiffness) / ball_mass))};
}

template <class Real>
[[nodiscard]] CushionContact<Real> cushion_response(const CushionContact<Real>& before,
                                                    const SpringCushion& cushion,
                                                    const Materials& materials,
                                                    const NoseAngle<Real>& nose) {
  const Real restitution = spring_release(cushion, Real(materials.ball_mass)).restitution;
  return han2005_impact(before, restitution, Real(cushion.friction), Real(materials.ball_radius),
                        nose);
}

}  // namespace poolhall::physics
