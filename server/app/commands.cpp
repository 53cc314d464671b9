#include "server/app/commands.hpp"

namespace poolhall::app {

void add_commands(CLI::App& app, int& exit_code) {
#ifndef POOLHALL_WITHOUT_BENCH
  add_bench_command(app, exit_code);
#endif
  add_bot_command(app, exit_code);
  add_conformance_command(app, exit_code);
  add_export_command(app, exit_code);
  add_fairness_command(app, exit_code);
  add_import_command(app, exit_code);
  add_judge_command(app, exit_code);
  add_load_command(app, exit_code);
  add_replay_command(app, exit_code);
  add_serve_command(app, exit_code);
  add_simulate_command(app, exit_code);
  add_tournament_command(app, exit_code);
  add_verify_command(app, exit_code);
}

}  // namespace poolhall::app
