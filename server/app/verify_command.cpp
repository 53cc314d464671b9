// `poolhall verify`: whether every stored shot is what its parameters, keys and rules give.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "physics/version.hpp"
#include "server/app/commands.hpp"
#include "server/ledger/check.hpp"
#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::app {
namespace {

enum VerifyExit : int { all_same = 0, differs = 1, cannot_read = 2, other_version = 3 };

struct VerifyArguments {
  std::string database = "poolhall.db";
  std::optional<std::int64_t> game;
};

void print_summary(const std::string& database, const match::VerifyReport& report) {
  for (const std::string& finding : report.structure)
    fmt::print("{}: {}\n", database, finding);
  for (const match::Difference& difference : report.differences) {
    const std::string turn =
        difference.turn ? fmt::format(", turn {}", *difference.turn) : std::string();
    const std::string match =
        difference.match ? fmt::format(", match {}", protocol::number(*difference.match)) : turn;
    fmt::print("game {}{}: {}: {}\n", protocol::number(difference.game), match, difference.field,
               difference.reason);
  }
  fmt::print("{}: {} games ({} unfinished), {} turns, {} shots run again and bit for bit the same",
             database, report.games, report.unfinished, report.turns, report.shots);
  if (report.other_version > 0)
    fmt::print("; {} turns of another version than {}: chain and rulings only",
               report.other_version, physics::version);
  fmt::print("{}\n", report.same() ? "" : "; there are differences");
}

int verify_database(const VerifyArguments& arguments) {
  auto reader = storage::open_sqlite_reader(arguments.database);
  if (!reader) {
    fmt::print(stderr, "poolhall verify: {}\n", reader.error().reason);
    return cannot_read;
  }
  match::VerifyOptions options;
  if (arguments.game)
    options.only = protocol::GameId{*arguments.game};
  const bool is_terminal = isatty(STDERR_FILENO) == 1;
  if (is_terminal) {
    options.progress = [](const match::VerifyReport& report) {
      fmt::print(stderr, "\r{} games, {} shots", report.games, report.shots);
    };
  }
  const auto report = match::verify(**reader, options);
  if (is_terminal)
    fmt::print(stderr, "\r\033[K");
  if (!report) {
    fmt::print(stderr, "poolhall verify: {}\n", report.error().reason);
    return cannot_read;
  }
  const auto tournaments = arguments.game ? storage::Expected<std::vector<std::string>>{}
                                          : ledger::check_tournaments(**reader);
  if (!tournaments) {
    fmt::print(stderr, "poolhall verify: {}\n", tournaments.error().reason);
    return cannot_read;
  }
  for (const std::string& difference : *tournaments)
    fmt::print("{}\n", difference);
  print_summary(arguments.database, *report);
  if (!report->same() || !tournaments->empty())
    return differs;
  return report->other_version > 0 ? other_version : all_same;
}

}  // namespace

void add_verify_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = app.add_subcommand(
      "verify",
      "Run every stored shot again, recompute its noise, judge it again, check the checksums, and\n"
      "whether schedules and tables of tournaments are those that the games give.\n"
      "Exit code: 0 all the same, 1 something differs, 2 cannot be read, 3 shots of another\n"
      "physics version (chain and rulings checked only)");
  command->add_option("--db", arguments->database, "database file")->capture_default_str();
  command->add_option("--game", arguments->game, "only this game");
  command->callback([arguments, &exit_code] { exit_code = verify_database(*arguments); });
}

}  // namespace poolhall::app
