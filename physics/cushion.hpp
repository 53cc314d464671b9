// A ball meets a cushion: one door to the models. Each model is in a file of its own, named
// after its source.
//
//   const NoseAngle<double> nose = nose_angle<double>(table, materials);
//   Ball<double> after = after_cushion(before, Vec2<double>{1, 0}, materials, nose);
//
// Velocity and spin change, the position does not, and the motion state is left for the caller
// to classify.
#pragma once

#include <optional>
#include <variant>

#include "physics/ball.hpp"
#include "physics/cushion_contact.hpp"
#include "physics/cushion_damped.hpp"
#include "physics/cushion_han2005.hpp"
#include "physics/cushion_mathavan2010.hpp"
#include "physics/cushion_spring.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

// `into_cushion` is the horizontal unit vector from the ball into the cushion, along the normal
// of the rail, facing or jaw. Any speed into the cushion >= 0 will do.
template <class Real>
[[nodiscard]] Ball<Real> after_cushion(const Ball<Real>& before, const Vec2<Real>& into_cushion,
                                       const Materials& materials, const NoseAngle<Real>& nose) {
  const CushionContact<Real> contact = seen_from_cushion(before, into_cushion);
  const CushionContact<Real> after = std::visit(
      [&](const auto& cushion) { return cushion_response(contact, cushion, materials, nose); },
      materials.cushion);
  return seen_from_table(after, before, into_cushion);
}

}  // namespace poolhall::physics
