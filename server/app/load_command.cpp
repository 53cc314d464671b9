// `poolhall load`: agents without a thought that load a server, and how it answers.
#include <CLI/CLI.hpp>

#include <boost/asio/ip/address.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "clients/load/load_run.hpp"
#include "server/app/commands.hpp"
#include "server/net/server.hpp"

namespace poolhall::app {
namespace {

struct LoadArguments {
  std::string connect = "127.0.0.1:7777";
  std::string detail = "summary";
  load::LoadOptions options;
  double rate = 0;  // 0: closed loop
  bool json = false;
  bool stages = false;
};

int run_load(LoadArguments arguments) {
  const auto server = net::parse_endpoint(arguments.connect);
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(server ? server->host : "", error);
  if (!server || error) {
    std::cerr << "poolhall load: --connect: got \"" << arguments.connect
              << "\", expected ADDRESS:PORT\n";
    return 2;
  }
  load::LoadOptions& options = arguments.options;
  options.server = {address, server->port};
  if (arguments.rate > 0) {
    options.rate = arguments.rate;
  }
  if (arguments.detail == "full") {
    options.detail = protocol::EventDetail::full;
  }
  if (arguments.stages) {
    options.on_stage = [](std::string_view stage) { std::cout << stage << std::endl; };
  }
  load::LoadReport report = load::run_load(options);
  std::cout << (arguments.json ? load::json_of(report) + '\n' : load::text_of(report))
            << std::flush;
  return report.failure || !report.errors.empty() ? 1 : 0;
}

}  // namespace

void add_load_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<LoadArguments>();
  load::LoadOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand(
      "load", "Load a server with agents that do not think: shots a second, latencies");
  command->add_option("--connect", arguments->connect, "The server's agents' port, ADDRESS:PORT");
  command->add_option("--games", options.games, "Games that go on at the same time")
      ->check(CLI::Range(0U, 100'000U))
      ->capture_default_str();
  command->add_option("--seconds", options.seconds, "Time that is measured")
      ->check(CLI::Range(0.1, 86'400.0))
      ->capture_default_str();
  command->add_option("--warm-up", options.warm_up, "Seconds before, with all games going on")
      ->check(CLI::Range(0.0, 3'600.0))
      ->capture_default_str();
  command
      ->add_option("--rate", arguments->rate,
                   "Answers a second in all games together, latency from the scheduled time; "
                   "without it each turn is answered at once")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--idle", options.idle, "Agents that are logged in and do nothing else")
      ->check(CLI::Range(0U, 1'000'000U));
  command->add_option("--detail", arguments->detail, "Of the events that the agents are told")
      ->check(CLI::IsMember({"summary", "full"}))
      ->capture_default_str();
  command->add_option("--noise", options.noise, "Of the games")->capture_default_str();
  command->add_option("--seed", options.seed, "Of the agents' answers")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->add_flag("--stages", arguments->stages,
                    "Say when all are logged in, when measuring begins and when it ends");
  command->callback([arguments, &exit_code] { exit_code = run_load(*arguments); });
}

}  // namespace poolhall::app
