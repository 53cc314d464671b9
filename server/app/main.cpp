// The program `poolhall`: one sub-command a file, listed here.
#include <CLI/CLI.hpp>

#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Poolhall: the tournament server for computational pool"};
  app.set_version_flag("--version", "poolhall " POOLHALL_VERSION);
  app.require_subcommand(1);

  int exit_code = 0;
  poolhall::app::add_commands(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // It prints what was wrong, or the help that was asked for.
    return app.exit(error) == 0 ? poolhall::app::done : poolhall::app::wrong_input;
  }
  return exit_code;
}
