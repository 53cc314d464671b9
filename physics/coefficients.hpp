// The numbers of a scene's materials that the motion laws and collisions need, worked out once
// and in the precision of the simulation.
//
//   const auto c = coefficients<double>(materials);
//   c.slide_acceleration;  // mu_s g
#pragma once

#include "physics/materials.hpp"

namespace poolhall::physics {

template <class Real>
struct Coefficients {
  Real radius{};              // m
  Real diameter{};            // m
  Real reach_squared{};       // m^2, (2R)^2
  Real mass{};                // kg
  Real slide_acceleration{};  // m/s^2, mu_s g
  Real roll_acceleration{};   // m/s^2, mu_r g
  Real slide_spin_rate{};     // rad/s^2, 5 mu_s g / (2R), from (9)
  Real spin_deceleration{};   // rad/s^2, 5 mu_sp g / (2R), from (10), or as given
  Real slide_time{};          // s per m/s of slip, 2 / (7 mu_s g), from (13)
  Real roll_time{};           // s per m/s, 1 / (mu_r g), from (17)
  Real lever{};               // 1/m, 5 / (2R): a ball's m / I times R
  Real inverse_radius{};      // 1/m
  Real restitution{};         // e_b
  Real separation_speed{};    // m/s
};

template <class Real>
[[nodiscard]] Coefficients<Real> coefficients(const Materials& m) {
  Coefficients<Real> c;
  const Real gravity(m.gravity);
  c.radius = Real(m.ball_radius);
  c.diameter = c.radius + c.radius;
  c.reach_squared = c.diameter * c.diameter;
  c.mass = Real(m.ball_mass);
  c.slide_acceleration = Real(m.mu_slide) * gravity;
  c.roll_acceleration = Real(m.mu_roll) * gravity;
  c.slide_spin_rate = Real(5) * c.slide_acceleration / c.diameter;
  if (m.spin_deceleration) {
    c.spin_deceleration = Real(*m.spin_deceleration);
  } else if (m.mu_spin) {
    c.spin_deceleration = Real(5) * (Real(*m.mu_spin) * gravity) / c.diameter;
  }
  // Without friction a slide or roll lasts longer than anything we ask for.
  const Real endless(1e100);
  c.slide_time =
      c.slide_acceleration > Real(0) ? Real(Real(2) / (Real(7) * c.slide_acceleration)) : endless;
  c.roll_time = c.roll_acceleration > Real(0) ? Real(Real(1) / c.roll_acceleration) : endless;
  c.lever = Real(5) / c.diameter;
  c.inverse_radius = Real(1) / c.radius;
  c.restitution = Real(m.ball_restitution);
  c.separation_speed = Real(m.separation_speed);
  return c;
}

}  // namespace poolhall::physics
