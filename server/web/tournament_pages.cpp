// Pages of tournaments: progress, standings with error bars, who beat whom, games.
#include <algorithm>
#include <optional>
#include <vector>

#include "server/ledger/stored_tournament.hpp"
#include "server/ledger/tables.hpp"
#include "server/ratings/status_text.hpp"
#include "server/tournament/crosstable.hpp"
#include "server/tournament/standings.hpp"
#include "server/web/page_parts.hpp"

namespace poolhall::web {

namespace {

constexpr std::size_t most_games_listed = 2'000;

// A tournament's rows, read once, and what the ledger makes of them.
struct Field {
  storage::TournamentRecord record;
  std::optional<ledger::TournamentBook> book;  // unset: its settings cannot be read
  std::vector<storage::EntryRecord> entries;
  std::vector<storage::MatchRecord> matches;
  std::vector<std::vector<storage::GameRecord>> games;  // by match
};

storage::Expected<Field> read_field(Reader& reader, const storage::TournamentRecord& record,
                                    const Horizon& horizon) {
  auto entries = reader.entries(record.id);
  auto matches = reader.matches_of(record.id);
  if (!entries || !matches) {
    return tl::unexpected(entries ? matches.error() : entries.error());
  }
  Field field{.record = record,
              .book = {},
              .entries = std::move(*entries),
              .matches = std::move(*matches),
              .games = {}};
  if (auto stored = ledger::stored_tournament(reader, record.id, horizon.until());
      stored && *stored) {
    field.book = std::move((*stored)->book);
  }
  for (const storage::MatchRecord& match : field.matches) {
    auto games = reader.games_of(match.id);
    if (!games) {
      return tl::unexpected(games.error());
    }
    for (storage::GameRecord& game : *games) {
      game = horizon.seen(std::move(game));
    }
    field.games.push_back(std::move(*games));
  }
  return field;
}

void write_estimate(JsonWriter& out, std::string_view key,
                    const std::optional<ratings::Estimate>& estimate) {
  out.key(key);
  if (!estimate) {
    out.null();
    return;
  }
  out.begin_object().key("elo").number(estimate->elo);
  out.key("margin").number(estimate->margin).end_object();
}

void write_row(JsonWriter& out, const tournament::StandingsRow& row,
               const tournament::Names& entries) {
  out.begin_object().key("rank").integer(row.rank);
  out.key("agent").string(entries.at(tournament::index(row.entry)));
  out.key("points").number(row.points).key("games").integer(row.games());
  out.key("wins").integer(row.wins).key("losses").integer(row.losses);
  out.key("draws").integer(row.draws);
  out.key("tie_breaks").begin_array();
  for (const double value : row.tie_breaks) {
    out.number(value);
  }
  out.end_array().key("rating").string(word(row.rating.status));
  write_estimate(out, "estimate", row.rating.rated);
  out.key("group").integer(row.rating.group).key("superiority");
  if (row.superiority) {
    out.number(*row.superiority);
  } else {
    out.null();
  }
  out.end_object();
}

void write_standings(JsonWriter& out, const tournament::Standings& table,
                     const tournament::Names& entries) {
  out.key("tie_breaks").begin_array();
  for (const tournament::TieBreak tie_break : table.tie_breaks) {
    out.string(tournament::name(tie_break));
  }
  out.end_array().key("standings").begin_array();
  for (const tournament::StandingsRow& row : table.rows) {
    write_row(out, row, entries);
  }
  out.end_array();
  write_estimate(out, "break_advantage", table.break_advantage);
  out.key("endings").begin_object();
  for (const auto& [reason, count] : table.endings) {
    out.key(rules::name(reason)).integer(count);
  }
  out.end_object();
}

// Rows and columns in the order of the standings; null where they have not met.
void write_crosstable(JsonWriter& out, const tournament::Crosstable& cross,
                      const tournament::Standings& table) {
  out.key("crosstable").begin_array();
  for (const tournament::StandingsRow& row : table.rows) {
    out.begin_array();
    for (const tournament::StandingsRow& column : table.rows) {
      const tournament::CrosstableCell& cell = cross.at(row.entry, column.entry);
      if (cell.games == 0) {
        out.null();
      } else {
        out.begin_array().number(cell.points).integer(cell.games).end_array();
      }
    }
    out.end_array();
  }
  out.end_array();
}

void write_head(JsonWriter& out, const storage::TournamentRecord& tournament) {
  out.key("tournament").string(tournament.id);
  out.key("wire_id").integer(protocol::number(tournament.wire_id));
  out.key("title").string(tournament.title);
  out.key("status").string(storage::name(tournament.status));
  out.key("created_ms").integer(unix_ms(tournament.created));
}

void write_terms(JsonWriter& out, const Field& field) {
  if (!field.book) {
    return;
  }
  const settings::TournamentSettings& settings = field.book->settings();
  out.key("format").string(settings.format).key("rules").string(rules::name(settings.rules));
  out.key("games_per_match").integer(settings.games_per_match);
  out.key("table").string(settings.table).key("physics").string(settings.physics);
}

// How many games there will be, where it is known how many matches are to come.
std::optional<std::uint64_t> games_planned(const Field& field) {
  if (!field.book) {
    return std::nullopt;
  }
  const ledger::TournamentBook& book = *field.book;
  const tournament::Schedule& schedule = book.schedule();
  const tournament::FormatKind kind = book.format().kind;
  const bool is_fixed = kind == tournament::FormatKind::round_robin ||
                        kind == tournament::FormatKind::gauntlet || schedule.is_complete;
  std::uint64_t matches = schedule.pairings.size();
  if (!is_fixed && kind == tournament::FormatKind::swiss) {
    const auto playing = std::count_if(book.field().begin(), book.field().end(),
                                       [](const auto& span) { return !span.until; });
    const std::uint32_t to_come =
        schedule.rounds - std::min(schedule.rounds, schedule.rounds_drawn);
    matches += to_come * (static_cast<std::uint64_t>(playing) / 2);
  } else if (!is_fixed) {
    return std::nullopt;
  }
  return matches * book.settings().games_per_match;
}

bool is_scored(const storage::GameRecord& game) {
  return game.over && game.result && game.result->reason != rules::EndReason::void_game;
}

void write_progress(JsonWriter& out, const Field& field) {
  std::ptrdiff_t over = 0;
  std::ptrdiff_t running = 0;
  for (const auto& games : field.games) {
    over += std::count_if(games.begin(), games.end(), is_scored);
    running +=
        std::count_if(games.begin(), games.end(), [](const auto& game) { return !game.over; });
  }
  out.key("games_over").integer(over).key("games_running").integer(running);
  out.key("games_planned").integer_or_null(games_planned(field));
}

// Of formats that draw one round after the other, and how many there will be if that is known.
void write_rounds(JsonWriter& out, const Field& field) {
  std::optional<std::uint64_t> drawn;
  std::optional<std::uint64_t> all;
  if (field.book && field.book->schedule().rounds_drawn > 0) {
    drawn = field.book->schedule().rounds_drawn;
  }
  if (field.book && field.book->schedule().rounds > 0) {
    all = field.book->schedule().rounds;
  }
  out.key("rounds_drawn").integer_or_null(drawn);
  out.key("rounds").integer_or_null(all);
}

void write_matches(JsonWriter& out, const Field& field, const Names& names) {
  std::size_t listed = 0;
  out.key("matches").begin_array();
  for (std::size_t i = field.matches.size(); i-- > 0 && listed < most_games_listed;) {
    const storage::MatchRecord& match = field.matches[i];
    out.begin_object().key("match").integer(protocol::number(match.id));
    out.key("over").boolean(match.over).key("round");
    const auto* const pairing =
        field.book ? field.book->pairing(match.pairing.value_or(0)) : nullptr;
    if (pairing != nullptr) {
      out.integer(pairing->round + 1);
    } else {
      out.null();
    }
    write_agents(out, match.agents, names);
    out.key("games").begin_array();
    for (const storage::GameRecord& game : field.games[i]) {
      ++listed;
      out.begin_object().key("game").integer(protocol::number(game.id));
      out.key("number").integer(game.number);
      write_agents(out, game.agents, names);
      write_result(out, game);
      if (game.over) {
        out.key("turns").integer(game.turns);
      }
      out.end_object();
    }
    out.end_array().end_object();
  }
  out.end_array();
}

void write_entries(JsonWriter& out, const Field& field, const Names& names) {
  out.key("entries").begin_array();
  for (const storage::EntryRecord& entry : field.entries) {
    out.begin_object().key("agent").string(name_in(names, entry.agent));
    out.key("withdrawn").boolean(entry.withdrawn()).end_object();
  }
  out.end_array();
}

void write_lines(JsonWriter& out, std::string_view text) {
  out.begin_array();
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out.string(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  out.end_array();
}

void write_entry(JsonWriter& out, const std::optional<tournament::EntryId>& entry,
                 const tournament::Names& entries) {
  if (entry) {
    out.string(entries.at(tournament::index(*entry)));
  } else {
    out.null();
  }
}

// The tree of an elimination; its matches by their ids, for their games are told elsewhere.
void write_bracket(JsonWriter& out, const Field& field) {
  out.key("bracket").begin_array();
  const std::vector<tournament::BracketPlace> none;
  const tournament::Names& entries = field.book ? field.book->names() : tournament::Names{};
  for (const auto& place : field.book ? field.book->schedule().bracket : none) {
    out.begin_object().key("round").integer(place.round + 1);
    out.key("side").string(tournament::name(place.side)).key("played").boolean(place.is_played);
    out.key("agents").begin_array();
    write_entry(out, place.one, entries);
    write_entry(out, place.two, entries);
    out.end_array().key("winner");
    write_entry(out, place.winner, entries);
    out.key("matches").begin_array();
    for (const storage::MatchRecord& match : field.matches) {
      if (match.pairing && std::find(place.pairings.begin(), place.pairings.end(),
                                     *match.pairing) != place.pairings.end()) {
        out.integer(protocol::number(match.id));
      }
    }
    out.end_array().end_object();
  }
  out.end_array();
}

// The tables that `poolhall tournament` shows too.
void write_tables(JsonWriter& out, const Field& field) {
  tournament::Standings table;
  tournament::Names entries;
  std::vector<tournament::PlayedGame> games;
  if (field.book) {
    entries = field.book->names();
    games = field.book->games();
    table = ledger::standings(*field.book);
  }
  write_standings(out, table, entries);
  write_crosstable(out, tournament::crosstable(entries.size(), games), table);
  out.key("sprt");
  if (field.book && field.book->schedule().sprt) {
    ledger::write_sprt(out, *field.book->schedule().sprt);
  } else {
    out.null();
  }
  out.key("remarks");
  write_lines(out, field.book ? ledger::remarks(*field.book) : std::string{});
}

}  // namespace

Page tournaments_page(Reader& reader, const Horizon& horizon) {
  const auto tournaments = reader.tournaments();
  const auto names = names_of(reader);
  if (!tournaments || !names) {
    return unreadable(tournaments ? names.error() : tournaments.error());
  }
  JsonWriter out;
  out.begin_object().key("tournaments").begin_array();
  for (const storage::TournamentRecord& tournament : *tournaments) {
    const auto field = read_field(reader, tournament, horizon);
    if (!field) {
      return unreadable(field.error());
    }
    out.begin_object();
    write_head(out, tournament);
    write_terms(out, *field);
    write_progress(out, *field);
    write_entries(out, *field, *names);
    out.end_object();
  }
  out.end_array().end_object();
  return page_of(out);
}

Page tournament_page(Reader& reader, std::string_view id, const Horizon& horizon) {
  const auto tournaments = reader.tournaments();
  const auto names = names_of(reader);
  if (!tournaments || !names) {
    return unreadable(tournaments ? names.error() : tournaments.error());
  }
  const auto found = std::find_if(tournaments->begin(), tournaments->end(),
                                  [id](const auto& tournament) { return tournament.id == id; });
  if (found == tournaments->end()) {
    return not_found("there is no such tournament");
  }
  const auto field = read_field(reader, *found, horizon);
  if (!field) {
    return unreadable(field.error());
  }
  JsonWriter out;
  out.begin_object();
  write_head(out, *found);
  write_terms(out, *field);
  write_progress(out, *field);
  write_entries(out, *field, *names);
  write_rounds(out, *field);
  write_tables(out, *field);
  write_bracket(out, *field);
  write_matches(out, *field, *names);
  out.end_object();
  return page_of(out);
}

}  // namespace poolhall::web
