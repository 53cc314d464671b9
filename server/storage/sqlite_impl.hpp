// The database in SQLite, for this room's sources alone: others open one by sqlite_database.hpp.
// What it asks is in sqlite_queries.cpp, what it changes in sqlite_database.cpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/storage/checkpointer.hpp"
#include "server/storage/database.hpp"
#include "server/storage/file_lock.hpp"
#include "server/storage/sqlite_connection.hpp"
#include "server/storage/sqlite_rows.hpp"

namespace poolhall::storage {

// Serves as a Reader too: on a connection that may only read.
class SqliteDatabase final : public Database {
 public:
  explicit SqliteDatabase(std::unique_ptr<SqliteConnection> reading)
      : connection_(std::move(reading)) {}
  SqliteDatabase(FileLock lock, std::unique_ptr<SqliteConnection> connection,
                 std::unique_ptr<Checkpointer> checkpointer)
      : lock_(std::move(lock)),
        connection_(std::move(connection)),
        checkpointer_(std::move(checkpointer)) {
    connection_->on_log_growth([this](int pages) { checkpointer_->log_has(pages); });
  }
  ~SqliteDatabase() override {
    if (checkpointer_ && checkpointer_->stop_and_tell_whether_log_stays())
      connection_->keep_log_at_close();
  }

  Expected<Counters> counters() override;
  Expected<std::vector<AgentRecord>> agents() override;
  Expected<std::optional<AgentRecord>> agent(AgentId id) override;
  Expected<std::optional<AgentRecord>> agent_named(std::string_view name) override;
  Expected<std::optional<AgentRecord>> agent_with_token(const Digest& token_hash) override;
  Expected<std::vector<TournamentRecord>> tournaments() override;
  Expected<std::vector<EntryRecord>> entries(std::string_view tournament) override;
  Expected<std::optional<MatchRecord>> match(MatchId id) override;
  Expected<std::vector<MatchRecord>> matches_of(std::string_view tournament) override;
  Expected<std::vector<MatchRecord>> unfinished_matches() override;
  Expected<std::optional<GameRecord>> game(GameId id) override;
  Expected<std::vector<GameRecord>> games_of(MatchId match) override;
  Expected<std::optional<MatchRecord>> match_requested(std::string_view request) override;
  Expected<std::vector<GameRecord>> unacknowledged_by(AgentId agent, std::size_t most) override;
  Expected<std::vector<MatchRecord>> untold_matches(AgentId agent, std::size_t most) override;
  Expected<std::vector<TournamentRecord>> untold_tournaments(AgentId agent,
                                                             std::size_t most) override;
  Expected<std::vector<FinalStanding>> final_standings(std::string_view tournament) override;
  Expected<std::vector<UnfinishedGame>> unfinished_games() override;
  Expected<std::vector<ResultRecord>> results() override;
  Expected<std::vector<GameId>> game_ids() override;
  Expected<std::optional<TurnRecord>> turn(GameId game, std::uint32_t number) override;
  Expected<void> each_turn(GameId game,
                           const std::function<bool(const TurnRecord&)>& visit) override;
  Expected<void> consistently(const std::function<void()>& read) override;
  Expected<std::vector<std::string>> check_structure() override;

  Expected<void> begin() override;
  Expected<void> commit() override;
  void rollback() override;
  Expected<void> add_agent(const AgentRecord& agent) override;
  Expected<void> set_agent_token(AgentId agent, const Digest& token_hash) override;
  Expected<void> add_tournament(const TournamentRecord& tournament) override;
  Expected<void> set_tournament_status(std::string_view tournament,
                                       TournamentStatus status) override;
  Expected<void> add_entry(const EntryRecord& entry) override;
  Expected<void> update_entry(const EntryRecord& entry) override;
  Expected<void> add_match(const MatchRecord& match) override;
  Expected<void> update_match(const MatchRecord& match) override;
  Expected<void> finish_tournament(std::string_view tournament,
                                   const std::vector<FinalStanding>& standings) override;
  Expected<void> acknowledge_match(MatchId match, AgentId agent) override;
  Expected<void> acknowledge_tournament(std::string_view tournament, AgentId agent) override;
  Expected<void> add_game(const GameRecord& game) override;
  Expected<void> update_game(const GameRecord& game) override;
  Expected<void> append_turn(const TurnRecord& turn) override;

 private:
  // All rows of a query, each read by `read`; `keys` are bound to its parameters.
  template <class T, class... Keys>
  Expected<std::vector<T>> all(const std::string& sql, T (Columns::*read)(), const Keys&... keys) {
    return connection_->guarded([&] {
      auto use = connection_->prepared(sql);
      Binder binder(*use);
      static_cast<void>((binder << ... << keys));
      std::vector<T> rows;
      while (use->executeStep()) {
        Columns columns(*use);
        rows.push_back((columns.*read)());
      }
      return rows;
    });
  }

  template <class T, class... Keys>
  Expected<std::optional<T>> one(const std::string& sql, T (Columns::*read)(),
                                 const Keys&... keys) {
    return all(sql, read, keys...).map([](std::vector<T>&& rows) {
      return rows.empty() ? std::optional<T>{} : std::optional<T>{std::move(rows.front())};
    });
  }

  template <class Record>
  Expected<void> insert(const std::string& sql, const Record& record) {
    return connection_->guarded([&] {
      auto use = connection_->prepared(sql);
      Binder(*use) << record;
      use->exec();
    });
  }

  // A change of any number of rows.
  template <class... Values>
  Expected<void> run(const std::string& sql, const Values&... values) {
    return connection_->guarded([&] {
      auto use = connection_->prepared(sql);
      Binder binder(*use);
      (binder << ... << values);
      use->exec();
    });
  }

  // An update that has to change one row.
  template <class... Values>
  Expected<void> change(const std::string& sql, const Values&... values) {
    const auto changed = connection_->guarded([&] {
      auto use = connection_->prepared(sql);
      Binder binder(*use);
      (binder << ... << values);
      return use->exec();
    });
    if (!changed)
      return tl::unexpected(changed.error());
    if (*changed == 1)
      return {};
    return tl::unexpected(StorageError{
        StorageFault::conflict, connection_->file() + ": there is no such row to be changed"});
  }

  std::int64_t next_id(const std::string& table, const std::string& column);

  std::optional<FileLock> lock_;
  std::unique_ptr<SqliteConnection> connection_;
  std::unique_ptr<Checkpointer> checkpointer_;  // null: it only reads
};

}  // namespace poolhall::storage
