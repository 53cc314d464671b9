// The stiff parts of the physics as initial value problems that any one-step method can be let
// loose on, with what the library makes of them as the converged answer.
//
//   for (const StiffProblem& p : stiff_problems()) {
//     StiffResult r = p.solve(method, 1.0 / 64);   // steps of 1/64 of a contact
//   }
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/stiff_methods.hpp"

namespace poolhall::bench {

struct StiffResult {
  double error = 0;         // of the velocities after the impact, in the incoming speed
  double energy_drift = 0;  // energy afterwards less what it should be, in what there was
};

struct StiffProblem {
  std::string name;
  std::string unit;  // of the step
  bool has_places = false;
  std::function<StiffResult(const StiffMethod&, double step)> solve;
};

// hertz: five touching balls, elastic, hit by the first at 1 m/s; the step in contact times.
// spring: the cushion's normal, a damped linear spring; in contact times.
// mathavan2010: six impacts (0, 30, 60 degrees, stun and rolling) over the normal impulse, in
// impulses that stop the ball.
[[nodiscard]] std::vector<StiffProblem> stiff_problems();

}  // namespace poolhall::bench
