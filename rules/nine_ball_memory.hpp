// What only nine-ball remembers between two shots.
//
//   if (memory.fouls_in_a_row[index(seat)] == 2) warn(seat);  // the next foul loses the game
#pragma once

#include <array>
#include <cstdint>

namespace poolhall::rules {

struct NineBallMemory {
  std::array<std::uint8_t, 2> fouls_in_a_row{};  // by seat
  bool push_out_allowed = false;                 // the coming shot is the first after the break

  friend bool operator==(const NineBallMemory&, const NineBallMemory&) = default;
};

}  // namespace poolhall::rules
