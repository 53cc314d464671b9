#include "server/storage/sqlite_database.hpp"

#include <sqlite3.h>

#include <utility>

#include "server/storage/sqlite_impl.hpp"
#include "server/storage/turn_texts.hpp"

namespace poolhall::storage {

using Connection = SqliteConnection;

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
  return connection_->guarded([&] {
    const auto texts = packed_texts(turn);
    auto use = connection_->prepared(sql);
    Binder(*use).turn(turn, texts);
    use->exec();
  });
}

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
