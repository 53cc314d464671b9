// poolhall bench precision | ... : measures, prints tables, writes CSV and SVG.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/server/server_bench.hpp"
#include "tests/bench/server/spectators_bench.hpp"
#include "tests/bench/strength.hpp"
#include "tests/fault/harness/bad_run.hpp"
#include "tests/fault/harness/kill_run.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::app {

namespace {

using Benchmark = bool (*)(const bench::BenchOptions&, std::ostream&);

int guarded(const std::function<bool()>& run) {
  try {
    return run() ? 0 : 1;
  } catch (const std::invalid_argument& error) {
    std::cerr << "poolhall bench: " << error.what() << '\n';
    return wrong_input;
  } catch (const std::exception& error) {
    std::cerr << "poolhall bench: " << error.what() << '\n';
    return 1;
  }
}

struct FaultOptions {
  std::uint32_t kills = 1'000;
  std::uint32_t games = 50;
  std::uint64_t seed = 1;
};

bool bench_faults(const FaultOptions& options) {
  const test_support::TemporaryDirectory directory;
  const fault::BadReport bad =
      fault::run_bad_clients({.directory = directory.path(), .seed = options.seed});
  fault::print(bad, std::cout);
  const fault::KillReport report =
      fault::run_kills({.directory = directory.path(),
                        .kills = options.kills,
                        .kills_a_failpoint = std::max(1U, options.kills / 40),
                        .games = options.games,
                        .seed = options.seed,
                        .progress = &std::cout});
  fault::print(report, std::cout);
  return bad.sound() && report.sound();
}

struct BenchCommand {
  CLI::App* command;
  std::shared_ptr<bench::BenchOptions> options;
};

BenchCommand add_benchmark(CLI::App& parent, int& exit_code, const std::string& name,
                           const std::string& what, Benchmark run) {
  auto options = std::make_shared<bench::BenchOptions>();
  CLI::App* command = parent.add_subcommand(name, what);
  command->add_option("--out", options->directory, "folder for CSV and SVG files")
      ->capture_default_str();
  command
      ->add_option("--share", options->share,
                   "share of the full number of scenes, for a quick look")
      ->check(CLI::Range(1e-6, 1000.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the random scenes")->capture_default_str();
  command->callback([options, run, &exit_code] {
    exit_code = guarded([&] { return run(*options, std::cout); });
  });
  return {command, options};
}

void add_server_bench(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<bench::ServerBenchOptions>();
  CLI::App* command = parent.add_subcommand(
      "server", "the server under load: memory an agent, shots a second, latencies");
  command->add_option("--directory", options->directory, "where the databases are made");
  command->add_option("--seconds", options->seconds, "of each measurement")
      ->check(CLI::Range(0.5, 3600.0))
      ->capture_default_str();
  command->add_option("--idle", options->idle, "agents that only log in")->capture_default_str();
  command->add_option("--games", options->games, "in closed loop")
      ->check(CLI::Range(1U, 10'000U))
      ->capture_default_str();
  command->add_option("--paced-games", options->paced_games, "in open loop")
      ->check(CLI::Range(1U, 100'000U))
      ->capture_default_str();
  command->add_option("--rate", options->rate, "shots a second in all paced games")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command->callback([options, &exit_code] {
    exit_code = guarded([&] { return bench::bench_server(*options, std::cout); });
  });
}

void add_spectators_bench(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<bench::SpectatorsBenchOptions>();
  CLI::App* command = parent.add_subcommand(
      "spectators", "what a thousand spectators of one game cost those who play others");
  command->add_option("--directory", options->directory, "where the database is made");
  command->add_option("--seconds", options->seconds, "of each window")
      ->check(CLI::Range(0.5, 3600.0))
      ->capture_default_str();
  command->add_option("--pairs", options->pairs, "of windows, with and without spectators")
      ->check(CLI::Range(1U, 1'000U))
      ->capture_default_str();
  command->add_option("--spectators", options->spectators, "of one game")
      ->check(CLI::Range(1U, 2'000U))
      ->capture_default_str();
  command->add_option("--games", options->games, "besides the one that is watched")
      ->check(CLI::Range(1U, 10'000U))
      ->capture_default_str();
  command->add_option("--rate", options->rate, "shots a second in all of them")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command->add_option("--watched-rate", options->watched_rate, "shots a second in that one")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->callback([options, &exit_code] {
    exit_code = guarded([&] { return bench::bench_spectators(*options, std::cout); });
  });
}

void add_strength_bench(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<bench::StrengthOptions>();
  CLI::App* command = parent.add_subcommand(
      "strength", "one house bot against another in pairs of games with the same rack");
  command->add_option("--one", options->one, "the bot to be measured")->capture_default_str();
  command->add_option("--other", options->other, "its opponent")->capture_default_str();
  command->add_option("--games", options->games, "an even number")->capture_default_str();
  command
      ->add_option("--clock", options->clock,
                   "seconds of each player in a game, on the wall; 0: no clock runs")
      ->check(CLI::Range(0.0, 86'400.0));
  command
      ->add_option("--noise", options->noise, "none, low, olympiad or high; announced to the bots")
      ->capture_default_str();
  command->add_flag("--hidden", options->hides_noise, "do not announce the noise");
  command->add_option("--table", options->table, "preset of the table")->capture_default_str();
  command->add_option("--materials", options->materials, "preset of the materials")
      ->capture_default_str();
  command
      ->add_option_function<std::string>(
          "--rules",
          [options](const std::string& name) {
            const auto rules = rules::rule_set(name);
            if (!rules) {
              throw CLI::ValidationError("--rules", "expected 8-ball or 9-ball, got " + name);
            }
            options->rules = *rules;
          },
          "8-ball or 9-ball")
      ->default_str("8-ball");
  command->add_option("--effort", options->effort,
                      "of --one: simulated events a shot, instead of what its clock allows");
  command->add_option("--cores", options->cores, "that one move of planner may use")
      ->check(CLI::Range(1U, 256U))
      ->capture_default_str();
  command->add_option("--at-once", options->at_once, "games played at the same time")
      ->check(CLI::Range(1U, 256U))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of racks and noise")->capture_default_str();
  command->callback([options, &exit_code] {
    exit_code = guarded([&] { return bench::bench_strength(*options, std::cout); });
  });
}

void add_faults_bench(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<FaultOptions>();
  CLI::App* command = parent.add_subcommand(
      "faults", "bad clients and kills of the server, and what holds all the same");
  command
      ->add_option("--kills", options->kills,
                   "at random moments; as many again in forty at "
                   "each failpoint")
      ->capture_default_str();
  command->add_option("--games", options->games, "that go on meanwhile")
      ->check(CLI::Range(1U, 10'000U))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of agents and moments")->capture_default_str();
  command->callback(
      [options, &exit_code] { exit_code = guarded([&] { return bench_faults(*options); }); });
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "measure, and show the figures");
  command->require_subcommand(1);
  const BenchCommand precision =
      add_benchmark(*command, exit_code, "precision",
                    "errors and run times of every solver and method, against 100 digits",
                    bench::bench_precision);
  precision.command
      ->add_option(
          "--only", precision.options->part,
          "one part: accuracy (10,000 shots and 1,000 breaks), solvers (a million pairs of "
          "each class), methods, growth or operations")
      ->check(CLI::IsMember(
          std::vector<std::string>(bench::precision_parts.begin(), bench::precision_parts.end())));
  add_benchmark(*command, exit_code, "ratings",
                "how often the ratings' intervals hold the truth and an SPRT is wrong, simulated",
                bench::bench_ratings);
  add_benchmark(*command, exit_code, "rules",
                "100,000 random games of both rule sets, and what must hold of every game",
                bench::bench_rules);
  add_benchmark(*command, exit_code, "stability",
                "extreme scenes, expected against found, and random shots and breaks",
                bench::bench_stability);
  add_benchmark(*command, exit_code, "noise",
                "a million deviates of fresh keys: normal and independent", bench::bench_noise);
  add_benchmark(*command, exit_code, "mirrored",
                "variance of the score difference of two bots, independent and mirrored pairs",
                bench::bench_mirrored);
  add_benchmark(*command, exit_code, "tamper",
                "one bit of every stored value, and whether verify finds it", bench::bench_tamper);
  add_benchmark(*command, exit_code, "lean", "what each omission saves", bench::bench_lean);
  add_faults_bench(*command, exit_code);
  add_strength_bench(*command, exit_code);
  add_server_bench(*command, exit_code);
  add_spectators_bench(*command, exit_code);
  const BenchCommand speed =
      add_benchmark(*command, exit_code, "speed",
                    "microseconds a shot, and against the paper's own scheme", bench::bench_speed);
  speed.command->add_option("--scenes", speed.options->scenes,
                            "file with one scene a line, timed instead of the random ones");
}

}  // namespace poolhall::app
