#include "server/ledger/check.hpp"

#include <array>

#include <fmt/format.h>

#include "server/ledger/tables.hpp"

namespace poolhall::ledger {
namespace {

using storage::Expected;
using storage::FinalStanding;

Expected<std::string> name_of(storage::Reader& reader, storage::AgentId agent) {
  const auto found = reader.agent(agent);
  if (!found) {
    return tl::unexpected(found.error());
  }
  return *found ? (*found)->name : std::string("nobody");
}

// What is wrong with the match's place in the schedule; empty: nothing.
Expected<std::string> check_match(storage::Reader& reader, const TournamentBook& book,
                                  const storage::MatchRecord& match) {
  const std::uint32_t number = match.pairing.value_or(0);
  const tournament::Pairing* pairing = book.pairing(number);
  if (pairing == nullptr) {
    // An SPRT's verdict can fall while a later match goes on.
    return book.schedule().sprt ? std::string{}
                                : fmt::format("pairing {} is not in the schedule", number);
  }
  const std::array<tournament::EntryId, 2> players{pairing->first, pairing->second};
  for (const std::size_t i : {0U, 1U}) {
    const auto name = name_of(reader, match.agents[i]);
    if (!name) {
      return tl::unexpected(name.error());
    }
    const std::string& expected = book.names()[index(players[i])];
    if (settings::name_key(*name) != settings::name_key(expected)) {
      return fmt::format("pairing {}: stored {}, expected {}", number, *name, expected);
    }
  }
  return std::string{};
}

std::vector<FinalStanding> final_table(const TournamentBook& book) {
  std::vector<FinalStanding> table;
  for (const tournament::StandingsRow& row : standings(book).rows) {
    table.push_back({row.rank, book.names()[index(row.entry)], row.points, row.games(), row.wins,
                     row.losses, row.draws});
  }
  return table;
}

std::string text(const FinalStanding& row) {
  return fmt::format("{} {} {} ({} games, {} {} {})", row.rank, row.agent, row.points, row.games,
                     row.wins, row.losses, row.draws);
}

// What is wrong with the final table; empty: nothing.
std::string compare(const std::vector<FinalStanding>& stored,
                    const std::vector<FinalStanding>& expected) {
  if (stored.size() != expected.size()) {
    return fmt::format("the final table has {} rows, expected {}", stored.size(), expected.size());
  }
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (stored[i] != expected[i]) {
      return fmt::format("the final table's row {}: stored {}, expected {}", i + 1, text(stored[i]),
                         text(expected[i]));
    }
  }
  return {};
}

Expected<std::string> check(storage::Reader& reader, const storage::TournamentRecord& record) {
  const auto stored = stored_tournament(reader, record.id);
  const auto matches = reader.matches_of(record.id);
  const auto table = reader.final_standings(record.id);
  if (!stored || !matches || !table) {
    return tl::unexpected(!stored ? stored.error() : !matches ? matches.error() : table.error());
  }
  const TournamentBook& book = (*stored)->book;
  for (const storage::MatchRecord& match : *matches) {
    auto wrong = check_match(reader, book, match);
    if (!wrong || !wrong->empty()) {
      return wrong;
    }
  }
  const bool is_over = record.status == storage::TournamentStatus::finished || !table->empty();
  if (is_over && !book.schedule().is_complete) {
    return std::string("it is stored as over, but there are matches to play");
  }
  // An imported tournament has no table of its own.
  return table->empty() ? std::string{} : compare(*table, final_table(book));
}

}  // namespace

namespace {

Expected<std::vector<std::string>> check_all(storage::Reader& reader) {
  const auto tournaments = reader.tournaments();
  if (!tournaments) {
    return tl::unexpected(tournaments.error());
  }
  std::vector<std::string> differences;
  for (const storage::TournamentRecord& record : *tournaments) {
    const auto wrong = check(reader, record);
    if (!wrong || !wrong->empty()) {
      differences.push_back(
          fmt::format("tournament {}: {}", record.id, wrong ? *wrong : wrong.error().reason));
    }
  }
  return differences;
}

}  // namespace

Expected<std::vector<std::string>> check_tournaments(storage::Reader& reader) {
  Expected<std::vector<std::string>> differences;
  const auto read = reader.consistently([&] { differences = check_all(reader); });
  return read ? std::move(differences) : tl::unexpected(read.error());
}

}  // namespace poolhall::ledger
