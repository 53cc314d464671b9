// A scored game, as the tables want it. Void games are not results and never become one.
#pragma once

#include <cstdint>
#include <optional>

#include "rules/game_state.hpp"
#include "server/tournament/entry.hpp"

namespace poolhall::tournament {

struct PlayedGame {
  std::uint32_t pairing = 0;  // Pairing::number
  std::uint32_t number = 0;   // 0-based in its match
  EntryId breaker{};
  EntryId other{};
  std::optional<EntryId> winner{};  // one of the two; unset: drawn
  rules::EndReason reason = rules::EndReason::conceded;
  std::uint32_t turns = 0;  // stored ones, the one that ended it too

  friend bool operator==(const PlayedGame&, const PlayedGame&) = default;
};

// A game that was forfeited before its first shot was not played: that is one stored turn.
[[nodiscard]] constexpr bool was_played(rules::EndReason reason, std::uint32_t turns) {
  return reason != rules::EndReason::forfeit || turns > 1;
}

// What `entry`, one of the two, scored: 1 won, 0.5 drawn, 0 lost.
[[nodiscard]] constexpr double score_of(const PlayedGame& game, EntryId entry) {
  if (!game.winner) {
    return 0.5;
  }
  return *game.winner == entry ? 1 : 0;
}

}  // namespace poolhall::tournament
