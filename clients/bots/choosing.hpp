// A turn of a house bot that thinks: the decision of most worth, or its best shot; a random one
// where it finds none or its best was refused.
//
//   return chosen_move(turn, {.worth = ..., .best_shot = ...}, Dice(key, turn.state.turn));
#pragma once

#include <functional>
#include <optional>

#include "clients/bots/dice.hpp"
#include "clients/cpp/player.hpp"

namespace poolhall::bots {

struct Thoughts {
  // What a decision leaves, to this player.
  std::function<double(const rules::GameState&)> worth;
  std::function<std::optional<client::Shot>()> best_shot;
};

[[nodiscard]] client::Move chosen_move(const client::TurnView& turn, const Thoughts& thoughts,
                                       Dice last_resort);

}  // namespace poolhall::bots
