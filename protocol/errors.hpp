// Every refusal and every reason for closing a connection: a number, a stable name, whether the
// same thing may be tried again, one line of documentation.
//
//   return tl::unexpected(Error{ErrorCode::unknown_game, "/params/game", "got 17, which is none of
//                                your games", GameId{17}});
//   std::string_view code = name(ErrorCode::stale_turn);   // "stale_turn"
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "physics/expected.hpp"
#include "protocol/ids.hpp"
#include "rules/referee.hpp"

namespace poolhall::protocol {

enum class ErrorCode : std::int32_t {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal = -32603,

  unauthorized = -32000,
  unsupported_protocol = -32001,
  name_taken = -32002,
  server_full = -32003,
  rate_limited = -32004,
  unknown_game = -32005,
  not_your_turn = -32006,
  stale_turn = -32007,
  conflicting_shot = -32008,
  bad_shot = -32009,
  bad_cue_ball_position = -32010,
  bad_call = -32011,
  bad_decision = -32012,
  unknown_agent = -32013,
  unknown_tournament = -32014,
  tournament_closed = -32015,
  superseded = -32016,
  shutting_down = -32017,
  line_too_long = -32018,
  too_slow = -32019,
  too_many_errors = -32020,
  not_logged_in = -32021,
  already_logged_in = -32022,
  bad_name = -32023,
  unknown_challenge = -32024,
  game_over = -32025,
  conflicting_request = -32026,
  registration_closed = -32027,
  paused = -32028,
  unread_output = -32029,
};

struct ErrorEntry {
  ErrorCode code;
  std::string_view name;
  bool retryable;            // the same request may succeed later without being changed
  std::string_view meaning;  // one line
};

// The registry, in the order of the enumeration.
[[nodiscard]] std::span<const ErrorEntry> error_registry();
[[nodiscard]] const ErrorEntry& entry(ErrorCode code);
[[nodiscard]] std::string_view name(ErrorCode code);
[[nodiscard]] std::optional<ErrorCode> error_code(std::string_view name);
[[nodiscard]] std::optional<ErrorCode> error_code(std::int64_t number);

struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string field;   // JSON Pointer into the agent's line or the file, "" for the whole
  std::string reason;  // one line: what came and what was expected
  std::optional<GameId> game{};
  bool foul = false;  // this refusal was the turn's last: a foul, and the turn is over
};

template <class T>
using Expected = tl::expected<T, Error>;

// What the referee and the simulator refuse, as an error of the wire. Their fields are pointers
// into what they were given; `prefix` is where that stands in the line ("/params").
[[nodiscard]] Error error_from(const rules::Refusal& refusal, std::string_view prefix);
[[nodiscard]] Error error_from(const physics::Error& error, std::string_view prefix);

}  // namespace poolhall::protocol
