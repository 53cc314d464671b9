// Plays without thinking: a legal call, a stroke in a random direction from above whatever lies
// near, the cue ball at a free place. The same turn of the same game gets the same answer. Games
// played so come to their ends, and cost the player next to nothing.
//
//   protocol::Request answer = quick_answer(turn, felt, seed);   // a Shot or a Decide
#pragma once

#include <cstdint>
#include <string_view>

#include "clients/load/seen_line.hpp"
#include "protocol/messages.hpp"

namespace poolhall::load {

// Where a cue ball can be, m. Of the `olympiad` table unless told otherwise.
struct Felt {
  double width = 1.116;
  double length = 2.236;
  double head_string = 0.559;
  double ball_radius = 0.028575;
};
// Out of a game.start or game.state.
[[nodiscard]] Felt felt_in(std::string_view line);

[[nodiscard]] protocol::Request quick_answer(const SeenTurn& turn, const Felt& felt,
                                             std::uint64_t seed);

}  // namespace poolhall::load
