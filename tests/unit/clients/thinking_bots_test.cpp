// What every house bot that thinks can do.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "clients/bots/house_bots.hpp"
#include "placed_balls.hpp"

namespace poolhall::bots::thinking_tests {
namespace {

class ThinkingBot : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] client::Shot chosen(const rules::GameState& state) const {
    const auto player = house_bot(GetParam(), {.effort = 60'000}).value()(game_);
    return std::get<client::Shot>(player->choose({game_, state}));
  }

  const client::GameInfo game_ = info("none");
};

TEST_P(ThinkingBot, StrikesABallOutsideFirstFromTheKitchen) {
  const auto state = table_with(
      {{0, {0.558, 0.3}}, {1, {0.3, 0.2}}, {2, {0.558, 1.6}}, {8, {0.9, 1.2}}, {9, {0.8, 0.9}}},
      rules::TurnKind::ball_in_hand_behind_head_string);
  const auto shot = chosen(state);
  ASSERT_TRUE(shot.cue_ball);
  EXPECT_LT(shot.cue_ball->y, game_.table.head_string);
  EXPECT_TRUE(played_exactly(game_, state, shot).legal);
}

TEST_P(ThinkingBot, PlaysALegalShotFromBehindOtherBalls) {
  const auto state = table_with({{0, {0.558, 0.3}},
                                 {1, {0.558, 1.9}},
                                 {8, {0.5, 1.0}},
                                 {9, {0.558, 1.0}},
                                 {10, {0.616, 1.0}}});
  EXPECT_TRUE(played_exactly(game_, state, chosen(state)).legal);
}

TEST_P(ThinkingBot, BreaksLegally) {
  const auto state = rules::new_game({}, game_.table, game_.materials);
  EXPECT_TRUE(played_exactly(game_, state, chosen(state)).legal);
}

INSTANTIATE_TEST_SUITE_P(Bots, ThinkingBot, testing::Values("greedy", "planner"),
                         [](const auto& bot) { return bot.param; });

}  // namespace
}  // namespace poolhall::bots::thinking_tests
