// The weakest house bot: any legal move. Heading, speed, placement, call and decision are drawn at
// random; what is drawn can always be played.
//
//   std::unique_ptr<client::Player> player = std::make_unique<RandomBot>(info, seed);
#pragma once

#include <cstdint>
#include <optional>

#include "clients/bots/dice.hpp"
#include "clients/cpp/player.hpp"

namespace poolhall::bots {

class RandomBot : public client::Player {
 public:
  RandomBot(const client::GameInfo& info, std::uint64_t seed);

  [[nodiscard]] client::Move choose(const client::TurnView& turn) override;

 private:
  Dice::Key key_;
};

// A random shot that can be played, or nothing where none was found in a great many draws.
[[nodiscard]] std::optional<client::Shot> random_shot(const client::TurnView& turn, Dice& dice);

// A random cue ball position that the turn allows; nothing if the cue ball is not in hand.
[[nodiscard]] std::optional<physics::Vec2<double>> random_placement(const client::TurnView& turn,
                                                                    Dice& dice);

[[nodiscard]] constexpr bool is_ball_in_hand(rules::TurnKind kind) {
  return kind == rules::TurnKind::break_shot || kind == rules::TurnKind::ball_in_hand ||
         kind == rules::TurnKind::ball_in_hand_behind_head_string;
}

}  // namespace poolhall::bots
