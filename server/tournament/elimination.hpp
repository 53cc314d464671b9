// The tree of an elimination tournament: matches whose players are seeds, or winners or losers of
// earlier matches.
//
//   std::vector<BracketMatch> tree = double_elimination_tree(6);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/tournament/format.hpp"

namespace poolhall::tournament {

struct BracketSource {
  enum class Kind : std::uint8_t { seed, winner, loser };
  Kind kind = Kind::seed;
  std::size_t of = 0;  // number of the seed from 0 (beyond the entries: nobody), or of the match
};

struct BracketMatch {
  BracketSource one;
  BracketSource two;
  std::uint32_t round = 0;  // after the rounds of the matches that it waits for
  BracketSide side = BracketSide::winners;
  bool is_reset = false;  // played only when `one` of the match before, the final, lost it
};

// In an order in which each match comes after those that it waits for. The first seeds get the
// byes, and meet each other as late as possible.
[[nodiscard]] std::vector<BracketMatch> single_elimination_tree(std::size_t entries);
// The losers' side, the final, and the second final if the one without a loss loses the first.
[[nodiscard]] std::vector<BracketMatch> double_elimination_tree(std::size_t entries);

}  // namespace poolhall::tournament
