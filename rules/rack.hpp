// Racks: where the balls of a triangle or a diamond lie, and a game's seeded random choices.
//
//   RackRandom random(settings.rack_seed, rack);
//   std::vector<Vec2<double>> places = rack_places({1, 2, 3, 4, 5}, settings, random, table, m);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "rules/game_state.hpp"

namespace poolhall::rules {

// Random numbers of one rack of one game: Philox4x32-10 (Salmon et al. 2011), the same on every
// machine.
class RackRandom {
 public:
  RackRandom(std::uint64_t seed, std::uint32_t rack) : seed_(seed), rack_(rack) {}

  [[nodiscard]] std::uint64_t bits();
  // Uniform in 0 .. bound - 1; bound > 0.
  [[nodiscard]] std::size_t below(std::size_t bound);
  // Uniform in [-1, 1).
  [[nodiscard]] double symmetric();

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t left = items.size(); left > 1; --left) {
      std::swap(items[left - 1], items[below(left)]);
    }
  }

 private:
  std::uint64_t seed_;
  std::uint32_t rack_;
  std::uint32_t drawn_ = 0;
};

// Places of a rack's balls, row by row from the apex on the foot spot, each row from left to
// right. The computed distance of two neighbours is never below a ball's diameter plus the gap;
// with jitter, never below the diameter.
[[nodiscard]] std::vector<physics::Vec2<double>> rack_places(const std::vector<std::size_t>& rows,
                                                             const GameSettings& settings,
                                                             RackRandom& random,
                                                             const physics::Table& table,
                                                             const physics::Materials& materials);

}  // namespace poolhall::rules
