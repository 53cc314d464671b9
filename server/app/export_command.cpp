// `poolhall export`: a database as JSON lines.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "server/app/commands.hpp"
#include "server/match/export_lines.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::app {
namespace {

struct ExportArguments {
  std::string database = "poolhall.db";
  std::string output = "-";
  match::ExportPart part;
  std::optional<std::int64_t> match;
  std::optional<std::int64_t> game;
};

int fail(const std::string& reason) {
  fmt::print(stderr, "poolhall export: {}\n", reason);
  return 1;
}

int export_database(const ExportArguments& arguments) {
  auto reader = storage::open_sqlite_reader(arguments.database);
  if (!reader)
    return fail(reader.error().reason);
  std::FILE* const out =
      arguments.output == "-" ? stdout : std::fopen(arguments.output.c_str(), "w");
  if (out == nullptr)
    return fail(arguments.output + ": " + std::generic_category().message(errno));
  match::ExportPart part = arguments.part;
  if (arguments.match)
    part.match = protocol::MatchId{*arguments.match};
  if (arguments.game)
    part.game = protocol::GameId{*arguments.game};
  const auto done = match::export_lines(**reader, part, [out](const std::string& line) {
    std::fwrite(line.data(), 1, line.size(), out);
    std::fputc('\n', out);
  });
  const bool is_written = std::fflush(out) == 0 && std::ferror(out) == 0;
  if (out != stdout)
    std::fclose(out);
  if (!done)
    return fail(done.error().reason);
  return is_written ? 0 : fail(arguments.output + ": cannot be written");
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write a database, or a part of it, as JSON lines (server/match/README.md)");
  command->add_option("--db", arguments->database, "database file")->capture_default_str();
  command->add_option("--output", arguments->output, "file to write, - for standard output")
      ->capture_default_str();
  CLI::Option_group* part = command->add_option_group("part", "one of them, else all");
  part->add_option("--tournament", arguments->part.tournament, "only this tournament");
  part->add_option("--match", arguments->match, "only this match");
  part->add_option("--game", arguments->game, "only this game of its match");
  part->require_option(0, 1);
  command->callback([arguments, &exit_code] { exit_code = export_database(*arguments); });
}

}  // namespace poolhall::app
