// `poolhall bot NAME`: a house bot as an ordinary client in a process of its own.
#include <CLI/CLI.hpp>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <sys/prctl.h>
#include <unistd.h>

#include "clients/bots/house_bots.hpp"
#include "clients/cpp/client.hpp"
#include "server/app/commands.hpp"

namespace poolhall::app {
namespace {

struct BotArguments {
  std::string bot;
  std::string connect = "127.0.0.1:7777";
  bool tls = false;
  std::string tls_ca;
  std::string token;
  std::string name;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> effort;
  unsigned threads = 1;
  unsigned cores = 0;       // 0: what there are, shared by the threads
  std::int64_t parent = 0;  // 0: nobody's child in particular
};

struct HostPort {
  std::string host;
  std::string port;
};

std::optional<HostPort> host_port(const std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
    return std::nullopt;
  }
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  return HostPort{host, text.substr(colon + 1)};
}

bool is_token(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Whether the process that wanted this bot is still there; from now on the bot dies with it.
bool bind_to_parent(std::int64_t parent) {
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) {
    return false;
  }
  return getppid() == parent;  // it may have gone before prctl
}

client::ClientOptions client_options(const BotArguments& arguments, const HostPort& server,
                                     const std::shared_ptr<spdlog::logger>& logger) {
  client::ClientOptions options;
  options.host = server.host;
  options.port = server.port;
  if (arguments.tls || !arguments.tls_ca.empty()) {
    options.tls = client::TlsOptions{arguments.tls_ca};
  }
  options.threads = arguments.threads;
  options.stop_signals = {SIGTERM, SIGINT};
  // The host's own bots cannot vouch for anything against the host.
  options.agent.noise = arguments.parent == 0 ? client::NoisePart::added : client::NoisePart::none;
  options.agent.name = arguments.name.empty() ? arguments.bot : arguments.name;
  options.agent.software = {"poolhall-" + arguments.bot, POOLHALL_VERSION};
  if (!arguments.token.empty()) {
    options.agent.token = protocol::Hex256{arguments.token};
  }
  if (arguments.parent == 0) {
    options.agent.log = [logger](std::string_view line) { logger->info("{}", line); };
  }
  return options;
}

unsigned cores_a_move(const BotArguments& arguments) {
  return arguments.cores > 0
             ? arguments.cores
             : std::max(1U, std::thread::hardware_concurrency() / std::max(1U, arguments.threads));
}

int run_bot(const BotArguments& arguments) {
  const auto logger = spdlog::stderr_color_mt("bot");
  const auto server = host_port(arguments.connect);
  if (!server) {
    logger->error("--connect: got \"{}\", expected HOST:PORT", arguments.connect);
    return 2;
  }
  if (!arguments.token.empty() && !is_token(arguments.token)) {
    logger->error("--token: expected 64 hexadecimal digits in lower case");
    return 2;
  }
  const auto player = bots::house_bot(
      arguments.bot,
      {.seed = arguments.seed, .effort = arguments.effort, .cores = cores_a_move(arguments)});
  if (!player) {
    logger->error("NAME: got \"{}\", expected one of {}", arguments.bot,
                  fmt::join(bots::house_bot_names(), ", "));
    return 2;
  }
  if (arguments.parent != 0 && !bind_to_parent(arguments.parent)) {
    return 1;
  }
  client::Client bot(client_options(arguments, *server, logger), *player);
  const client::End end = bot.run();
  if (end.ending == client::Ending::refused) {
    logger->error("{}", end.reason);
    return 1;
  }
  if (arguments.parent == 0) {
    logger->info("{}", end.reason);
  }
  return 0;
}

}  // namespace

void add_bot_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<BotArguments>();
  CLI::App* command = app.add_subcommand("bot", "Play as a house bot on a server");
  command->add_option("NAME", arguments->bot, "The bot: random, greedy or planner")->required();
  command->add_option("--connect", arguments->connect, "The server's agents' port, HOST:PORT");
  command->add_flag("--tls", arguments->tls, "Connect by TLS");
  command->add_option("--tls-ca", arguments->tls_ca,
                      "PEM file of certificates to believe instead of the system's; means --tls");
  command
      ->add_option("--token", arguments->token,
                   "The agent's token; without one a new agent is registered. Better in the "
                   "environment, where ps does not show it")
      ->envname("POOLHALL_TOKEN");
  command->add_option("--name", arguments->name, "The agent's name when it registers");
  // The server gives one and an entry's own options may give another: the last one counts.
  command->add_option("--seed", arguments->seed, "The same seed plays the same game")->take_last();
  command
      ->add_option("--effort", arguments->effort,
                   "Simulated events that a shot of greedy or planner may cost, about")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  command->add_option("--threads", arguments->threads, "Moves chosen at the same time, one a game")
      ->check(CLI::Range(1U, 256U));
  command
      ->add_option("--cores", arguments->cores,
                   "Cores that planner may use for one move; all there are if left out, shared by "
                   "--threads")
      ->check(CLI::Range(1U, 256U));
  command->add_option("--parent", arguments->parent,
                      "Process id of the parent; the bot dies with it and logs nothing");
  command->callback([arguments, &exit_code] { exit_code = run_bot(*arguments); });
}

}  // namespace poolhall::app
