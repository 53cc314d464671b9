#include "tests/bench/server/spectators_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/json_node.hpp"
#include "tests/bench/server/audience.hpp"
#include "tests/bench/server/metrics.hpp"
#include "tests/bench/server/place.hpp"
#include "tests/bench/server/terms.hpp"
#include "tests/support/process/server_process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::bench {
namespace {

using test_support::Child;
using test_support::ServerProcess;

constexpr double most_ratio = 1.10;
constexpr double long_enough = 86'400;  // seconds, of the watched game's agents
constexpr int warm_up = 4;              // seconds: the spectators take their seats
// A window in which the watched game ends is no window with spectators: it is run again.
constexpr double least_of_turns = 0.75;
constexpr int most_trials = 5;

struct Window {
  double p50 = 0;  // ms
  double p99 = 0;
  double shots_a_second = 0;
  double server_cpu = 0;  // seconds a second
  Audience::Told told{};
};

std::vector<std::string> generator(const SpectatorsBenchOptions& options, std::uint16_t port,
                                   std::uint32_t games, double rate, double seconds) {
  return {options.program.string(),
          "load",
          "--json",
          "--stages",
          "--connect",
          fmt::format("127.0.0.1:{}", port),
          "--games",
          std::to_string(games),
          "--rate",
          std::to_string(answers_a_shot * rate),
          "--seconds",
          std::to_string(seconds),
          "--warm-up",
          std::to_string(warm_up)};
}

void read_report(const std::string& line, Window& window) {
  const auto report = protocol::parse_json(line, protocol::document_bounds);
  if (!report) {
    throw std::runtime_error("the generator said: " + line);
  }
  protocol::Reading reading(*report);
  const auto root = reading.root();
  window.p50 = root.at("latency_ms").at("p50").number();
  window.p99 = root.at("latency_ms").at("p99").number();
  window.shots_a_second = root.at("shots").number() / root.at("seconds").number();
  if (!reading.ok() || root.find("failure")) {
    throw std::runtime_error("no figures: " + line);
  }
}

struct LiveGame {
  std::int64_t number = 0;
  std::string agent;  // the first of the two
};

std::vector<LiveGame> live_games(std::uint16_t port) {
  const auto live = protocol::parse_json(body_at(port, "/api/live"), protocol::document_bounds);
  if (!live) {
    throw std::runtime_error("the server does not tell which games go on");
  }
  protocol::Reading reading(*live);
  std::vector<LiveGame> games;
  for (const auto& game : reading.root().at("games").elements()) {
    games.push_back(
        {game.at("game").integer<std::int64_t>(), game.at("agents").elements(2).front().string()});
  }
  return games;
}

bool are_rivals(const std::string& agent, const std::string& other) {
  return agent.substr(0, agent.find('-')) == other.substr(0, other.find('-'));
}

class Run {
 public:
  Run(const SpectatorsBenchOptions& options, const std::filesystem::path& directory)
      : options_(options),
        server_({.program = options.program,
                 .directory = directory,
                 .more_arguments = {"--config", settings_file(directory)}}),
        watched_(generator(options, server_.port(), 1, options.watched_rate, long_enough),
                 {.output = Child::Output::pipe}) {
    while (const auto line = watched_.read_line()) {
      if (*line == "measuring") {
        watched_agent_ = live_games(server_.http_port()).at(0).agent;
        return;
      }
    }
    throw std::runtime_error("the watched game did not begin");
  }

  Window window(std::uint32_t spectators) {
    for (int trial = 0; trial < most_trials; ++trial) {
      const Window found = measured(spectators);
      const double wanted = least_of_turns * options_.watched_rate * options_.seconds;
      if (spectators == 0 || static_cast<double>(found.told.fewest) >= wanted) {
        return found;
      }
    }
    throw std::runtime_error("the watched game ended in every window, or was not told");
  }

 private:
  static std::string settings_file(const std::filesystem::path& directory) {
    const std::filesystem::path file = directory / "settings.toml";
    std::ofstream(file) << server_settings;
    return file.string();
  }
  // The game that the watched pair plays now.
  [[nodiscard]] std::int64_t watched_game() const {
    for (const LiveGame& game : live_games(server_.http_port())) {
      if (are_rivals(game.agent, watched_agent_)) {
        return game.number;
      }
    }
    throw std::runtime_error("the watched game does not go on");
  }
  [[nodiscard]] double cpu() const {
    return metrics_at(server_.http_port()).at("poolhall_process_cpu_seconds_total");
  }

  Window measured(std::uint32_t spectators) {
    Window window;
    Child load(generator(options_, server_.port(), options_.games, options_.rate, options_.seconds),
               {.output = Child::Output::pipe});
    std::optional<Audience> audience;
    double before = 0;
    while (const auto line = load.read_line()) {
      if (*line == "logged_in") {
        if (spectators > 0) {
          audience.emplace(server_.http_port(), watched_game(), spectators);
        }
      } else if (*line == "measuring") {
        before = cpu();
      } else if (*line == "measured") {
        window.server_cpu = (cpu() - before) / options_.seconds;
      } else {
        read_report(*line, window);
      }
    }
    load.wait();
    if (audience) {
      window.told = audience->leave();
    }
    return window;
  }

  const SpectatorsBenchOptions& options_;
  ServerProcess server_;
  Child watched_;
  std::string watched_agent_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Figure>
double median_of(const std::vector<Window>& windows, Figure figure) {
  std::vector<double> values;
  for (const Window& window : windows) {
    values.push_back(figure(window));
  }
  return median(values);
}

void print(const Window& window, std::uint32_t spectators, std::ostream& out) {
  out << fmt::format(
      "  {:>5} spectators: {:.0f} shots/s, p50 {:.2f} ms, p99 {:.2f} ms, server {:.2f} cores",
      spectators, window.shots_a_second, window.p50, window.p99, window.server_cpu);
  if (spectators > 0) {
    out << fmt::format(
        "; told {} to {} turns each, {:.0f} MB; the last of them {:.0f} ms after the first "
        "(median, {:.0f} ms at most), {} sent away",
        window.told.fewest, window.told.most, static_cast<double>(window.told.bytes) / 1e6,
        window.told.median_spread_ms, window.told.longest_spread_ms, window.told.gone);
  }
  out << std::endl;
}

}  // namespace

bool bench_spectators(const SpectatorsBenchOptions& options, std::ostream& out) {
  const std::filesystem::path place = place_on_disk(options.directory);
  const test_support::TemporaryDirectory directory(place);
  out << fmt::format(
      "{} spectators of a game with {:.0f} shots/s, {} other games with {:.0f} shots/s in all; "
      "windows of {:.0f} s, database in {}{}\n",
      options.spectators, options.watched_rate, options.games, options.rate, options.seconds,
      place.string(), is_in_memory(place) ? " (in memory!)" : "");
  Run run(options, directory.path());
  std::vector<Window> without;
  std::vector<Window> with;
  for (std::uint32_t i = 0; i < 2 * options.pairs; ++i) {
    // Without, with, with, without: a drift of the machine's pace is in both alike.
    const bool watched = i % 4 == 1 || i % 4 == 2;
    const Window window = run.window(watched ? options.spectators : 0);
    print(window, watched ? options.spectators : 0, out);
    (watched ? with : without).push_back(window);
  }
  const auto p99 = [](const Window& window) { return window.p99; };
  const double alone = median_of(without, p99);
  const double watched = median_of(with, p99);
  const bool met = watched <= most_ratio * alone;
  out << fmt::format(
      "  {}: the players' p99, median of {} windows each: {:.2f} ms without, {:.2f} ms with "
      "spectators, ratio {:.3f} (at most {:.2f})\n",
      met ? "goal met" : "GOAL MISSED", options.pairs, alone, watched, watched / alone, most_ratio);
  return met;
}

}  // namespace poolhall::bench
