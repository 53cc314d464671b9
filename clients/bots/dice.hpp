// The bots' own random numbers: Philox4x32-10 with a key from a seed and the game, and a counter
// from the turn, so that a bot with the same seed plays the same game again.
//
//   Dice dice(Dice::key(seed, info.game), state.turn);
//   double heading = dice.uniform(0, 2 * std::numbers::pi);
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "physics/noise.hpp"

namespace poolhall::bots {

class Dice {
 public:
  struct Key {
    std::uint64_t value = 0;
  };
  [[nodiscard]] static Key key(std::uint64_t seed, std::string_view game);

  // Streams of one key are independent of each other.
  Dice(Key key, std::uint32_t stream) : key_(key), stream_(stream) {}

  [[nodiscard]] std::uint64_t bits();
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] std::size_t below(std::size_t bound);  // 0..bound-1; bound > 0
  [[nodiscard]] double normal();
  [[nodiscard]] physics::ShotDeviates deviates();

 private:
  Key key_;
  std::uint32_t stream_;
  std::uint64_t drawn_ = 0;
};

}  // namespace poolhall::bots
