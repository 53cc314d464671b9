// Extreme and stiff scenes (physics.md 9), each with what must come of it: one set for the tests
// and for `poolhall bench stability`.
//
//   for (const NamedScene& s : extreme_scenes()) {
//     std::string found = s.judge(simulate(s.scene, s.options));  // "" when as expected
//   }
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "physics/simulator.hpp"

namespace poolhall::test_support {

using Outcome = physics::Expected<physics::Simulation<double>>;

struct NamedScene {
  std::string name;
  std::string expected;  // in words
  physics::Scene<double> scene;
  physics::SimulationOptions options;
  std::function<std::string(const Outcome&)> judge;  // what is wrong, "" for nothing
};

[[nodiscard]] std::vector<NamedScene> extreme_scenes();

// What every finished shot must hold: numbers finite, no two balls overlapping, none outside, the
// energy not risen but by the separation speed. "" for nothing wrong.
[[nodiscard]] std::string broken_invariant(const physics::Scene<double>& scene,
                                           const physics::Simulation<double>& result);

}  // namespace poolhall::test_support
