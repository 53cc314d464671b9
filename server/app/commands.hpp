// The sub-commands. Each is declared here and defined in <name>_command.cpp; its callback sets
// the program's exit code: 0 done, 1 could not be done, 2 wrong input, 3 differs or incomplete.
#pragma once

namespace CLI {
class App;
}

namespace poolhall::app {

void add_commands(CLI::App& app, int& exit_code);

void add_bench_command(CLI::App& app, int& exit_code);
void add_bot_command(CLI::App& app, int& exit_code);
void add_conformance_command(CLI::App& app, int& exit_code);
void add_export_command(CLI::App& app, int& exit_code);
void add_fairness_command(CLI::App& app, int& exit_code);
void add_import_command(CLI::App& app, int& exit_code);
void add_judge_command(CLI::App& app, int& exit_code);
void add_load_command(CLI::App& app, int& exit_code);
void add_replay_command(CLI::App& app, int& exit_code);
void add_serve_command(CLI::App& app, int& exit_code);
void add_simulate_command(CLI::App& app, int& exit_code);
void add_tournament_command(CLI::App& app, int& exit_code);
void add_verify_command(CLI::App& app, int& exit_code);

}  // namespace poolhall::app
