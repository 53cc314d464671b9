// Extreme and stiff scenes (physics.md 9), each with what must come of it: one set for the tests
// and for `poolhall bench stability`.
//
//   for (const NamedScene& s : extreme_scenes()) {
//     Finding finding = s.judge(simulate(s.scene, s.options));
//     if (!finding.as_expected) complain(s.name, s.expected, finding.found);
//   }
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "physics/simulator.hpp"

namespace poolhall::test_support {

using Outcome = physics::Expected<physics::Simulation<double>>;

struct Finding {
  bool as_expected = false;
  std::string found;  // in words, with the numbers that decided
};

struct NamedScene {
  std::string name;
  std::string expected;  // in words
  physics::Scene<double> scene;
  physics::SimulationOptions options;
  std::function<Finding(const Outcome&)> judge;
};

[[nodiscard]] std::vector<NamedScene> extreme_scenes();

// What must hold after any shot: finite numbers, balls inside and apart, no energy out of nothing.
// "" when it does.
[[nodiscard]] std::string broken_invariant(const physics::Scene<double>& scene,
                                           const physics::Simulation<double>& result);

}  // namespace poolhall::test_support
