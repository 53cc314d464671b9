// The Dutch system by brute force, for a few players: lists every legal pairing of the round,
// keeps for each bracket those that meet the criteria best, and goes through the candidates in the
// order in which FIDE's rules generate them. Written from the Handbook (C.04.3) once more, without
// anything of the room's.
//
//   std::optional<OraclePairing> best = oracle_pairing(entries, 4, BreakSide::first);
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "server/tournament/swiss_history.hpp"

namespace poolhall::tournament {

struct OraclePairing {
  std::set<std::pair<EntryId, EntryId>> pairs;  // who breaks first is the first of a pair
  std::optional<EntryId> bye;
};

// `entries` are all of the tournament, `present` those to be paired. Nothing: there is no legal
// pairing.
[[nodiscard]] std::optional<OraclePairing> oracle_pairing(const std::vector<SwissEntry>& entries,
                                                          const std::vector<EntryId>& present,
                                                          std::uint32_t rounds);

}  // namespace poolhall::tournament
