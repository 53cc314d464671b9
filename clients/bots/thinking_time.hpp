// How long to think about a turn: a share of the clock that leaves enough for the shots to come.
//
//   std::chrono::microseconds time = thinking_time(turn);
#pragma once

#include <chrono>

#include "clients/cpp/player.hpp"

namespace poolhall::bots {

// Never more than what is safe: the clock and the cap on a turn less a reserve for the way to the
// server. Not more than `longest_thought` however much there is.
[[nodiscard]] std::chrono::microseconds thinking_time(const client::TurnView& turn);

inline constexpr std::chrono::seconds longest_thought{6};

}  // namespace poolhall::bots
