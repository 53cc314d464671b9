// The program `poolhall`: one sub-command a file, listed here.
#include <CLI/CLI.hpp>

#include "server/app/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Poolhall: the tournament server for computational pool"};
  app.set_version_flag("--version", "poolhall " POOLHALL_VERSION);
  app.require_subcommand(1);

  int exit_code = 0;
  poolhall::app::add_commands(app, exit_code);

  CLI11_PARSE(app, argc, argv);
  return exit_code;
}
