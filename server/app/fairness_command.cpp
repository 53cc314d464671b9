// `poolhall fairness`: what a match or a tournament was like for its players, from the database.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "server/match/fairness.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::app {
namespace {

struct FairnessArguments {
  std::string database = "poolhall.db";
  std::optional<std::int64_t> match;
  std::optional<std::string> tournament;
};

double seconds(storage::Micros time) {
  return static_cast<double>(time.count()) / 1e6;
}

void print_times(const match::FairnessReport& report,
                 const std::map<storage::AgentId, std::string>& names) {
  fmt::print("{:<24} {:>6} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9} {:>12}\n", "agent", "turns",
             "charged s", "forgiven s", "p50 s", "p95 s", "p99 s", "longest s", "lag p95 ms");
  for (const match::AgentTimes& times : report.agents) {
    const auto name = names.find(times.agent);
    fmt::print("{:<24} {:>6} {:>11.3f} {:>11.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>12.3f}\n",
               name == names.end() ? "?" : name->second, times.thought.count(),
               seconds(times.charged), seconds(times.forgiven.total()),
               seconds(times.thought.percentile(0.5)), seconds(times.thought.percentile(0.95)),
               seconds(times.thought.percentile(0.99)), seconds(times.thought.percentile(1)),
               1e3 * seconds(times.forgiven.percentile(0.95)));
  }
}

void print_noise(const match::FairnessReport& report) {
  if (report.unrevealed > 0)
    fmt::print("\nnoise: secret as yet in {} matches that go on\n", report.unrevealed);
  fmt::print("\nnoise of {} shots ({} moved to the nearest possible one)\n", report.shots,
             report.moved_shots);
  for (const match::NoiseTest& test : report.noise)
    fmt::print("  {:<36} {:>9} values  {:>12.6g}  p = {:.4f}\n", test.name, test.count,
               test.statistic, test.p);
  if (report.noise.empty())
    fmt::print("  too few shots for a test\n");
  else
    fmt::print("  {}\n", match::fit_together(report.noise)
                             ? "as it should be: standard normal and independent"
                             : "NOT as it should be: less likely than one in a thousand");
}

void print_correlation(const char* what, const match::Correlation& found) {
  if (found.value)
    fmt::print("  correlation of {}: {:.3f}, 95 % interval {:.3f} to {:.3f} ({} pairs)\n", what,
               *found.value, found.low, found.high, found.pairs);
  else
    fmt::print("  correlation of {}: too few or all the same ({} pairs)\n", what, found.pairs);
}

int print_report(const match::FairnessReport& report,
                 const std::map<storage::AgentId, std::string>& names) {
  fmt::print("{} matches, {} games\n\n", report.matches, report.games);
  print_times(report, names);
  print_noise(report);
  fmt::print("\nmirrored pairs: {} shots with shared noise\n", report.shared_shots);
  print_correlation("one agent's points in both games", report.points);
  print_correlation("the deviates of a seat's shots of the same number", report.deviates);
  return done;
}

int fail_report(const std::string& reason) {
  fmt::print(stderr, "poolhall fairness: {}\n", reason);
  return failed;
}

int report_on(const FairnessArguments& arguments) {
  auto reader = storage::open_sqlite_reader(arguments.database);
  if (!reader)
    return fail_report(reader.error().reason);
  std::vector<storage::MatchRecord> matches;
  if (arguments.tournament) {
    auto found = (*reader)->matches_of(*arguments.tournament);
    if (!found || found->empty())
      return fail_report(found ? "no matches of a tournament " + *arguments.tournament
                               : found.error().reason);
    matches = std::move(*found);
  } else {
    auto found = (*reader)->match(protocol::MatchId{*arguments.match});
    if (!found || !*found)
      return fail_report(found ? fmt::format("there is no match {}", *arguments.match)
                               : found.error().reason);
    matches.push_back(std::move(**found));
  }
  const auto agents = (*reader)->agents();
  const auto report = match::fairness(**reader, matches);
  if (!agents || !report)
    return fail_report(agents ? report.error().reason : agents.error().reason);
  std::map<storage::AgentId, std::string> names;
  for (const storage::AgentRecord& agent : *agents)
    names[agent.id] = agent.name;
  return print_report(*report, names);
}

}  // namespace

void add_fairness_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<FairnessArguments>();
  CLI::App* command = app.add_subcommand(
      "fairness",
      "Report on a match or a tournament: time charged and forgiven, how long turns took, whether\n"
      "the revealed noise is what it should be, what mirrored pairs had in common");
  command->add_option("--db", arguments->database, "database file")->capture_default_str();
  CLI::Option_group* part = command->add_option_group("part");
  part->add_option("MATCH", arguments->match, "number of the match");
  part->add_option("--tournament", arguments->tournament, "all matches of this tournament");
  part->require_option(1);
  command->callback([arguments, &exit_code] { exit_code = report_on(*arguments); });
}

}  // namespace poolhall::app
