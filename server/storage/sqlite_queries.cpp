#include <sqlite3.h>

#include <algorithm>
#include <utility>

#include "server/storage/sqlite_impl.hpp"

namespace poolhall::storage {
namespace {

std::string select(std::string_view columns, std::string_view rest) {
  return "SELECT " + std::string(columns) + " FROM " + std::string(rest);
}

template <class Record>
std::vector<Record> reversed(std::vector<Record>&& rows) {
  std::reverse(rows.begin(), rows.end());
  return std::move(rows);
}

}  // namespace

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

}  // namespace poolhall::storage
