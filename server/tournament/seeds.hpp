// The seeds of a tournament's racks, from the tournament's one seed.
#pragma once

#include <cstdint>

namespace poolhall::tournament {

// Of the racks of one match, below 2^53. SplitMix64 (Steele, Lea,
// Flood 2014) at position `pairing` of the sequence that starts at `tournament_seed`.
[[nodiscard]] constexpr std::uint64_t pairing_seed(std::uint64_t tournament_seed,
                                                   std::uint32_t pairing) {
  std::uint64_t z = tournament_seed + (std::uint64_t{pairing} + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (z ^ (z >> 31)) >> 11;
}

}  // namespace poolhall::tournament
