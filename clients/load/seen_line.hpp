// What of a server's line matters to a player that does not think, found without building values of
// the rest: a generator of load must cost much less than the server that it loads. For lines of
// this project's server, whose members come in the order of protocol/README.md.
//
//   const SeenLine seen = look_at(line);
//   if (seen.kind == LineKind::turn) answer(turn_in(line));
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "physics/vector.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::load {

enum class LineKind : std::uint8_t {
  reply,
  error,
  turn,
  offer,
  start,
  state,
  game_over,
  match_over,
  lag,
  superseded,
  other,
};

struct SeenLine {
  LineKind kind = LineKind::other;
  std::int64_t id = 0;  // of a reply or an error; 0: none
};
[[nodiscard]] SeenLine look_at(std::string_view line);

// The whole number after the first `"key":`; nothing if there is none.
[[nodiscard]] std::optional<std::int64_t> integer_in(std::string_view line, std::string_view key);
// The string after the first `"key":"`, as it stands; empty if there is none.
[[nodiscard]] std::string_view word_in(std::string_view line, std::string_view key);
// The name of an error's code; "unknown" where the line has no data.
[[nodiscard]] std::string_view error_code_in(std::string_view line);

struct SeenTurn {
  std::int64_t game = 0;
  std::uint32_t turn = 0;
  std::uint32_t refusals = 0;
  rules::TurnKind kind = rules::TurnKind::shot;
  std::vector<rules::Decision> decisions;    // of a decision
  std::vector<rules::BallId> balls;          // that may be called
  bool calls_pockets = false;                // a call of ball and pocket may be made
  std::vector<physics::Vec2<double>> taken;  // m, object balls; where the cue ball is in hand
};
// Nothing if a member is missing.
[[nodiscard]] std::optional<SeenTurn> turn_in(std::string_view line);

}  // namespace poolhall::load
