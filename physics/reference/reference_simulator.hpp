// The slow, exact second opinion on a shot: the same laws as the core, written down again from the
// paper and physics.md in 100-digit arithmetic. It shares data types with the core and no code:
// expanded polynomials, every root isolated, every ball against every other, no pruning, contacts
// one after another (`sequential`), every hop on a rail an event of its own. It computes a shot in
// seconds and is for tests and tools.
//
//   ReferenceScene scene{table, materials, balls, ReferenceShot{0, 2, 0, 45, 3}};
//   ReferenceSimulation truth = reference_simulate(scene, {});
//
// Cushions: damped, han2005, spring. mathavan2010 has no closed form and is refused.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "physics/reference/reference_number.hpp"

namespace poolhall::physics::reference {

// In the units of the wire, so that the conversion too is exact: mm, mm, degrees, degrees, m/s.
struct ReferenceShot {
  double a = 0;
  double b = 0;
  double theta = 0;
  double phi = 0;
  double v = 0;
};

struct ReferenceScene {
  Table table;
  Materials materials;
  BallSet<double> balls;
  std::optional<ReferenceShot> shot;
};

struct ReferenceOptions {
  std::optional<double> t_max{};  // s
  std::size_t event_limit = 100'000;
  std::string cue_ball_shift = "0";  // m, added to the cue ball's x: decimals beyond a double's
};

struct ReferenceSimulation {
  EventLog<Number> events;
  std::vector<Ball<Number>> balls;  // final, in the order of the scene
  Number duration = 0;
  bool complete = true;  // false: the event limit was met
};

[[nodiscard]] ReferenceSimulation reference_simulate(const ReferenceScene& scene,
                                                     const ReferenceOptions& options);

}  // namespace poolhall::physics::reference
