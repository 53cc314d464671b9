// Mathavan, Jackson, Parkin 2010, "A theoretical analysis of billiard ball dynamics under cushion
// impacts", Proc. IMechE C 224: Coulomb friction at the cushion and at the cloth, integrated over
// the normal impulse; compression until the ball stops, restitution until e^2 of the work is
// given back.
// Parameters: restitution 0..1, friction >= 0, the cloth's mu_slide, nose height in (0, 2 R).
#pragma once

#include "physics/cushion_contact.hpp"

namespace poolhall::physics {

template <class Real>
[[nodiscard]] CushionContact<Real> cushion_response(const CushionContact<Real>& before,
                                                    const Mathavan2010Cushion& cushion,
                                                    const Materials& materials,
                                                    const NoseAngle<Real>& nose);

}  // namespace poolhall::physics
