#include "tests/bench/server/server_bench.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/json_node.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/bench/server/metrics.hpp"
#include "tests/bench/server/place.hpp"
#include "tests/bench/server/terms.hpp"
#include "tests/support/process/server_process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::bench {
namespace {

using protocol::JsonValue;
using test_support::Child;
using test_support::ServerProcess;

constexpr double goal_bytes_an_agent = 16 * 1024;
constexpr double goal_shots_a_second = 5'000;
constexpr double goal_p99_ms = 10;

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 300> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

// What the generator is told to do.
struct Scene {
  std::string title;
  std::uint32_t games = 0;
  std::uint32_t idle = 0;
  double answers_a_second = 0;  // 0: closed loop
};

struct Measured {
  double resident_before = 0;  // bytes, without an agent
  double resident_with_all = 0;
  Metrics before;
  Metrics after;
  double seconds = 0;
  double shots = 0;
  double answers = 0;
  double unanswered = 0;
  double p50 = 0, p90 = 0, p99 = 0, p999 = 0, most = 0;  // ms
  double wire_out = 0;                                   // bytes a shot, from the server
  double wire_in = 0;
  double errors = 0;
  std::vector<std::string> raised;  // limits, by the generator
  double generator_cpu = 0;         // seconds, of its whole life
  double stored_bytes_a_turn = 0;

  [[nodiscard]] double spent(const std::string& metric) const {
    return after.at(metric) - before.at(metric);
  }
};

double number_of(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.member(key);
  if (value == nullptr) {
    throw std::runtime_error("the generator did not tell its " + std::string(key));
  }
  if (const auto* whole = value->as<std::int64_t>()) {
    return static_cast<double>(*whole);
  }
  if (const auto* natural = value->as<std::uint64_t>()) {
    return static_cast<double>(*natural);
  }
  const auto* real = value->as<double>();
  return real == nullptr ? 0 : *real;
}

void read_report(const std::string& line, Measured& measured) {
  const auto report = protocol::parse_json(line, protocol::document_bounds);
  if (!report) {
    throw std::runtime_error("the generator said: " + line);
  }
  if (const JsonValue* failure = report->member("failure");
      failure != nullptr && !failure->is_null()) {
    throw std::runtime_error("no figures: " + line);
  }
  measured.seconds = number_of(*report, "seconds");
  measured.shots = number_of(*report, "shots");
  measured.answers = number_of(*report, "answers");
  measured.unanswered = number_of(*report, "unanswered");
  const JsonValue& latency = *report->member("latency_ms");
  measured.p50 = number_of(latency, "p50");
  measured.p90 = number_of(latency, "p90");
  measured.p99 = number_of(latency, "p99");
  measured.p999 = number_of(latency, "p99.9");
  measured.most = number_of(latency, "max");
  measured.wire_out = number_of(*report, "bytes_in") / measured.shots;
  measured.wire_in = number_of(*report, "bytes_out") / measured.shots;
  if (const auto* raised = report->member("raised")->as<protocol::JsonArray>()) {
    for (const JsonValue& limit : *raised) {
      measured.raised.push_back(*limit.as<std::string>());
    }
  }
  if (const auto* errors = report->member("errors")->as<protocol::JsonObject>()) {
    for (const auto& [code, count] : *errors) {
      measured.errors += number_of(*report->member("errors"), code);
    }
  }
}

double stored_turns(const std::filesystem::path& database) {
  const auto reader = storage::open_sqlite_reader(database);
  if (!reader) {
    throw std::runtime_error(reader.error().reason);
  }
  double turns = 0;
  const auto ids = (*reader)->game_ids();
  for (const protocol::GameId id : ids.value()) {
    turns += (*reader)->game(id).value()->turns;
  }
  const auto unfinished = (*reader)->unfinished_games();
  for (const storage::UnfinishedGame& game : unfinished.value()) {
    turns += game.last_turn ? game.last_turn->number : 0;
  }
  return turns;
}

std::vector<std::string> generator(const ServerBenchOptions& options, const Scene& scene,
                                   std::uint16_t port) {
  std::vector<std::string> arguments{options.program.string(),
                                     "load",
                                     "--json",
                                     "--stages",
                                     "--connect",
                                     "127.0.0.1:" + std::to_string(port),
                                     "--games",
                                     std::to_string(scene.games),
                                     "--idle",
                                     std::to_string(scene.idle),
                                     "--seconds",
                                     std::to_string(options.seconds)};
  if (scene.answers_a_second > 0) {
    arguments.insert(arguments.end(), {"--rate", std::to_string(scene.answers_a_second)});
  }
  return arguments;
}

Measured run(const ServerBenchOptions& options, const Scene& scene,
             const std::filesystem::path& directory) {
  const std::filesystem::path config = directory / "settings.toml";
  std::ofstream(config) << server_settings;
  ServerProcess server({.program = options.program,
                        .directory = directory,
                        .more_arguments = {"--config", config.string()}});
  Measured measured;
  const auto resident = [&] {
    return metrics_at(server.http_port()).at("poolhall_process_resident_memory_bytes");
  };
  measured.resident_before = resident();
  Child load(generator(options, scene, server.port()), {.output = Child::Output::pipe});
  while (const auto line = load.read_line()) {
    if (*line == "logged_in") {
      measured.resident_with_all = resident();
    } else if (*line == "measuring") {
      measured.before = metrics_at(server.http_port());
    } else if (*line == "measured") {
      measured.after = metrics_at(server.http_port());
    } else {
      read_report(*line, measured);
    }
  }
  measured.generator_cpu = std::chrono::duration<double>(load.wait().cpu).count();
  server.terminate();
  const std::filesystem::path database = directory / "server.db";
  measured.stored_bytes_a_turn =
      static_cast<double>(std::filesystem::file_size(database)) / stored_turns(database);
  return measured;
}

void print_shares(const Measured& measured, std::ostream& out) {
  const double all = measured.spent("poolhall_process_cpu_seconds_total");
  out << formatted("  the server's time: %.0f us a shot", 1e6 * all / measured.shots);
  double told = 0;
  const std::string opening = "poolhall_cpu_seconds_total{area=\"";
  for (const auto& [key, value] : measured.after) {
    if (key.starts_with(opening)) {
      const double spent = measured.spent(key);
      told += spent;
      out << formatted(", %s %.0f %%",
                       key.substr(opening.size(), key.size() - opening.size() - 2).c_str(),
                       100 * spent / all);
    }
  }
  out << formatted(", the rest %.0f %%\n", 100 * (all - told) / all);
}

void print(const Scene& scene, const Measured& measured, std::ostream& out) {
  out << scene.title << '\n';
  for (const std::string& line : measured.raised) {
    out << "  the generator raised its " << line << '\n';
  }
  out << formatted("  %.0f durable shots/s (%.0f answers/s), %.0f errors, %.0f unanswered\n",
                   measured.shots / measured.seconds, measured.answers / measured.seconds,
                   measured.errors, measured.unanswered)
      << formatted("  latency ms: p50 %.2f  p90 %.2f  p99 %.2f  p99.9 %.2f  max %.2f\n",
                   measured.p50, measured.p90, measured.p99, measured.p999, measured.most);
  print_shares(measured, out);
  out << formatted(
      "  %.1f turns a commit; bytes a shot: %.0f on the wire to both agents, %.0f from"
      " them, %.0f in the database\n",
      measured.spent("poolhall_writes_total") / measured.spent("poolhall_commits_total"),
      measured.wire_out, measured.wire_in, measured.stored_bytes_a_turn);
}

bool goal(std::ostream& out, const std::string& what, bool met) {
  out << "  " << (met ? "goal met: " : "GOAL MISSED: ") << what << '\n';
  return met;
}

bool idle_and_playing(const ServerBenchOptions& options, const std::filesystem::path& directory,
                      std::ostream& out) {
  const Scene scene{
      formatted("%u idle agents while %u play in closed loop", options.idle, 2 * options.games),
      options.games, options.idle};
  const Measured measured = run(options, scene, directory);
  print(scene, measured, out);
  const double agents = options.idle + 2.0 * options.games;
  const double each = (measured.resident_with_all - measured.resident_before) / agents;
  return goal(out,
              formatted("%.1f KiB of memory an agent that is logged in (at most 16)", each / 1024),
              each <= goal_bytes_an_agent);
}

bool closed_loop(const ServerBenchOptions& options, const std::filesystem::path& directory,
                 std::ostream& out) {
  const Scene scene{formatted("closed loop, %u games", options.games), options.games, 0};
  const Measured measured = run(options, scene, directory);
  print(scene, measured, out);
  return goal(out, "at least 5000 durable shots/s",
              measured.shots / measured.seconds >= goal_shots_a_second && measured.errors == 0);
}

bool open_loop(const ServerBenchOptions& options, const std::filesystem::path& directory,
               std::ostream& out) {
  const Scene scene{
      formatted("open loop, %u games, %.0f shots/s wanted", options.paced_games, options.rate),
      options.paced_games, 0, answers_a_shot * options.rate};
  const Measured measured = run(options, scene, directory);
  print(scene, measured, out);
  const bool in_pace = goal(out, formatted("at least %.0f shots/s stored", options.rate),
                            measured.shots / measured.seconds >= options.rate);
  return goal(out, "p99 at most 10 ms from the scheduled time",
              measured.p99 <= goal_p99_ms && measured.errors == 0) &&
         in_pace;
}

}  // namespace

bool bench_server(const ServerBenchOptions& options, std::ostream& out) {
  const std::filesystem::path place = place_on_disk(options.directory);
  out << "databases in " << place.string() << (is_in_memory(place) ? " (in memory!)" : " (a disk)")
      << ", " << std::thread::hardware_concurrency()
      << " cores for server and generator; limits raised: connections and connections of an address"
         " to 1000000; the server raises its file descriptors to what the system allows\n";
  bool met = true;
  for (const auto scene : {closed_loop, open_loop, idle_and_playing}) {
    const test_support::TemporaryDirectory directory(place);
    met = scene(options, directory.path(), out) && met;
  }
  return met;
}

}  // namespace poolhall::bench
