// Game states, calls and rulings as JSON and back, bit for bit.
//
//   std::string text = encode_state(state);
//   Expected<rules::GameState> again = decode_state(text);   // == state
//
// Reading checks the form only; whether a state is possible is rules::check_state's answer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/errors.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::protocol {

[[nodiscard]] std::string encode_state(const rules::GameState& state);
[[nodiscard]] Expected<rules::GameState> decode_state(std::string_view text);

// null | "safety" | "push_out" | {"ball": n, "pocket": name}
[[nodiscard]] std::string encode_call(const rules::Call& call);
[[nodiscard]] Expected<rules::Call> decode_call(std::string_view text);

// What a ruling says of the turn to come; the complete state stands beside the ruling.
struct NextTurn {
  std::uint32_t turn = 0;
  rules::Seat to_move = rules::Seat::first;
  rules::TurnKind kind = rules::TurnKind::shot;
  std::vector<rules::Decision> options;       // when kind is decision
  std::optional<rules::GameResult> result{};  // the game is over
};

// A ruling as agents read it.
struct RulingReport {
  bool legal = true;
  std::vector<rules::FoulRecord> fouls;
  std::vector<rules::PocketedBall> pocketed;
  std::vector<rules::BallId> driven_off;
  std::optional<rules::BallId> first_contact{};
  std::vector<rules::Finding> notes;
  NextTurn next;
};

[[nodiscard]] std::string encode_ruling(const rules::Ruling& ruling);
[[nodiscard]] Expected<RulingReport> decode_ruling(std::string_view text);

}  // namespace poolhall::protocol
