// What happens at a strike and at a contact, in the reference's arithmetic.
#pragma once

#include <utility>

#include "physics/reference/reference_motion.hpp"
#include "physics/reference/reference_simulator.hpp"

namespace poolhall::physics::reference {

// Cue strike, (3)-(5) with tip restitution and squirt (physics.md 3).
[[nodiscard]] Ball<Number> struck(Ball<Number> ball, const ReferenceShot& shot,
                                  const Materials& materials, const MotionConstants& constants);

// Two balls in contact (physics.md 4), at least `separation_speed` apart afterwards.
[[nodiscard]] std::pair<Ball<Number>, Ball<Number>> after_ball_contact(
    const Ball<Number>& first, const Ball<Number>& second, const Materials& materials,
    const MotionConstants& constants);

// A ball at a cushion whose outward normal (from the table into the cushion) is `into`
// (physics.md 5). Throws std::invalid_argument for mathavan2010.
[[nodiscard]] Ball<Number> after_cushion_contact(const Ball<Number>& ball, const Vec2<Number>& into,
                                                 const Materials& materials,
                                                 const std::optional<double>& table_nose_height,
                                                 const MotionConstants& constants);

}  // namespace poolhall::physics::reference
