#include "server/ledger/scored_game.hpp"

namespace poolhall::ledger {

std::optional<ScoredGame> scored_game(const storage::MatchRecord& match,
                                      const storage::GameRecord& game) {
  if (!game.over || !game.result || game.result->reason == rules::EndReason::void_game) {
    return std::nullopt;
  }
  const auto player_in = [&](rules::Seat seat) {
    return game.agents[rules::index(seat)] == match.agents[0] ? 0U : 1U;
  };
  ScoredGame scored;
  scored.game = game.id;
  scored.number = game.number;
  scored.breaker = player_in(game.breaker);
  if (game.result->winner) {
    scored.winner = player_in(*game.result->winner);
  }
  scored.reason = game.result->reason;
  scored.turns = game.turns;
  return scored;
}

}  // namespace poolhall::ledger
