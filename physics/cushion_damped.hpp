// The Computer Olympiad's cushion: speeds and spin are scaled, v_n -> -0.6 v_n, v_t -> 0.9 v_t,
// w -> 0.1 w. An empirical rule, not mechanics: valid for any input, and it loses energy as long
// as no factor exceeds 1.
#pragma once

#include "physics/cushion_contact.hpp"

namespace poolhall::physics {

template <class Real>
[[nodiscard]] CushionContact<Real> cushion_response(const CushionContact<Real>& before,
                                                    const DampedCushion& cushion, const Materials&,
                                                    const NoseAngle<Real>&) {
  return {{-Real(cushion.normal) * before.velocity.x, Real(cushion.tangential) * before.velocity.y},
          Real(cushion.spin) * before.angular_velocity};
}

}  // namespace poolhall::physics
