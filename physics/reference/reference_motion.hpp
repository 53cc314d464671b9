// Motion laws of the reference: (6)-(17) of the paper with the errata of physics.md 2.
#pragma once

#include <optional>

#include "physics/ball.hpp"
#include "physics/materials.hpp"
#include "physics/reference/reference_number.hpp"

namespace poolhall::physics::reference {

struct MotionConstants {
  Number gravity, radius, mass, mu_slide, mu_roll, spin_deceleration;
};

[[nodiscard]] MotionConstants motion_constants(const Materials& materials);

// Velocity of the contact point with the cloth, (6).
[[nodiscard]] Vec2<Number> slip(const Ball<Number>& ball, const Number& radius);

// `ball` with its motion state set from its velocities, and with the exact values of that state.
[[nodiscard]] Ball<Number> classified(Ball<Number> ball, const MotionConstants& constants);

// Constant acceleration of the ball's state.
[[nodiscard]] Vec2<Number> acceleration(const Ball<Number>& ball, const MotionConstants& constants);

// Time until the state ends by itself; none for balls at rest or where friction is zero.
[[nodiscard]] std::optional<Number> time_to_transition(const Ball<Number>& ball,
                                                       const MotionConstants& constants);

// The ball `t` seconds later, no event in between.
[[nodiscard]] Ball<Number> advanced(const Ball<Number>& ball, const Number& t,
                                    const MotionConstants& constants);

// The ball at the end of its state, in the state that follows.
[[nodiscard]] Ball<Number> after_transition(const Ball<Number>& ball,
                                            const MotionConstants& constants);

}  // namespace poolhall::physics::reference
