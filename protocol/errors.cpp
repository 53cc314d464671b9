#include "protocol/errors.hpp"

#include <algorithm>
#include <array>

namespace poolhall::protocol {
namespace {

using enum ErrorCode;

constexpr std::array registry{
    ErrorEntry{parse_error, "parse_error", false, "The line is not JSON within the bounds."},
    ErrorEntry{invalid_request, "invalid_request", false,
               "The line is JSON but no JSON-RPC 2.0 request."},
    ErrorEntry{method_not_found, "method_not_found", false, "There is no such method."},
    ErrorEntry{invalid_params, "invalid_params", false,
               "A parameter is missing, of the wrong type or out of its range."},
    ErrorEntry{internal, "internal", true, "The server failed; nothing was done."},
    ErrorEntry{unauthorized, "unauthorized", false, "The token belongs to no agent."},
    ErrorEntry{unsupported_protocol, "unsupported_protocol", false,
               "There is no common protocol version; the connection is closed."},
    ErrorEntry{name_taken, "name_taken", false, "Another agent has this name."},
    ErrorEntry{server_full, "server_full", true,
               "The server, or your address, has as many connections as it may; closed."},
    ErrorEntry{rate_limited, "rate_limited", true, "Too many messages in too short a time."},
    ErrorEntry{unknown_game, "unknown_game", false, "You play no game with this id."},
    ErrorEntry{not_your_turn, "not_your_turn", false, "It is the other player's turn."},
    ErrorEntry{stale_turn, "stale_turn", false, "That turn is over, or has not come yet."},
    ErrorEntry{conflicting_shot, "conflicting_shot", false,
               "The same shot_id stands for a shot with another content."},
    ErrorEntry{bad_shot, "bad_shot", false, "The stroke is impossible."},
    ErrorEntry{bad_cue_ball_position, "bad_cue_ball_position", false,
               "The cue ball may not be placed there, or not at all."},
    ErrorEntry{bad_call, "bad_call", false, "That may not be called in this state."},
    ErrorEntry{bad_decision, "bad_decision", false, "That choice is not offered."},
    ErrorEntry{unknown_agent, "unknown_agent", false,
               "There is no agent of that name, or it cannot be challenged now."},
    ErrorEntry{unknown_tournament, "unknown_tournament", false,
               "There is no tournament with this id."},
    ErrorEntry{tournament_closed, "tournament_closed", false,
               "The tournament takes no more entries, or lets nobody go any more."},
    ErrorEntry{superseded, "superseded", false,
               "A newer connection has logged in with this token; do not reconnect. Told by the "
               "notification."},
    ErrorEntry{shutting_down, "shutting_down", true,
               "The server is stopping; games go on when it is back."},
    ErrorEntry{line_too_long, "line_too_long", false, "The line is longer than the limit."},
    ErrorEntry{too_slow, "too_slow", true,
               "The login or a started line was not finished in time; closed."},
    ErrorEntry{too_many_errors, "too_many_errors", false,
               "Too many bad lines in a row; the connection is closed."},
    ErrorEntry{not_logged_in, "not_logged_in", false,
               "This method needs `hello` and then `login` or `register` first."},
    ErrorEntry{already_logged_in, "already_logged_in", false,
               "This connection has said hello or has logged in before."},
    ErrorEntry{bad_name, "bad_name", false,
               "A name is 1 to 32 of A-Z a-z 0-9 . _ -, not . or .. alone."},
    ErrorEntry{unknown_challenge, "unknown_challenge", false,
               "There is no challenge with this id for you."},
    ErrorEntry{game_over, "game_over", false, "The game is over."},
    ErrorEntry{conflicting_request, "conflicting_request", false,
               "The same request was made before with another content."},
    ErrorEntry{registration_closed, "registration_closed", false,
               "The host adds agents; ask for a token."},
    ErrorEntry{paused, "paused", true,
               "The server cannot store anything at the moment; the game waits."},
    ErrorEntry{unread_output, "unread_output", true,
               "You did not read what the server sent; the connection is closed."},
};

ErrorCode code_of(rules::RefusalCode code) {
  switch (code) {
    case rules::RefusalCode::bad_shot:
      return bad_shot;
    case rules::RefusalCode::bad_call:
      return bad_call;
    case rules::RefusalCode::bad_cue_ball_position:
      return bad_cue_ball_position;
    case rules::RefusalCode::bad_decision:
      return bad_decision;
    case rules::RefusalCode::bad_state:
    case rules::RefusalCode::bad_event_log:
      break;
  }
  return internal;
}

}  // namespace

std::span<const ErrorEntry> error_registry() {
  return registry;
}

const ErrorEntry& entry(ErrorCode code) {
  const auto* found = std::find_if(registry.begin(), registry.end(),
                                   [&](const ErrorEntry& e) { return e.code == code; });
  return found == registry.end() ? entry(internal) : *found;
}

std::string_view name(ErrorCode code) {
  return entry(code).name;
}

std::optional<ErrorCode> error_code(std::string_view name) {
  const auto* found = std::find_if(registry.begin(), registry.end(),
                                   [&](const ErrorEntry& e) { return e.name == name; });
  return found == registry.end() ? std::nullopt : std::optional(found->code);
}

std::optional<ErrorCode> error_code(std::int64_t number) {
  const auto* found = std::find_if(registry.begin(), registry.end(), [&](const ErrorEntry& e) {
    return static_cast<std::int64_t>(e.code) == number;
  });
  return found == registry.end() ? std::nullopt : std::optional(found->code);
}

Error error_from(const rules::Refusal& refusal, std::string_view prefix) {
  return {code_of(refusal.code), std::string(prefix) + refusal.field, refusal.reason, {}, false};
}

Error error_from(const physics::Error& error, std::string_view prefix) {
  return {bad_shot, std::string(prefix) + error.field, error.reason, {}, false};
}

}  // namespace poolhall::protocol
