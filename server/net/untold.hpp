// Ends of games, matches and tournaments that agents have not acknowledged: told when they happen
// and again after each login, until an `ack` comes.
//
//   untold.game_over(record);                       // stored already
//   untold.prepare(agent, [&](auto read) { ... });  // once a run: what earlier runs left
//   untold.tell(session, agent);                    // after a login
//   untold.acknowledged(agent, ack.what);
//
// The network thread's own. The latest of each kind are kept in memory, as many as the limits say;
// the others wait in the database for the login after those are acknowledged.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/limits.hpp"
#include "protocol/messages.hpp"
#include "server/net/agent_book.hpp"
#include "server/net/archive.hpp"
#include "server/storage/records.hpp"

namespace poolhall::net {

class Session;

class Untold {
 public:
  Untold(Archive& archive, AgentBook& book, const protocol::Limits& limits)
      : archive_(archive), book_(book), limits_(limits) {}

  using Prepared = std::function<void(const storage::Expected<void>&)>;
  // `then` is called at once if nothing has to be read.
  void prepare(storage::AgentId agent, Prepared then);
  // An agent that is new has nothing in the database.
  void is_new(storage::AgentId agent) { ends_[agent].read = true; }

  // Whoever is here is told of the game by the game itself.
  void game_over(const storage::GameRecord& game);
  // These two tell whoever is here.
  void match_over(const storage::MatchRecord& match, const std::vector<storage::GameRecord>& games,
                  std::optional<protocol::TournamentId> tournament);
  void tournament_over(const std::vector<storage::AgentId>& agents,
                       const protocol::TournamentOver& over);

  void tell(Session& session, storage::AgentId agent) const;
  // The games among them, oldest first.
  [[nodiscard]] std::vector<protocol::GameListing> listings(storage::AgentId agent) const;
  void acknowledged(storage::AgentId agent, const protocol::Ended& what);

 private:
  struct Ends {
    bool read = false;  // all that the database has and the bound allows is here
    std::map<protocol::GameId, storage::GameRecord> games;
    std::map<protocol::MatchId, protocol::MatchOver> matches;
    std::map<protocol::TournamentId, protocol::TournamentOver> tournaments;
  };
  struct Stored;

  [[nodiscard]] static storage::Expected<Stored> stored(storage::Reader& reader,
                                                        storage::AgentId agent, std::size_t most);
  void take_up(storage::AgentId agent, const Stored& stored);
  [[nodiscard]] protocol::MatchOver match_over_of(
      const storage::MatchRecord& match, const std::vector<storage::GameRecord>& games,
      storage::AgentId reader, std::optional<protocol::TournamentId> tournament) const;
  [[nodiscard]] std::shared_ptr<Session> session_of(storage::AgentId agent);
  template <class Map>
  void keep_within_bound(Ends& ends, Map& kept) const;

  Archive& archive_;
  AgentBook& book_;
  const protocol::Limits& limits_;
  std::map<storage::AgentId, Ends> ends_;
};

// One message as several that a line holds: a long match has many keys to tell.
[[nodiscard]] std::vector<protocol::MatchOver> in_parts(const protocol::MatchOver& over);

// Points of a match's agents: a win 1, a draw 1/2, void games nothing.
[[nodiscard]] std::array<double, 2> points_of(const storage::MatchRecord& match,
                                              const std::vector<storage::GameRecord>& games);

}  // namespace poolhall::net
