// Ways to compute a shot, to be measured against each other and against the reference.
//
//   for (const Method& method : event_methods()) { Measured m = method.run(shot, truth); ... }
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/against_reference.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

struct Measured {
  double microseconds = 0;  // the shot alone, log off, the least of three runs
  bool same_sequence = false;
  bool same_outcome = false;        // the same balls in the same pockets
  std::vector<double> time_errors;  // s, of the events up to the first that is another
  std::vector<double> position;     // m, of every ball that lies on the table in both
};

struct Method {
  std::string family;  // one line of the diagram
  std::string name;    // with its step or precision
  std::string label;   // beside its point in the diagram, where there is room
  std::function<Measured(const test_support::RandomShot&,
                         const physics::reference::ReferenceSimulation&)>
      run;
};

// The event method with each root solver: in float, in double throughout as `evaluate` plays it, as
// `simulate` does (in wider numbers where double is not enough), with balls kept in wider numbers,
// and in long double.
[[nodiscard]] std::vector<Method> event_methods();
// The paper's discrete scheme, Euler, Verlet, Runge-Kutta at five steps each, Dormand-Prince at
// five tolerances.
[[nodiscard]] std::vector<Method> stepping_methods();

}  // namespace poolhall::bench
