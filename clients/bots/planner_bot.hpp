// The strongest house bot: searches under the announced noise for the shot with the best chance to
// win the game, its own next shot and the opponent's reply included (planner.hpp).
//
//   std::unique_ptr<client::Player> player = std::make_unique<PlannerBot>(info, PlannerSettings{});
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "clients/bots/dice.hpp"
#include "clients/bots/planner.hpp"
#include "clients/cpp/player.hpp"

namespace poolhall::bots {

struct PlannerSettings {
  std::uint64_t seed = 1;
  // Simulated events a shot may cost, about; unset: what the clock allows. With it the same seed
  // plays the same game, unless the clock runs short.
  std::optional<std::uint64_t> effort{};
  unsigned cores = 1;
};

class PlannerBot : public client::Player {
 public:
  PlannerBot(const client::GameInfo& info, const PlannerSettings& settings);

  [[nodiscard]] client::Move choose(const client::TurnView& turn) override;

 private:
  [[nodiscard]] std::optional<client::Shot> best_shot(const client::TurnView& turn);

  // A new planner where the noise is hidden and turns out to be another one than reckoned with.
  void reckon_noise(const client::TurnView& turn);

  PlannerSettings settings_;
  Dice::Key key_;
  protocol::NoiseParams noise_;
  std::unique_ptr<Planner> planner_;
  double events_a_second_;
};

}  // namespace poolhall::bots
