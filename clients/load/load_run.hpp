// Loads a server: agents that log in and do nothing, and pairs that play one game after another
// without thinking. In closed loop a turn is answered when it comes. In open loop each game has a
// time-table, and a latency counts from the scheduled moment, whatever kept the answer from being
// sent then: a server that stalls is charged for all that should have been sent meanwhile.
//
//   LoadReport report = run_load({.server = endpoint, .games = 64, .seconds = 20});
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/load/latencies.hpp"
#include "clients/load/link.hpp"
#include "protocol/events_json.hpp"

namespace poolhall::load {

struct LoadOptions {
  boost::asio::ip::tcp::endpoint server;
  std::uint32_t games = 64;
  std::uint32_t idle = 0;        // agents that are logged in and do nothing else
  double seconds = 10;           // measured
  double warm_up = 2;            // seconds before, with all games going on
  std::optional<double> rate{};  // answers a second in all games together; unset: closed loop
  protocol::EventDetail detail = protocol::EventDetail::summary;
  std::string noise = "olympiad";
  std::uint64_t seed = 1;
  std::string prefix;  // of the agents' names; unset: drawn
  // All idle agents are in and the games are about to begin; for whoever measures the server.
  std::function<void(std::string_view stage)> on_stage{};
};

struct LoadReport {
  double seconds = 0;
  std::uint64_t shots = 0;    // answered with a stored shot
  std::uint64_t answers = 0;  // to turns: shots, decisions and refused ones
  std::uint64_t games_over = 0;
  std::uint64_t unanswered = 0;  // at the end; their ages are among the latencies
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::map<std::string, std::uint64_t> refusals;  // by code, of answers to turns: the game's rules
  std::map<std::string, std::uint64_t> errors;    // by code: what should not come at all
  Latencies latencies;
  std::vector<std::string> raised;       // limits, one line each
  std::optional<std::string> failure{};  // why there is no figure
};

[[nodiscard]] LoadReport run_load(const LoadOptions& options);

// Lines for a person.
[[nodiscard]] std::string text_of(LoadReport& report);
// One JSON object, for a program that started this one.
[[nodiscard]] std::string json_of(LoadReport& report);

}  // namespace poolhall::load
