// A player for tests: plays what can be played in any turn, the same in the same turn.
//
//   Request answer = scripted_answer(turn);       // a shot or a decision
//   play_until(anna, bert, game, 9);              // turns 1 to 8
#pragma once

#include <cstdint>

#include "protocol/messages.hpp"
#include "wire_client.hpp"

namespace poolhall::net_tests {

using Turn = protocol::GameTurn<protocol::Received>;

[[nodiscard]] protocol::Request scripted_answer(const Turn& turn);
[[nodiscard]] protocol::Shot scripted_shot(const Turn& turn);

// Two agents in one game; `first` is to be in seat 0.
struct Players {
  WireClient& first;
  WireClient& second;

  [[nodiscard]] WireClient& mover(const rules::GameState& state) const {
    return state.to_move == rules::Seat::first ? first : second;
  }
};

// anna challenges bert, who accepts; the game, when both have its start.
[[nodiscard]] protocol::GameId start_game(WireClient& anna, WireClient& bert,
                                          const std::string& bert_name,
                                          const protocol::ClockSettings& clock = {});

// Plays from the first player's pending turn until `last` turns are played or the game is over;
// the state after. The next turn has been pushed to its player and not read.
[[nodiscard]] rules::GameState play_turns(const Players& players, rules::Seat to_move,
                                          std::uint32_t last);

}  // namespace poolhall::net_tests
