// `poolhall import`: exported JSON lines into another database.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <istream>
#include <memory>
#include <string>
#include <system_error>

#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "server/app/input.hpp"
#include "server/match/import_lines.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::app {
namespace {

struct ImportArguments {
  std::string file;
  std::string database = "poolhall.db";
};

int import_into(storage::Database& database, std::istream& lines, const ImportArguments& what) {
  const auto report = match::import_lines(database, lines);
  if (!report) {
    const match::ImportError& error = report.error();
    fmt::print(stderr, "poolhall import: {}:{}: {}{}{}; nothing was imported\n", what.file,
               error.line, error.field, error.field.empty() ? "" : ": ", error.reason);
    return wrong_input;
  }
  fmt::print("{}: {} agents, {} tournaments, {} matches, {} games, {} turns\n", what.database,
             report->agents, report->tournaments, report->matches, report->games, report->turns);
  return done;
}

void remove_database(const std::string& file) {
  for (const char* suffix : {"", "-wal", "-shm", ".lock"}) {
    std::error_code ignored;
    std::filesystem::remove(file + suffix, ignored);
  }
}

int import_file(const ImportArguments& arguments) {
  std::ifstream file;
  std::istream& lines = input_of(arguments.file, file);
  if (!lines) {
    return cannot_read(arguments.file, "an export");
  }
  const bool is_there = std::filesystem::exists(arguments.database);
  auto database = storage::open_sqlite(arguments.database);
  if (!database) {
    fmt::print(stderr, "poolhall import: {}\n", database.error().reason);
    return failed;
  }
  const int code = import_into(**database, lines, arguments);
  database->reset();
  if (code != done && !is_there) {
    remove_database(arguments.database);  // made for nothing
  }
  return code;
}

}  // namespace

void add_import_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = app.add_subcommand(
      "import",
      "Take what `export` wrote into another database: all of it or, with the line and the field\n"
      "that are wrong, nothing. Checksums and commitments are checked; `verify` checks the shots");
  command->add_option("FILE", arguments->file, "JSON lines, - for standard input")->required();
  command->add_option("--db", arguments->database, "database file, made if there is none")
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = import_file(*arguments); });
}

}  // namespace poolhall::app
