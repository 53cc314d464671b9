// The database as the server sees it. SQLite is the one implementation (sqlite_database.hpp);
// another one has to pass tests/integration/storage/database_conformance_test.cpp.
//
//   std::unique_ptr<Database> database = std::move(open_sqlite(path)).value();
//   database->begin();
//   database->append_turn(turn);
//   database->commit();   // durable from here
//
// An object serves one thread at a time. The thread that writes is the Writer's (writer.hpp);
// others read through readers of their own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/storage/errors.hpp"
#include "server/storage/records.hpp"

namespace poolhall::storage {

// A game that was going on when the server stopped: all that is needed to go on.
struct UnfinishedGame {
  GameRecord game;
  std::optional<TurnRecord> last_turn{};  // unset: none was played
  std::array<std::uint32_t, 2> shots{};   // by seat
};

class Reader {
 public:
  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  virtual ~Reader() = default;

  [[nodiscard]] virtual Expected<Counters> counters() = 0;

  [[nodiscard]] virtual Expected<std::vector<AgentRecord>> agents() = 0;
  [[nodiscard]] virtual Expected<std::optional<AgentRecord>> agent(AgentId id) = 0;
  [[nodiscard]] virtual Expected<std::optional<AgentRecord>> agent_named(std::string_view name) = 0;
  [[nodiscard]] virtual Expected<std::optional<AgentRecord>> agent_with_token(
      const Digest& token_hash) = 0;

  [[nodiscard]] virtual Expected<std::vector<TournamentRecord>> tournaments() = 0;
  [[nodiscard]] virtual Expected<std::vector<EntryRecord>> entries(std::string_view tournament) = 0;

  [[nodiscard]] virtual Expected<std::optional<MatchRecord>> match(MatchId id) = 0;
  [[nodiscard]] virtual Expected<std::vector<MatchRecord>> matches_of(
      std::string_view tournament) = 0;
  [[nodiscard]] virtual Expected<std::vector<MatchRecord>> unfinished_matches() = 0;

  [[nodiscard]] virtual Expected<std::optional<GameRecord>> game(GameId id) = 0;
  [[nodiscard]] virtual Expected<std::vector<GameRecord>> games_of(MatchId match) = 0;
  // The match that a challenge was answered with.
  [[nodiscard]] virtual Expected<std::optional<MatchRecord>> match_requested(
      std::string_view request) = 0;
  // Over, and not acknowledged by this agent: the latest, oldest first.
  [[nodiscard]] virtual Expected<std::vector<GameRecord>> unacknowledged_by(AgentId agent,
                                                                            std::size_t most) = 0;
  [[nodiscard]] virtual Expected<std::vector<MatchRecord>> untold_matches(AgentId agent,
                                                                          std::size_t most) = 0;
  [[nodiscard]] virtual Expected<std::vector<TournamentRecord>> untold_tournaments(
      AgentId agent, std::size_t most) = 0;
  // How the tournament ended, best first; empty before.
  [[nodiscard]] virtual Expected<std::vector<FinalStanding>> final_standings(
      std::string_view tournament) = 0;
  [[nodiscard]] virtual Expected<std::vector<UnfinishedGame>> unfinished_games() = 0;
  // Games that are over and not void, in the order in which they ended.
  [[nodiscard]] virtual Expected<std::vector<ResultRecord>> results() = 0;
  // Every game's id, ascending.
  [[nodiscard]] virtual Expected<std::vector<GameId>> game_ids() = 0;

  [[nodiscard]] virtual Expected<std::optional<TurnRecord>> turn(GameId game,
                                                                 std::uint32_t number) = 0;
  // In order; `visit` returns false to stop.
  [[nodiscard]] virtual Expected<void> each_turn(
      GameId game, const std::function<bool(const TurnRecord&)>& visit) = 0;

  // All reads within `read` see the database in one state, whatever is committed meanwhile.
  [[nodiscard]] virtual Expected<void> consistently(const std::function<void()>& read) = 0;

  // The database's own check of its structure: one line a finding, none when it is sound.
  [[nodiscard]] virtual Expected<std::vector<std::string>> check_structure() = 0;
};

class Database : public Reader {
 public:
  // One transaction at a time. What is written in it is durable once commit has returned.
  [[nodiscard]] virtual Expected<void> begin() = 0;
  [[nodiscard]] virtual Expected<void> commit() = 0;
  virtual void rollback() = 0;

  // Adding what is there already is a conflict, and so is updating what is not.
  [[nodiscard]] virtual Expected<void> add_agent(const AgentRecord& agent) = 0;
  [[nodiscard]] virtual Expected<void> set_agent_token(AgentId agent, const Digest& token_hash) = 0;
  [[nodiscard]] virtual Expected<void> add_tournament(const TournamentRecord& tournament) = 0;
  [[nodiscard]] virtual Expected<void> set_tournament_status(std::string_view tournament,
                                                             TournamentStatus status) = 0;
  [[nodiscard]] virtual Expected<void> add_entry(const EntryRecord& entry) = 0;
  // Stores again which rounds it takes part in.
  [[nodiscard]] virtual Expected<void> update_entry(const EntryRecord& entry) = 0;
  [[nodiscard]] virtual Expected<void> add_match(const MatchRecord& match) = 0;
  // Stores again whether it is over, when, and the seal. Once it is over both agents have to be
  // told, until they acknowledge it.
  [[nodiscard]] virtual Expected<void> update_match(const MatchRecord& match) = 0;
  // Likewise all that entered. Given again, the later table counts.
  [[nodiscard]] virtual Expected<void> finish_tournament(
      std::string_view tournament, const std::vector<FinalStanding>& standings) = 0;
  // Acknowledging what was acknowledged, or was not to be told, changes nothing.
  [[nodiscard]] virtual Expected<void> acknowledge_match(MatchId match, AgentId agent) = 0;
  [[nodiscard]] virtual Expected<void> acknowledge_tournament(std::string_view tournament,
                                                              AgentId agent) = 0;
  [[nodiscard]] virtual Expected<void> add_game(const GameRecord& game) = 0;
  // Stores again what grows with a game; the rest of `game` must be as it was added.
  [[nodiscard]] virtual Expected<void> update_game(const GameRecord& game) = 0;
  [[nodiscard]] virtual Expected<void> append_turn(const TurnRecord& turn) = 0;
};

}  // namespace poolhall::storage
