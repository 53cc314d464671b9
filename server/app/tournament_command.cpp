// `poolhall tournament run FILE.toml`: server, house bots and tournament in one process tree.
#include <CLI/CLI.hpp>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "clients/bots/house_bots.hpp"
#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "server/app/tournament_calls.hpp"
#include "server/app/tournament_display.hpp"
#include "server/net/server.hpp"
#include "server/net/tokens.hpp"
#include "server/net/tournament_desk.hpp"
#include "server/net/tournament_driver.hpp"
#include "server/settings/server_settings.hpp"
#include "server/settings/tournament_settings.hpp"
#include "server/tournament/crosstable.hpp"
#include "server/tournament/render.hpp"

namespace poolhall::app {
namespace {

struct RunArguments {
  std::string file;
  std::string config;
  std::string database;
  std::string listen;
  std::string http;
  bool plain_beyond_loopback = false;
  bool verbose = false;
};

int fail(int code, const std::string& reason) {
  fmt::print(stderr, "poolhall: {}\n", reason);
  return code;
}

// NAME.db in the working directory, or NAME-2.db and so on: a new tournament gets a new file.
std::string new_database(const std::string& name) {
  std::string file = name + ".db";
  for (int number = 2; std::filesystem::exists(file); ++number) {
    file = fmt::format("{}-{}.db", name, number);
  }
  return file;
}

settings::Expected<settings::ServerSettings> server_settings(
    const RunArguments& arguments, const settings::TournamentSettings& tournament) {
  settings::ServerSettings settings;
  if (!arguments.config.empty()) {
    auto loaded = settings::load_server_settings(arguments.config);
    if (!loaded) {
      return loaded;
    }
    settings = *loaded;
  }
  if (!arguments.listen.empty()) {
    settings.listen = arguments.listen;
  } else if (arguments.config.empty()) {
    settings.listen = "127.0.0.1:0";
  }
  if (!arguments.http.empty()) {
    settings.http = arguments.http;
  }
  settings.plain_beyond_loopback |= arguments.plain_beyond_loopback;
  settings.database =
      arguments.database.empty() ? new_database(tournament.name) : arguments.database;
  // Every entry may be a process of this machine.
  const auto entries = static_cast<std::uint32_t>(tournament.entries.size());
  settings.max_house_bots = std::max(settings.max_house_bots, entries);
  settings.limits.connections_per_address =
      std::max(settings.limits.connections_per_address, 2 * entries);
  return settings;
}

std::optional<std::string> wrong_address(const settings::ServerSettings& settings) {
  for (const std::string& address : {settings.listen, settings.http}) {
    if (address.empty()) {
      continue;
    }
    const auto endpoint = net::parse_endpoint(address);
    if (!endpoint) {
      return fmt::format("\"{}\" came, expected HOST:PORT", address);
    }
    if (!net::is_loopback(*endpoint) && !settings.plain_beyond_loopback) {
      return fmt::format(
          "{} is open to others and not encrypted; --plain-beyond-loopback allows it", address);
    }
  }
  return std::nullopt;
}

void announce(const settings::TournamentSettings& tournament, const net::Server& server,
              const std::string& database) {
  const std::size_t entries = tournament.entries.size();
  const std::string matches = tournament.format == "round_robin"
                                  ? fmt::format("{} matches", entries * (entries - 1) / 2)
                                  : fmt::format("{}, matches", tournament.format);
  fmt::print("Tournament {}: {}, {} entries, {} of {} games, noise {}.\n", tournament.name,
             rules::name(tournament.rules), entries, matches, tournament.games_per_match,
             tournament.noise);
  fmt::print("Agents connect to {}. Games are stored in {}.\n",
             net::to_string(server.agents_endpoint()), database);
  if (const auto http = server.http_endpoint()) {
    fmt::print("Watch it at http://{}/ until it ends.\n", net::to_string(*http));
  }
  std::fflush(stdout);
}

void print_final(const net::TournamentView& view) {
  const tournament::Standings table = net::standings_of(view);
  const tournament::Crosstable cross = tournament::crosstable(view.names.size(), view.games);
  fmt::print("\n{}\n{}\n{}", tournament::standings_text(table, view.names),
             tournament::crosstable_text(cross, table, view.names),
             tournament::endings_text(table));
  fmt::print("{}", view.remarks);
}

// What the network thread leaves behind; read when the server has stopped.
struct TournamentOutcome {
  std::optional<net::TournamentView> view;
  std::optional<std::string> error;
};

int report(const TournamentOutcome& outcome, const std::string& database, int server_exit) {
  if (outcome.error) {
    return fail(failed, *outcome.error);
  }
  if (!outcome.view) {
    return fail(failed, "the tournament did not begin");
  }
  print_final(*outcome.view);
  if (!outcome.view->over) {
    fmt::print(
        "Stopped before the end; games are stored in {}. The same command with --db {} goes "
        "on from here.\n",
        database, database);
    return incomplete;
  }
  fmt::print("Games are stored in {0}.\nTo look at them again: poolhall serve --db {0}\n",
             database);
  return server_exit == 0 ? done : failed;
}

int play(const settings::TournamentFile& file, const settings::ServerSettings& settings,
         net::PagePort page_port) {
  net::ServerOptions options;
  options.settings = settings;
  options.page_port = page_port;
  net::Server server(options);
  if (auto started = server.start(); !started) {
    return fail(failed, started.error());
  }
  announce(file.settings, server, settings.database);

  TournamentOutcome outcome;
  std::unique_ptr<net::TournamentDriver> driver;
  TournamentDisplay display(
      [&] { server.post([&](net::MatchHost&) { display.show(driver->view()); }); });
  server.post([&](net::MatchHost& host) {
    driver = std::make_unique<net::TournamentDriver>(
        file, host, [] { return std::chrono::steady_clock::now(); });
    driver->on_change([&] {
      display.changed();
      if (driver->is_over()) {
        server.stop();
      }
    });
    if (auto begun = driver->begin(net::random_seed()); !begun) {
      outcome.error = begun.error();
      server.stop();
    }
  });
  const int server_exit = server.run();
  if (driver && !outcome.error) {
    outcome.view = driver->view();
  }
  display.close(outcome.view);
  return report(outcome, settings.database, server_exit);
}

int run_tournament(const RunArguments& arguments) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("poolhall"));
  const auto file = settings::load_tournament(arguments.file);
  if (!file) {
    return fail(wrong_input, settings::text(file.error()));
  }
  const auto settings = server_settings(arguments, file->settings);
  if (!settings) {
    return fail(wrong_input, settings::text(settings.error()));
  }
  const net::HouseOffer house{bots::house_bot_names(), settings->max_house_bots};
  if (const auto reason = net::why_not_housed(house, file->settings)) {
    return fail(wrong_input, fmt::format("{}: {}", arguments.file, *reason));
  }
  if (const auto wrong = wrong_address(*settings)) {
    return fail(wrong_input, *wrong);
  }
  std::signal(SIGPIPE, SIG_IGN);  // whoever read the output may go, games do not end for that
  spdlog::set_level(arguments.verbose ? spdlog::level::from_str(settings->log.level)
                                      : spdlog::level::warn);
  return play(*file, *settings,
              arguments.http.empty() ? net::PagePort::or_a_free_one : net::PagePort::as_given);
}

void add_run(CLI::App& tournament, int& exit_code) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = tournament.add_subcommand(
      "run", "Play a whole tournament here: server, house bots and display");
  run->add_option("FILE", arguments->file, "The tournament file (config/README.md)")->required();
  run->add_option("--db", arguments->database,
                  "The database; an unfinished tournament in it goes on. Default: a new NAME.db");
  run->add_option("--http", arguments->http,
                  "Serve the page at HOST:PORT meanwhile. Default: port 8080 of 127.0.0.1, or a "
                  "free one");
  run->add_option("--listen", arguments->listen,
                  "Where agents connect, HOST:PORT. Default: a free port of 127.0.0.1");
  run->add_option("--config", arguments->config, "The server's settings file");
  run->add_flag("--plain-beyond-loopback", arguments->plain_beyond_loopback,
                "Allow unencrypted connections from other machines");
  run->add_flag("--verbose", arguments->verbose, "Log what the server does to standard error");
  run->callback([arguments, &exit_code] { exit_code = run_tournament(*arguments); });
}

}  // namespace

void add_tournament_command(CLI::App& app, int& exit_code) {
  CLI::App* tournament =
      app.add_subcommand("tournament", "Play tournaments, here or at a running server");
  tournament->require_subcommand(1);
  add_run(*tournament, exit_code);
  add_tournament_calls(*tournament, exit_code);
}

}  // namespace poolhall::app
