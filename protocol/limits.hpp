// Every limit of the protocol with its default, in one place. The server may be configured to
// others; hello's reply tells those that concern an agent.
//
//   Limits limits;
//   limits.messages_per_second = 10'000;   // a load test
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace poolhall::protocol {

struct Limits {
  // Lines and their JSON.
  std::size_t line_bytes = 64 * 1024;  // of an agent's line, without its end
  std::size_t line_bytes_before_login = 4 * 1024;
  std::size_t server_line_bytes = 1024 * 1024;  // of a server's line
  std::size_t nesting = 16;                     // arrays and objects within each other
  std::size_t keys = 256;                       // in all objects of a line together

  // Time to get going.
  std::chrono::milliseconds login_deadline{5'000};  // from accept to the end of login
  std::chrono::milliseconds line_deadline{10'000};  // from the first byte of a line to its end

  // Rates and counts.
  double messages_per_second = 50;
  double message_burst = 100;
  std::uint32_t bad_lines_in_a_row = 20;  // this many close the connection
  std::uint32_t connections_per_address = 32;
  std::uint32_t connections = 12'000;                  // in all; more get server_full
  std::chrono::milliseconds takeover_interval{1'000};  // between two logins with one token
  std::size_t untold_ends = 256;  // of each kind, told again after a login; the latest

  // What is read from one connection; what comes faster waits in the sender's system.
  std::size_t input_bytes_per_second = 256 * 1024;
  std::size_t input_burst_bytes = 1024 * 1024;

  // Queues.
  std::size_t output_queue_bytes = 4 * 1024 * 1024;
  // All connections' together; beyond it whoever leaves most unread is dropped sooner.
  std::size_t output_bytes_in_all = 512 * 1024 * 1024;
  std::size_t spectator_queue_bytes = 256 * 1024;
  std::chrono::milliseconds tcp_user_timeout{30'000};

  // Words.
  std::size_t name_length = 32;         // of [A-Za-z0-9._-], at least 1
  std::size_t shot_id_length = 64;      // characters of a shot_id or challenge_id
  std::size_t client_name_length = 64;  // bytes of hello's client name and version

  // Games.
  std::uint32_t max_refusals = 3;  // in a turn; the last is a foul
  std::chrono::milliseconds challenge_expiry{60'000};
  std::chrono::milliseconds reveal_deadline{5'000};
  std::chrono::milliseconds entry_deadline{600'000};   // a tournament's, for agents to register
  std::chrono::milliseconds arrival_deadline{60'000};  // for both to come to a new game
  std::chrono::milliseconds return_deadline{10'000};   // after a restart, for the one to move
  std::chrono::microseconds lag_credit_per_turn{100'000};
  std::chrono::microseconds lag_credit_per_game{5'000'000};
};

// The JSON bounds alone, for whoever reads something else than an agent's line.
struct JsonBounds {
  std::size_t nesting;
  std::size_t keys;
};
[[nodiscard]] constexpr JsonBounds json_bounds(const Limits& limits) {
  return {limits.nesting, limits.keys};
}

}  // namespace poolhall::protocol
