// Pairs a round of a Swiss tournament by FIDE's Dutch system (Handbook C.04.3, as in force since
// 1 February 2026); the break has the place of colour. A pure function of the rounds before.
//
//   SwissPairings round = pair_swiss_round(players, {.rounds = 5});
//   for (const SwissPair& pair : round.pairs) start(pair.first, pair.second);
//
// The pairing is the one that the rules' procedure finds: the first in its order among those that
// meet the criteria best. It is found by matchings of greatest weight (README.md). Somebody has
// a second bye where only so nobody need meet again or clash in the break (C1, C3). Where even that
// does not help, second byes are avoided first, then as few pairs as possible meet again, and after
// that as few as possible have the same absolute preference.
#pragma once

#include <optional>
#include <vector>

#include "server/tournament/swiss_bracket.hpp"
#include "server/tournament/swiss_history.hpp"

namespace poolhall::tournament {

struct SwissPair {
  EntryId first{};  // breaks first
  EntryId second{};

  friend bool operator==(const SwissPair&, const SwissPair&) = default;
};

struct SwissPairings {
  std::vector<SwissPair> pairs;  // by the rank of the higher of the two
  std::optional<EntryId> bye{};  // when the number of players is odd

  friend bool operator==(const SwissPairings&, const SwissPairings&) = default;
};

// `players`: those to be paired, in any order, all with the same number of rounds behind them.
[[nodiscard]] SwissPairings pair_swiss_round(std::vector<SwissPlayer> players,
                                             const SwissTerms& terms);

// Whether the two have met at a table (C1).
[[nodiscard]] bool have_met(const SwissPlayer& a, const SwissPlayer& b);
// C3: whether both have the same absolute preference, and neither is a topscorer of the last
// round.
[[nodiscard]] bool breaks_clash(const SwissPlayer& a, const SwissPlayer& b,
                                const SwissTerms& terms);

}  // namespace poolhall::tournament
