// Coefficient of friction between two balls against the slip at their contact.
//
//   const double mu = ball_friction_coefficient(materials.ball_friction, slip);
#pragma once

#include <variant>

#include "physics/materials.hpp"
#include "physics/math.hpp"

namespace poolhall::physics {

// `slip` >= 0, m/s. Alciatore's fit: TP A.14.
template <class Real>
[[nodiscard]] Real ball_friction_coefficient(const BallFriction& friction, const Real& slip) {
  if (const auto* constant = std::get_if<ConstantFriction>(&friction)) {
    return Real(constant->coefficient);
  }
  return Real(9951) / Real(1000000) +
         Real(108) / Real(1000) * exponential(Real(-Real(1088) / Real(1000) * slip));
}

}  // namespace poolhall::physics
