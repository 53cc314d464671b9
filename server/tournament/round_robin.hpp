// Everybody meets everybody once, by the circle method.
//
//   for (const Pairing& pairing : round_robin(3)) start(pairing);
//
// A pure function of the number of entries. In a round nobody has two matches; with an odd number
// of entries one sits out each round. `first` breaks in the first game of the match and the break
// alternates; over the tournament everybody is `first` as often as `second`, or once more or less
// when the number of opponents is odd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/tournament/entry.hpp"

namespace poolhall::tournament {

struct Pairing {
  std::uint32_t number = 0;  // 0-based, in the order of the schedule
  std::uint32_t round = 0;   // 0-based
  EntryId first{};           // breaks in game 0, 2, ... of the match
  EntryId second{};

  friend bool operator==(const Pairing&, const Pairing&) = default;
};

[[nodiscard]] std::vector<Pairing> round_robin(std::size_t entries);

}  // namespace poolhall::tournament
