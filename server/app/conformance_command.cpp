// `poolhall conformance`: a hostile server for somebody's bot, and what the bot does wrong.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "clients/conformance/run.hpp"
#include "server/app/commands.hpp"
#include "server/net/child_process.hpp"

namespace poolhall::app {
namespace {

using conformance::milliseconds;

struct ConformanceArguments {
  std::string command;
  std::vector<std::string> only;
  std::string rules;
  std::string logs;
  double clock = 10;
  double patience = 10;
  double bound = 60;
  std::uint64_t seed = conformance::HostOptions{}.seed;
  unsigned jobs = 2;
  bool json = false;
  bool list = false;
};

milliseconds duration(double seconds) {
  return milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

std::optional<conformance::BotProcess> start_bot(const std::vector<std::string>& arguments,
                                                 const std::vector<std::string>& environment) {
  const auto child = net::start_child(arguments, environment);
  if (!child) {
    return std::nullopt;
  }
  return conformance::BotProcess{child->pid, child->exit_descriptor};
}

void print_list() {
  for (const conformance::CheckInfo& check : conformance::all_checks()) {
    std::cout << check.name << ": " << check.demand << " (" << check.section << ")\n";
  }
}

// The first name that no check has; empty if there is none.
std::string unknown_name(const std::vector<std::string>& names) {
  const auto checks = conformance::all_checks();
  for (const std::string& name : names) {
    if (std::none_of(checks.begin(), checks.end(),
                     [&](const conformance::CheckInfo& check) { return check.name == name; })) {
      return name;
    }
  }
  return {};
}

// A folder for the bot's output: the one that was asked for, or a fresh one.
std::filesystem::path log_folder(const std::string& wanted) {
  if (!wanted.empty()) {
    std::filesystem::create_directories(wanted);
    return wanted;
  }
  std::string name = (std::filesystem::temp_directory_path() / "poolhall-conformance-XXXXXX");
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no folder for the bot's output can be made as " + name);
  }
  return name;
}

int refuse_arguments(const std::string& why) {
  std::cerr << "poolhall conformance: " << why << "\n";
  return 2;
}

int run_conformance(const ConformanceArguments& arguments) {
  if (arguments.list) {
    print_list();
    return 0;
  }
  if (arguments.command.empty()) {
    return refuse_arguments("--command: is missing, expected the command line that starts the bot");
  }
  if (const std::string name = unknown_name(arguments.only); !name.empty()) {
    return refuse_arguments("--only: got \"" + name + "\", expected a name of --list");
  }
  conformance::RunOptions options;
  options.command = arguments.command;
  options.starter = start_bot;
  options.host.clock = duration(arguments.clock);
  options.host.patience = duration(arguments.patience);
  options.host.bound = duration(arguments.bound);
  options.host.seed = arguments.seed;
  options.host.rules = rules::rule_set(arguments.rules);
  options.host.all_rules = arguments.rules == "both";
  options.only = arguments.only;
  options.jobs = arguments.jobs;
  try {
    options.logs = log_folder(arguments.logs);
  } catch (const std::exception& failure) {
    return refuse_arguments(std::string("--logs: ") + failure.what());
  }
  const conformance::Report report = conformance::run(options);
  const bool has_failed = report.count(conformance::Verdict::failure) > 0 ||
                          report.count(conformance::Verdict::pass) == 0;
  std::cout << (arguments.json ? json_of(report) + '\n' : text_of(report)) << std::flush;
  if (arguments.logs.empty() && !has_failed) {
    std::filesystem::remove_all(options.logs);
  } else {
    std::cerr << "what the bot wrote is in " << options.logs.string() << "\n";
  }
  return has_failed ? 1 : 0;
}

}  // namespace

void add_conformance_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ConformanceArguments>();
  CLI::App* command = app.add_subcommand(
      "conformance", "Play a hostile server at a bot and say what the bot does wrong");
  command->add_option("--command", arguments->command,
                      "The bot's command line for /bin/sh. It has POOLHALL_SERVER (HOST:PORT) and "
                      "POOLHALL_TOKEN in its environment; {server}, {host}, {port} and {token} in "
                      "the command are filled in");
  command->add_option("--only", arguments->only, "Run this check alone; may be given again");
  command->add_flag("--list", arguments->list, "Print the checks and what they demand");
  command
      ->add_option("--rules", arguments->rules,
                   "Games that the bot plays; without it those that it asks for, or both")
      ->check(CLI::IsMember({"8-ball", "9-ball", "both"}));
  command->add_option("--clock", arguments->clock, "Seconds on the bot's clock at every turn")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--patience", arguments->patience,
                   "Seconds for the bot to connect and log in, and to come back")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_option("--bound", arguments->bound, "Seconds for one check in all")
      ->check(CLI::Range(1.0, 36000.0))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Of the racks and of the opponent's shots")
      ->check(CLI::Range(std::uint64_t{0}, (std::uint64_t{1} << 53U) - 1))
      ->capture_default_str();
  command->add_option("--jobs", arguments->jobs, "Checks at the same time")
      ->check(CLI::Range(1U, 64U))
      ->capture_default_str();
  command->add_option("--logs", arguments->logs,
                      "Folder for what the bot writes to its standard output and error; without "
                      "it a temporary one, kept if a check fails");
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = run_conformance(*arguments); });
}

}  // namespace poolhall::app
