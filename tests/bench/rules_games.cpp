// 100,000 whole games between random players, both rule sets, with everything checked that must
// hold of every game (tests/support/random_games.hpp).
#include <chrono>
#include <filesystem>
#include <ostream>
#include <string>

#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/random_games.hpp"

namespace poolhall::bench {

namespace {

using test_support::GamesPlan;
using test_support::GamesReport;

struct Series {
  rules::RuleSet rules;
  const char* table;
  const char* materials;
  std::size_t games;
};

constexpr Series all_series[] = {{rules::RuleSet::eight_ball, "olympiad", "olympiad", 45'000},
                                 {rules::RuleSet::nine_ball, "olympiad", "olympiad", 45'000},
                                 {rules::RuleSet::eight_ball, "wpa9", "modern", 5'000},
                                 {rules::RuleSet::nine_ball, "bar7", "modern", 5'000}};

std::string counted(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [what, count] : counts) {
    text += (text.empty() ? "" : ", ") + what + " " + std::to_string(count);
  }
  return text;
}

}  // namespace

bool bench_rules(const BenchOptions& options, std::ostream& out) {
  ReportTable table("random games", {"game", "table", "games", "turns", "shots", "longest",
                                     "rejudged", "broken", "s", "ends", "fouls"});
  bool holds = true;
  for (const Series& series : all_series) {
    const auto start = std::chrono::steady_clock::now();
    const GamesReport report =
        test_support::play_random_games({.rules = series.rules,
                                         .games = scaled_count(series.games, options),
                                         .seed = options.seed,
                                         .table = series.table,
                                         .materials = series.materials});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    for (const std::string& broken : report.broken) {
      out << name(series.rules) << ": " << broken << '\n';
    }
    holds = holds && report.broken.empty();
    table.add({std::string(name(series.rules)), series.table, std::to_string(report.games),
               std::to_string(report.turns), std::to_string(report.shots),
               std::to_string(report.longest), std::to_string(report.rejudged_from_store),
               std::to_string(report.broken.size()), cell(took.count()), counted(report.ends),
               counted(report.fouls)});
  }
  table.print(out);
  std::filesystem::create_directories(options.directory);
  table.write_csv(options.directory / "rules_games.csv");
  return holds;
}

}  // namespace poolhall::bench
