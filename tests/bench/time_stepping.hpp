// Pool by time steps, as most programs do it: to measure what the event method is compared with.
// The collision models are the core's own; what differs is how time passes and how events are
// found. Tables with mouth lines or without pockets.
//
//   SteppedShot run = step_through(scene, Stepper::verlet, 1e-4);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/simulator.hpp"

namespace poolhall::bench {

enum class Stepper : std::uint8_t {
  paper_discrete,       // the paper, 3.1: constant velocity in a step, backed up to each contact
  semi_implicit_euler,  // contacts are found after the step and resolved there
  verlet,
  runge_kutta_4,
};
[[nodiscard]] const char* name(Stepper stepper);

struct SteppedEvent {
  double t = 0;
  physics::EventType type = physics::EventType::ball_collision;
  physics::BallId first{};
  physics::BallId second{};  // ball_collision
};

struct SteppedShot {
  physics::BallSet<double> balls;    // final
  std::vector<SteppedEvent> events;  // collisions and pocketed balls, in the order found
  std::size_t steps = 0;
  std::size_t operations = 0;  // as the paper counts them (section 4)
  bool ended = true;           // false: still moving after `longest` seconds
};

// The balls of the scene right after its shot, each in the state that its velocities imply.
template <class Real>
[[nodiscard]] physics::BallSet<Real> balls_after_strike(const physics::Scene<Real>& scene);

// `scene` must be possible; `step` in s. For double, and Counted (counted.hpp).
template <class Real>
[[nodiscard]] SteppedShot step_through(const physics::Scene<Real>& scene, Stepper stepper,
                                       double step, double longest = 60);

}  // namespace poolhall::bench
