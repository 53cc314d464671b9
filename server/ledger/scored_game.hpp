// A game of a match that counts: neither void nor going on.
//
//   if (const auto scored = scored_game(match, game)) book.add_game(pairing, *scored);
#pragma once

#include <cstdint>
#include <optional>

#include "rules/game_state.hpp"
#include "server/storage/records.hpp"

namespace poolhall::ledger {

// Players are 0, the match's first agent, and 1.
struct ScoredGame {
  protocol::GameId game{};
  std::uint32_t number = 0;  // in its match, from 0; a void game that is played again keeps it
  std::uint32_t breaker = 0;
  std::optional<std::uint32_t> winner{};  // unset: drawn
  rules::EndReason reason = rules::EndReason::conceded;
  std::uint32_t turns = 0;  // stored ones: shots, decisions, lost turns, the end
};

// Nothing: it is void or goes on.
[[nodiscard]] std::optional<ScoredGame> scored_game(const storage::MatchRecord& match,
                                                    const storage::GameRecord& game);

}  // namespace poolhall::ledger
