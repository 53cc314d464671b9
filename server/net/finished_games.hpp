// Requests about games that are over: answered from the database, for as long as it is kept.
//
//   finished.sync(game, asker, agent);
//   finished.acknowledge(asker, agent, game);
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "server/net/live_game.hpp"

namespace poolhall::net {

class FinishedGames {
 public:
  // `tournament_of` names the tournament of a match, if it has one.
  using TournamentOf =
      std::function<std::optional<protocol::TournamentId>(const storage::MatchRecord&)>;

  FinishedGames(GameServices& services, TournamentOf tournament_of)
      : services_(services), tournament_of_(std::move(tournament_of)) {}

  void repeat(const Asker& asker, storage::AgentId agent,
              const std::variant<protocol::Shot, protocol::Decide>& what);
  void concede(const Asker& asker, storage::AgentId agent, protocol::GameId game);
  void sync(const Asker& asker, storage::AgentId agent, protocol::GameId game);
  // Refuses what can only be done before the end.
  void too_late(const Asker& asker, storage::AgentId agent, protocol::GameId game);
  void acknowledge(const Asker& asker, storage::AgentId agent, protocol::GameId game);
  void acknowledge(const Asker& asker, storage::AgentId agent, protocol::MatchId match);

 private:
  struct Found {
    storage::GameRecord game;
    storage::MatchRecord match;
    std::optional<storage::TurnRecord> turn{};
  };
  // Refuses what is none of this agent's games; else `then`, on the network thread.
  void find(const Asker& asker, storage::AgentId agent, protocol::GameId game,
            std::optional<std::uint32_t> turn,
            std::function<void(const Found&, rules::Seat seat)> then);
  void reply_sync(const Asker& asker, const Found& found, rules::Seat seat) const;

  GameServices& services_;
  TournamentOf tournament_of_;
};

[[nodiscard]] protocol::Error unknown_game(protocol::GameId game);

// The reply comes once the acknowledgement of `what` is stored.
void store_acknowledgement(storage::Writer& writer, const Asker& asker, const protocol::Ended& what,
                           storage::Writer::Work work);

}  // namespace poolhall::net
