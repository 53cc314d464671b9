// What the cushion models share: the ball as seen from the cushion, and the height at which the
// cushion's nose touches it.
#pragma once

#include <optional>
#include <variant>

#include "physics/ball.hpp"
#include "physics/materials.hpp"
#include "physics/math.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

// Right-handed frame: x horizontally into the cushion, y along it, z up.
template <class Real>
struct CushionContact {
  Vec2<Real> velocity{};          // m/s
  Vec3<Real> angular_velocity{};  // rad/s
};

// Elevation of the nose as seen from the ball's centre: sin = h / R - 1 (Han 2005).
template <class Real>
struct NoseAngle {
  Real sine{};
  Real cosine{1};
};

// Height of the nose above the cloth, m: the cushion's if it has one, else the table's, else
// nothing, which is 1.28 R.
[[nodiscard]] std::optional<double> nose_height(const Table& table, const Materials& materials);

// The nose height in metres, 1.28 R where nothing is said.
[[nodiscard]] double nose_height_or_default(const Table& table, const Materials& materials);

template <class Real>
[[nodiscard]] NoseAngle<Real> nose_angle(const Table& table, const Materials& materials) {
  const std::optional<double> height = nose_height(table, materials);
  const Real radius(materials.ball_radius);
  const Real sine = height ? (Real(*height) - radius) / radius : Real(28) / Real(100);
  return {sine, square_root(Real((Real(1) - sine) * (Real(1) + sine)))};
}

template <class Real>
[[nodiscard]] CushionContact<Real> seen_from_cushion(const Ball<Real>& ball,
                                                     const Vec2<Real>& into) {
  const Vec2<Real> along{-into.y, into.x};
  const Vec2<Real> spin{ball.angular_velocity.x, ball.angular_velocity.y};
  return {{dot(ball.velocity, into), dot(ball.velocity, along)},
          {dot(spin, into), dot(spin, along), ball.angular_velocity.z}};
}

// `ball` with the velocities of `contact`.
template <class Real>
[[nodiscard]] Ball<Real> seen_from_table(const CushionContact<Real>& contact,
                                         const Ball<Real>& ball, const Vec2<Real>& into) {
  const Vec2<Real> along{-into.y, into.x};
  const Vec3<Real>& spin = contact.angular_velocity;
  Ball<Real> after = ball;
  after.velocity = contact.velocity.x * into + contact.velocity.y * along;
  after.angular_velocity = {spin.x * into.x + spin.y * along.x, spin.x * into.y + spin.y * along.y,
                            spin.z};
  return after;
}

}  // namespace poolhall::physics
