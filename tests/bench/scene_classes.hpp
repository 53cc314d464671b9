// The random scenes that accuracy is measured on.
#pragma once

#include <string>

#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

struct SceneClass {
  std::string name;
  std::size_t balls;  // 0: a break
  std::size_t full_count;
  double gap = 0;  // m, of the rack
};

[[nodiscard]] inline test_support::RandomShot shot_of(const SceneClass& scenes,
                                                      std::uint64_t seed) {
  const physics::Table table = *physics::preset_table("olympiad");
  const physics::Materials materials = *physics::preset_materials("olympiad");
  if (scenes.balls == 0) {
    return test_support::random_break(
        {.seed = seed, .gap = scenes.gap, .table = table, .materials = materials});
  }
  return test_support::random_shot(
      {.seed = seed, .balls = scenes.balls, .table = table, .materials = materials});
}

}  // namespace poolhall::bench
