// The two players of a game, by seat.
//
//   Seat winner = other(shooter);
#pragma once

#include <cstdint>

namespace poolhall::rules {

enum class Seat : std::uint8_t { first, second };

[[nodiscard]] constexpr Seat other(Seat seat) {
  return seat == Seat::first ? Seat::second : Seat::first;
}
[[nodiscard]] constexpr unsigned index(Seat seat) {
  return static_cast<unsigned>(seat);
}

}  // namespace poolhall::rules
