#include "server/ledger/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "protocol/json_writer.hpp"
#include "server/ratings/status_text.hpp"
#include "server/tournament/crosstable.hpp"
#include "server/tournament/trf.hpp"

namespace poolhall::ledger {

using protocol::JsonWriter;
using tournament::Crosstable;
using tournament::Names;
using tournament::Standings;
using tournament::StandingsRow;

namespace {

// Names are of [A-Za-z0-9._-]: nothing to quote.
std::string csv_line(const std::vector<std::string>& cells) {
  return fmt::format("{}\r\n", fmt::join(cells, ","));  // RFC 4180
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string optional_text(const std::optional<double>& value) {
  return value ? number_text(*value) : "";
}

std::string standings_csv(const Standings& table, const Names& names) {
  std::vector<std::string> head{"rank", "entry",      "points",     "games",
                                "wins", "losses",     "draws",      "rating_status",
                                "elo",  "elo_margin", "superiority"};
  for (const tournament::TieBreak tie_break : table.tie_breaks) {
    head.emplace_back(name(tie_break));
  }
  if (table.has_ladder) {
    head.insert(head.end(), {"ladder_rating", "ladder_deviation"});
  }
  std::string text = csv_line(head);
  for (const StandingsRow& row : table.rows) {
    const auto& rated = row.rating.rated;
    std::vector<std::string> cells{fmt::format("{}", row.rank),
                                   names[index(row.entry)],
                                   number_text(row.points),
                                   fmt::format("{}", row.games()),
                                   fmt::format("{}", row.wins),
                                   fmt::format("{}", row.losses),
                                   fmt::format("{}", row.draws),
                                   std::string(word(row.rating.status)),
                                   rated ? number_text(rated->elo) : "",
                                   rated ? number_text(rated->margin) : "",
                                   optional_text(row.superiority)};
    for (const double value : row.tie_breaks) {
      cells.push_back(number_text(value));
    }
    if (row.ladder) {
      cells.push_back(number_text(row.ladder->rating));
      cells.push_back(number_text(row.ladder->deviation));
    }
    text += csv_line(cells);
  }
  return text;
}

void write_row(JsonWriter& out, const StandingsRow& row, const Standings& table,
               const Names& names) {
  out.begin_object().key("rank").integer(row.rank).key("entry").string(names[index(row.entry)]);
  out.key("points").number(row.points).key("games").integer(row.games());
  out.key("wins").integer(row.wins).key("losses").integer(row.losses);
  out.key("draws").integer(row.draws).key("rating_status").string(word(row.rating.status));
  if (row.rating.rated) {
    out.key("elo").number(row.rating.rated->elo);
    out.key("elo_margin").number(row.rating.rated->margin);
    out.key("rating_group").integer(row.rating.group);
  }
  if (row.superiority) {
    out.key("superiority").number(*row.superiority);
  }
  if (row.ladder) {
    out.key("ladder").begin_object().key("rating").number(row.ladder->rating);
    out.key("deviation").number(row.ladder->deviation).end_object();
  }
  out.key("tie_breaks").begin_object();
  for (std::size_t i = 0; i < table.tie_breaks.size(); ++i) {
    out.key(name(table.tie_breaks[i])).number(row.tie_breaks[i]);
  }
  out.end_object().end_object();
}

void write_lots(JsonWriter& out, const std::vector<tournament::Lot>& lots, const Names& names) {
  out.key("lots").begin_array();
  for (const tournament::Lot& lot : lots) {
    out.begin_object().key("round").integer(lot.round + 1);
    out.key("winner").string(names[index(lot.winner)]);
    out.key("loser").string(names[index(lot.loser)]).end_object();
  }
  out.end_array();
}

std::string standings_json(const std::string& id, const TournamentBook& book,
                           const Standings& table) {
  const Names& names = book.names();
  JsonWriter out;
  out.begin_object().key("tournament").string(id);
  out.key("format").string(name(book.format().kind));
  out.key("complete").boolean(book.schedule().is_complete).key("standings").begin_array();
  for (const StandingsRow& row : table.rows) {
    write_row(out, row, table, names);
  }
  out.end_array();
  if (table.break_advantage) {
    out.key("break_advantage").begin_object().key("elo").number(table.break_advantage->elo);
    out.key("margin").number(table.break_advantage->margin).end_object();
  }
  out.key("endings").begin_object();
  for (const auto& [reason, games] : table.endings) {
    out.key(rules::name(reason)).integer(games);
  }
  out.end_object();
  if (book.schedule().sprt) {
    write_sprt(out.key("sprt"), *book.schedule().sprt);
  }
  if (!book.schedule().lots.empty()) {
    write_lots(out, book.schedule().lots, names);
  }
  out.end_object();
  return std::move(out).text() + '\n';
}

// What each scored against each, in the order of the standings; empty where they have not met.
std::string crosstable_csv(const Crosstable& cross, const Standings& table, const Names& names) {
  std::vector<std::string> head{"rank", "entry"};
  for (const StandingsRow& column : table.rows) {
    head.push_back(names[index(column.entry)]);
  }
  std::string text = csv_line(head);
  for (const StandingsRow& row : table.rows) {
    std::vector<std::string> cells{fmt::format("{}", row.rank), names[index(row.entry)]};
    for (const StandingsRow& column : table.rows) {
      const auto& cell = cross.at(row.entry, column.entry);
      cells.push_back(cell.games == 0 ? "" : fmt::format("{}/{}", cell.points, cell.games));
    }
    text += csv_line(cells);
  }
  return text;
}

std::string crosstable_json(const std::string& id, const Crosstable& cross, const Standings& table,
                            const Names& names) {
  JsonWriter out;
  out.begin_object().key("tournament").string(id).key("entries").begin_array();
  for (const StandingsRow& row : table.rows) {
    out.string(names[index(row.entry)]);
  }
  out.end_array().key("crosstable").begin_array();
  for (const StandingsRow& row : table.rows) {
    out.begin_array();
    for (const StandingsRow& column : table.rows) {
      const auto& cell = cross.at(row.entry, column.entry);
      if (cell.games == 0) {
        out.null();
      } else {
        out.begin_object().key("points").number(cell.points);
        out.key("games").integer(cell.games).end_object();
      }
    }
    out.end_array();
  }
  out.end_array().end_object();
  return std::move(out).text() + '\n';
}

}  // namespace

void write_sprt(JsonWriter& out, const ratings::SprtState& state) {
  const std::string_view verdict = state.verdict == ratings::SprtVerdict::h1   ? "h1"
                                   : state.verdict == ratings::SprtVerdict::h0 ? "h0"
                                                                               : "undecided";
  out.begin_object().key("verdict").string(verdict);
  out.key("log_likelihood_ratio").number(state.log_likelihood_ratio);
  out.key("lower").number(state.lower).key("upper").number(state.upper);
  out.key("pairs").integer(state.pairs).end_object();
}

std::optional<Table> table(std::string_view name) {
  if (name == "standings") {
    return Table::standings;
  }
  return name == "crosstable" ? std::optional(Table::crosstable) : std::nullopt;
}

std::optional<TableForm> table_form(std::string_view name) {
  if (name == "text") {
    return TableForm::text;
  }
  if (name == "csv") {
    return TableForm::csv;
  }
  return name == "json" ? std::optional(TableForm::json) : std::nullopt;
}

Standings standings(const TournamentBook& book) {
  return tournament::standings(book.names().size(), book.games(), book.table_rules());
}

std::string table_text(const std::string& id, const TournamentBook& book, Table table,
                       TableForm form) {
  const Names& names = book.names();
  const Standings standings = ledger::standings(book);
  if (table == Table::standings) {
    switch (form) {
      case TableForm::text:
        break;
      case TableForm::csv:
        return standings_csv(standings, names);
      case TableForm::json:
        return standings_json(id, book, standings);
    }
    return tournament::standings_text(standings, names) + remarks(book) +
           tournament::endings_text(standings);
  }
  const Crosstable cross = tournament::crosstable(names.size(), book.games());
  switch (form) {
    case TableForm::text:
      break;
    case TableForm::csv:
      return crosstable_csv(cross, standings, names);
    case TableForm::json:
      return crosstable_json(id, cross, standings, names);
  }
  return tournament::crosstable_text(cross, standings, names);
}

std::optional<std::string> trf_text(const std::string& id, const TournamentBook& book) {
  if (book.format().kind != tournament::FormatKind::swiss) {
    return std::nullopt;
  }
  return tournament::trf16({id, book.schedule().rounds}, book.names(), book.schedule(),
                           standings(book));
}

}  // namespace poolhall::ledger
