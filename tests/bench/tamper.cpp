// One changed bit in any stored value of any game is found, and its row named: every value of every
// row of a database of random games, one bit of each; then bits anywhere in the file, where what
// changes a stored value must be found, by its checksums or by SQLite's own check.
#include <filesystem>
#include <map>
#include <ostream>
#include <random>
#include <string>

#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/tampering.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::bench {

namespace {

using match::VerifyReport;
using test_support::StoredValue;

struct Outcome {
  std::size_t values = 0;
  std::size_t found = 0;
  std::size_t row_named = 0;
  std::size_t column_named = 0;
};

std::filesystem::path make_database(const std::filesystem::path& file) {
  auto database = storage::open_sqlite(file).value();
  match::add_players(*database);
  for (const std::int64_t id : {1, 2}) {
    match::PlayedGame(*database, match::order_of(id), 5 + static_cast<std::uint64_t>(id)).play(14);
  }
  match::PlayedGame going_on(*database, match::order_of(3), 9);
  for (int turn = 0; turn < 4; ++turn) {
    going_on.one_turn();
  }
  match::add_mirrored_pair(*database, 6);
  return file;
}

// Nothing: the file cannot be read any more, which is found too.
std::optional<VerifyReport> verified(const std::filesystem::path& file) {
  auto reader = storage::open_sqlite_reader(file);
  if (!reader) {
    return std::nullopt;
  }
  auto report = match::verify(**reader, {});
  return report ? std::optional(std::move(*report)) : std::nullopt;
}

bool names_row(const match::Difference& difference, const StoredValue& value) {
  if (value.table == "matches") {
    return difference.match && number(*difference.match) == value.row;
  }
  return number(difference.game) == value.game &&
         difference.turn.value_or(0) == static_cast<std::uint32_t>(value.turn);
}

void count(Outcome& outcome, const std::optional<VerifyReport>& report, const StoredValue& value) {
  ++outcome.values;
  outcome.found += !report || !report->same() ? 1 : 0;
  if (!report) {
    return;
  }
  for (const match::Difference& difference : report->differences) {
    if (names_row(difference, value)) {
      ++outcome.row_named;
      outcome.column_named += difference.field == value.column ? 1 : 0;
      return;
    }
  }
}

bool tamper_with_values(const std::filesystem::path& file, const BenchOptions& options,
                        std::ostream& out) {
  std::mt19937_64 random(options.seed);
  std::map<std::pair<std::string, std::string>, Outcome> outcomes;
  test_support::Tampering tampering(file);
  for (const StoredValue& value : tampering.values()) {
    const bool is_left_out = static_cast<double>(random() >> 11) * 0x1p-53 >= options.share;
    if (is_left_out || !tampering.flip(value, random)) {
      continue;
    }
    count(outcomes[{value.table, value.column}], verified(file), value);
    tampering.restore(value);
  }
  ReportTable table("one bit of every stored value",
                    {"table", "column", "values", "found", "row named", "column named"});
  bool holds = true;
  Outcome all;
  for (const auto& [column, outcome] : outcomes) {
    table.add({column.first, column.second, std::to_string(outcome.values),
               std::to_string(outcome.found), std::to_string(outcome.row_named),
               std::to_string(outcome.column_named)});
    holds = holds && outcome.found == outcome.values;
    all.values += outcome.values;
    all.found += outcome.found;
    all.row_named += outcome.row_named;
    all.column_named += outcome.column_named;
  }
  table.add({"all", "", std::to_string(all.values), std::to_string(all.found),
             std::to_string(all.row_named), std::to_string(all.column_named)});
  table.print(out);
  table.write_csv(options.directory / "tamper_values.csv");
  const auto after = verified(file);
  return holds && after && after->same();
}

bool tamper_with_file(const std::filesystem::path& file, const BenchOptions& options,
                      std::ostream& out) {
  constexpr std::size_t full = 5'000;
  const std::string values = test_support::all_values(file);
  const std::string bytes = test_support::file_bytes(file);
  const std::filesystem::path copy = file.string() + ".copy";
  std::mt19937_64 random(options.seed);
  std::size_t in_values = 0;
  std::size_t found_in_values = 0;
  std::size_t found_elsewhere = 0;
  const std::size_t bits = scaled_count(full, options);
  for (std::size_t i = 0; i < bits; ++i) {
    std::string changed = bytes;
    changed[random() % changed.size()] ^= static_cast<char>(1U << (random() % 8));
    test_support::write_database(copy, changed);
    const bool changes_values = test_support::all_values(copy) != values;
    const auto report = verified(copy);
    const bool is_found = !report || !report->same();
    in_values += changes_values ? 1 : 0;
    (changes_values ? found_in_values : found_elsewhere) += is_found ? 1 : 0;
  }
  ReportTable table("one bit anywhere in the file of " + std::to_string(bytes.size()) + " bytes",
                    {"bits", "change a value", "of them found", "change none", "of them found"});
  table.add({std::to_string(bits), std::to_string(in_values), std::to_string(found_in_values),
             std::to_string(bits - in_values), std::to_string(found_elsewhere)});
  table.print(out);
  table.write_csv(options.directory / "tamper_file.csv");
  return found_in_values == in_values;
}

}  // namespace

bool bench_tamper(const BenchOptions& options, std::ostream& out) {
  std::filesystem::create_directories(options.directory);
  const test_support::TemporaryDirectory directory;
  const std::filesystem::path file = make_database(directory / "games.db");
  const bool values_hold = tamper_with_values(file, options, out);
  const bool file_holds = tamper_with_file(make_database(directory / "again.db"), options, out);
  return values_hold && file_holds;
}

}  // namespace poolhall::bench
