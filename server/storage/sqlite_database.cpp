#include "server/storage/sqlite_database.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <utility>

#include "server/storage/checkpointer.hpp"
#include "server/storage/file_lock.hpp"
#include "server/storage/sqlite_connection.hpp"
#include "server/storage/sqlite_rows.hpp"

namespace poolhall::storage {
namespace {

using Connection = SqliteConnection;

std::string select(std::string_view columns, std::string_view rest) {
  return "SELECT " + std::string(columns) + " FROM " + std::string(rest);
}

template <class Record>
std::vector<Record> reversed(std::vector<Record>&& rows) {
  std::reverse(rows.begin(), rows.end());
  return std::move(rows);
}

// Serves as a Reader too: on a connection that may only read.
class SqliteDatabase final : public Database {
 public:
  explicit SqliteDatabase(std::unique_ptr<Connection> reading) : connection_(std::move(reading)) {}
  SqliteDatabase(FileLock lock, std::unique_ptr<Connection> connection,
                 std::unique_ptr<Checkpointer> checkpointer)
      : lock_(std::move(lock)),
        connection_(std::move(connection)),
        checkpointer_(std::move(checkpointer)) {
    connection_->on_log_growth([this](int pages) { checkpointer_->log_has(pages); });
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
  std::unique_ptr<Connection> connection_;
  std::unique_ptr<Checkpointer> checkpointer_;  // null: it only reads
};

std::int64_t SqliteDatabase::next_id(const std::string& table, const std::string& column) {
  auto use = connection_->prepared("SELECT coalesce(max(" + column + "), 0) + 1 FROM " + table);
  use->executeStep();
  return Columns(*use).integer();
}

Expected<Counters> SqliteDatabase::counters() {
  return connection_->guarded([&] {
    return Counters{.agent = AgentId{next_id("agents", "id")},
                    .tournament = TournamentId{next_id("tournaments", "wire_id")},
                    .match = MatchId{next_id("matches", "id")},
                    .game = GameId{next_id("games", "id")}};
  });
}

Expected<std::vector<AgentRecord>> SqliteDatabase::agents() {
  return all(select(agent_columns, "agents ORDER BY id"), &Columns::agent);
}

Expected<std::optional<AgentRecord>> SqliteDatabase::agent(AgentId id) {
  return one(select(agent_columns, "agents WHERE id=?"), &Columns::agent, number(id));
}

Expected<std::optional<AgentRecord>> SqliteDatabase::agent_named(std::string_view name) {
  return one(select(agent_columns, "agents WHERE name=?"), &Columns::agent, name);
}

Expected<std::optional<AgentRecord>> SqliteDatabase::agent_with_token(const Digest& token_hash) {
  return one(select(agent_columns, "agents WHERE token_hash=?"), &Columns::agent, token_hash);
}

Expected<std::vector<TournamentRecord>> SqliteDatabase::tournaments() {
  return all(select(tournament_columns, "tournaments ORDER BY wire_id"), &Columns::tournament);
}

Expected<std::vector<EntryRecord>> SqliteDatabase::entries(std::string_view tournament) {
  auto found = all(select(entry_columns, "entries WHERE tournament=? ORDER BY place"),
                   &Columns::entry, tournament);
  if (!found)
    return found;
  for (EntryRecord& entry : *found) {
    auto options =
        all(select("option", "entry_options WHERE tournament=? AND agent=? ORDER BY position"),
            &Columns::text, tournament, number(entry.agent));
    if (!options)
      return tl::unexpected(options.error());
    entry.house_options = std::move(*options);
  }
  return found;
}

Expected<std::optional<MatchRecord>> SqliteDatabase::match(MatchId id) {
  return one(select(match_columns, "matches WHERE id=?"), &Columns::match, number(id));
}

Expected<std::vector<MatchRecord>> SqliteDatabase::matches_of(std::string_view tournament) {
  return all(select(match_columns, "matches WHERE tournament=? ORDER BY pairing"), &Columns::match,
             tournament);
}

Expected<std::vector<MatchRecord>> SqliteDatabase::unfinished_matches() {
  return all(select(match_columns, "matches WHERE over=0 ORDER BY id"), &Columns::match);
}

Expected<std::optional<GameRecord>> SqliteDatabase::game(GameId id) {
  return one(select(game_columns, "games WHERE id=?"), &Columns::game, number(id));
}

Expected<std::vector<GameRecord>> SqliteDatabase::games_of(MatchId match) {
  return all(select(game_columns, "games WHERE match=? ORDER BY number, attempt"), &Columns::game,
             number(match));
}

Expected<std::optional<MatchRecord>> SqliteDatabase::match_requested(std::string_view request) {
  return one(select(match_columns, "matches WHERE request=?"), &Columns::match, request);
}

Expected<std::vector<GameRecord>> SqliteDatabase::unacknowledged_by(AgentId agent,
                                                                    std::size_t most) {
  // Each half has its index; of an OR of both SQLite makes a walk through all games.
  return all(select(game_columns,
                    "games WHERE id IN ("
                    "SELECT id FROM games WHERE over=1 AND first_agent=?1 AND first_acknowledged=0 "
                    "UNION ALL "
                    "SELECT id FROM games WHERE over=1 AND second_agent=?1 AND "
                    "second_acknowledged=0 ORDER BY id DESC LIMIT ?2) ORDER BY id"),
             &Columns::game, number(agent), static_cast<std::int64_t>(most));
}

Expected<std::vector<MatchRecord>> SqliteDatabase::untold_matches(AgentId agent, std::size_t most) {
  return all(select(match_columns,
                    "matches WHERE id IN (SELECT match FROM untold_matches WHERE agent=? "
                    "ORDER BY match DESC LIMIT ?) ORDER BY id"),
             &Columns::match, number(agent), static_cast<std::int64_t>(most));
}

Expected<std::vector<TournamentRecord>> SqliteDatabase::untold_tournaments(AgentId agent,
                                                                           std::size_t most) {
  return all(select(tournament_columns,
                    "tournaments WHERE id IN (SELECT tournament FROM untold_tournaments "
                    "WHERE agent=?) ORDER BY wire_id DESC LIMIT ?"),
             &Columns::tournament, number(agent), static_cast<std::int64_t>(most))
      .map(reversed<TournamentRecord>);
}

Expected<std::vector<FinalStanding>> SqliteDatabase::final_standings(std::string_view tournament) {
  return all(select(standing_columns, "final_standings WHERE tournament=? ORDER BY place"),
             &Columns::final_standing, tournament);
}

Expected<std::vector<UnfinishedGame>> SqliteDatabase::unfinished_games() {
  auto games = all(select(game_columns, "games WHERE over=0 ORDER BY id"), &Columns::game);
  if (!games)
    return tl::unexpected(games.error());
  std::vector<UnfinishedGame> unfinished;
  for (GameRecord& game : *games) {
    UnfinishedGame item{.game = std::move(game)};
    const std::int64_t id = number(item.game.id);
    auto last = one(select(turn_columns, "turns WHERE game=? ORDER BY number DESC LIMIT 1"),
                    &Columns::turn, id);
    if (!last)
      return tl::unexpected(last.error());
    item.last_turn = std::move(*last);
    for (const std::int64_t seat : {0, 1}) {
      auto count = one(select("coalesce(max(shot_index), 0)", "turns WHERE game=? AND seat=?"),
                       &Columns::count, id, seat);
      if (!count)
        return tl::unexpected(count.error());
      item.shots[static_cast<std::size_t>(seat)] = count->value_or(0);
    }
    unfinished.push_back(std::move(item));
  }
  return unfinished;
}

Expected<std::vector<ResultRecord>> SqliteDatabase::results() {
  return all(select(result_columns,
                    "games WHERE over=1 AND reason<>'void' AND finished IS NOT NULL "
                    "ORDER BY finished, id"),
             &Columns::result_row);
}

Expected<std::vector<GameId>> SqliteDatabase::game_ids() {
  return all(select("id", "games ORDER BY id"), &Columns::integer)
      .map([](const std::vector<std::int64_t>& numbers) {
        std::vector<GameId> ids;
        for (const std::int64_t id : numbers)
          ids.push_back(GameId{id});
        return ids;
      });
}

Expected<std::optional<TurnRecord>> SqliteDatabase::turn(GameId game, std::uint32_t number) {
  return one(select(turn_columns, "turns WHERE game=? AND number=?"), &Columns::turn,
             protocol::number(game), std::int64_t{number});
}

Expected<void> SqliteDatabase::each_turn(GameId game,
                                         const std::function<bool(const TurnRecord&)>& visit) {
  return connection_->guarded([&] {
    auto use = connection_->prepared(select(turn_columns, "turns WHERE game=? ORDER BY number"));
    Binder(*use) << number(game);
    while (use->executeStep()) {
      if (!visit(Columns(*use).turn()))
        return;
    }
  });
}

Expected<void> SqliteDatabase::consistently(const std::function<void()>& read) {
  return connection_->guarded([&] {
    // Within a transaction reads are consistent already.
    if (sqlite3_get_autocommit(connection_->raw().getHandle()) == 0) {
      read();
      return;
    }
    connection_->prepared("BEGIN DEFERRED")->exec();
    read();
    connection_->prepared("COMMIT")->exec();
  });
}

Expected<std::vector<std::string>> SqliteDatabase::check_structure() {
  auto findings = all("PRAGMA integrity_check", &Columns::text);
  if (!findings)
    return findings;
  if (findings->size() == 1 && findings->front() == "ok")
    findings->clear();
  auto orphans = connection_->guarded([&] {
    auto use = connection_->prepared("PRAGMA foreign_key_check");
    while (use->executeStep())
      findings->push_back("a row of " + use->getColumn(0).getString() + " refers to nothing in " +
                          use->getColumn(2).getString());
  });
  if (!orphans)
    return tl::unexpected(orphans.error());
  return findings;
}

Expected<void> SqliteDatabase::begin() {
  checkpointer_->begin_writing();
  auto begun = connection_->guarded([&] { connection_->prepared("BEGIN IMMEDIATE")->exec(); });
  if (!begun)
    checkpointer_->end_writing();
  return begun;
}

Expected<void> SqliteDatabase::commit() {
  auto committed = connection_->guarded([&] { connection_->prepared("COMMIT")->exec(); });
  if (committed)
    checkpointer_->end_writing();
  return committed;
}

void SqliteDatabase::rollback() {
  // Some errors have ended the transaction already.
  if (sqlite3_get_autocommit(connection_->raw().getHandle()) == 0)
    connection_->raw().tryExec("ROLLBACK");
  checkpointer_->end_writing();
}

Expected<void> SqliteDatabase::add_agent(const AgentRecord& agent) {
  return insert(insert_sql("agents", agent_columns), agent);
}

Expected<void> SqliteDatabase::set_agent_token(AgentId agent, const Digest& token_hash) {
  return change("UPDATE agents SET token_hash=? WHERE id=?", token_hash, number(agent));
}

Expected<void> SqliteDatabase::add_tournament(const TournamentRecord& tournament) {
  return insert(insert_sql("tournaments", tournament_columns), tournament);
}

Expected<void> SqliteDatabase::set_tournament_status(std::string_view tournament,
                                                     TournamentStatus status) {
  return change("UPDATE tournaments SET status=? WHERE id=?", name(status), tournament);
}

Expected<void> SqliteDatabase::add_entry(const EntryRecord& entry) {
  auto added = insert(insert_sql("entries", entry_columns), entry);
  std::int64_t position = 0;
  for (const std::string& option : entry.house_options) {
    if (!added)
      break;
    added = change(insert_sql("entry_options", "tournament,agent,position,option"),
                   std::string_view(entry.tournament), number(entry.agent), position++,
                   std::string_view(option));
  }
  return added;
}

Expected<void> SqliteDatabase::update_entry(const EntryRecord& entry) {
  const auto until =
      entry.until_round ? std::optional<std::int64_t>(*entry.until_round) : std::nullopt;
  return change("UPDATE entries SET from_round=?, until_round=? WHERE tournament=? AND agent=?",
                std::int64_t{entry.from_round}, until, std::string_view(entry.tournament),
                number(entry.agent));
}

Expected<void> SqliteDatabase::add_match(const MatchRecord& match) {
  return insert(insert_sql("matches", match_columns), match);
}

Expected<void> SqliteDatabase::update_match(const MatchRecord& match) {
  auto updated = change("UPDATE matches SET over=?, finished=?, seal=? WHERE id=?",
                        std::int64_t{match.over}, match.finished, match.seal, number(match.id));
  if (!updated || !match.over)
    return updated;
  return run(
      "INSERT OR IGNORE INTO untold_matches(agent, match) "
      "SELECT first_agent, id FROM matches WHERE id=?1 "
      "UNION SELECT second_agent, id FROM matches WHERE id=?1",
      number(match.id));
}

Expected<void> SqliteDatabase::finish_tournament(std::string_view tournament,
                                                 const std::vector<FinalStanding>& standings) {
  auto done = run("DELETE FROM final_standings WHERE tournament=?", tournament);
  std::int64_t place = 0;
  for (const FinalStanding& row : standings) {
    if (done)
      done = run(insert_sql("final_standings", "tournament,place," + std::string(standing_columns)),
                 tournament, place++, std::int64_t{row.rank}, row.agent, row.points,
                 std::int64_t{row.games}, std::int64_t{row.wins}, std::int64_t{row.losses},
                 std::int64_t{row.draws});
  }
  if (!done)
    return done;
  return run(
      "INSERT OR IGNORE INTO untold_tournaments(agent, tournament) "
      "SELECT agent, tournament FROM entries WHERE tournament=?",
      tournament);
}

Expected<void> SqliteDatabase::acknowledge_match(MatchId match, AgentId agent) {
  return run("DELETE FROM untold_matches WHERE agent=? AND match=?", number(agent), number(match));
}

Expected<void> SqliteDatabase::acknowledge_tournament(std::string_view tournament, AgentId agent) {
  return run("DELETE FROM untold_tournaments WHERE agent=? AND tournament=?", number(agent),
             tournament);
}

Expected<void> SqliteDatabase::add_game(const GameRecord& game) {
  static const std::string sql = insert_sql("games", game_columns);
  return insert(sql, game);
}

Expected<void> SqliteDatabase::update_game(const GameRecord& game) {
  std::optional<std::int64_t> winner;
  std::optional<std::string_view> reason;
  if (game.result) {
    reason = rules::name(game.result->reason);
    if (game.result->winner)
      winner = index(*game.result->winner);
  }
  return change(
      "UPDATE games SET over=?, winner=?, reason=?, turns=?, head=?, first_acknowledged=?, "
      "second_acknowledged=?, finished=?, seal=?, first_secret=?, second_secret=? WHERE id=?",
      std::int64_t{game.over}, winner, reason, std::int64_t{game.turns}, game.head,
      std::int64_t{game.acknowledged[0]}, std::int64_t{game.acknowledged[1]}, game.finished,
      game.seal, game.agent_secrets[0], game.agent_secrets[1], number(game.id));
}

Expected<void> SqliteDatabase::append_turn(const TurnRecord& turn) {
  static const std::string sql = insert_sql("turns", turn_columns);
  return insert(sql, turn);
}

}  // namespace

Expected<std::unique_ptr<Database>> open_sqlite(const std::filesystem::path& file,
                                                CheckpointOptions checkpoints) {
  std::error_code ignored;
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(file, ignored);
  const std::filesystem::path& path = resolved.empty() ? file : resolved;
  if (auto checked = Connection::check_path(path, Connection::Access::owner); !checked)
    return tl::unexpected(checked.error());
  Expected<FileLock> lock = FileLock::take(path);
  if (!lock)
    return tl::unexpected(lock.error());
  auto connection = Connection::open(path, Connection::Access::owner);
  if (!connection)
    return tl::unexpected(connection.error());
  auto checkpointer = Checkpointer::start(path, checkpoints);
  if (!checkpointer)
    return tl::unexpected(checkpointer.error());
  return std::make_unique<SqliteDatabase>(std::move(*lock), std::move(*connection),
                                          std::move(*checkpointer));
}

Expected<std::unique_ptr<Reader>> open_sqlite_reader(const std::filesystem::path& file) {
  auto connection = Connection::open(file, Connection::Access::read_only);
  if (!connection)
    return tl::unexpected(connection.error());
  return std::make_unique<SqliteDatabase>(std::move(*connection));
}

}  // namespace poolhall::storage
