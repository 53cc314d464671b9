#include "clients/bots/thinking_time.hpp"

#include <gtest/gtest.h>

namespace poolhall::bots {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

class ThinkingTime : public testing::Test {
 protected:
  ThinkingTime() {
    info_.table = physics::preset_table("olympiad").value();
    info_.materials = physics::preset_materials("olympiad").value();
    state_ = rules::new_game({}, info_.table, info_.materials);
  }

  microseconds time_with(microseconds own) const {
    return thinking_time({info_, state_, {.own = own}});
  }

  client::GameInfo info_;
  rules::GameState state_;
};

TEST_F(ThinkingTime, IsAShareOfTheClockThatLeavesEnoughForTheShotsToCome) {
  EXPECT_GT(time_with(seconds{20}), seconds{1});
  EXPECT_LT(time_with(seconds{20}), seconds{3});
}

TEST_F(ThinkingTime, NeverUsesUpTheClockInAnyNumberOfTurns) {
  microseconds left = seconds{20};
  for (int turn = 0; turn < 500; ++turn) {
    const microseconds time = time_with(left);
    ASSERT_GE(time, microseconds{0});
    left -= time;
    ASSERT_GT(left, milliseconds{100});
  }
}

TEST_F(ThinkingTime, IsNothingWhereNothingIsLeft) {
  EXPECT_EQ(time_with(microseconds{0}), microseconds{0});
  EXPECT_EQ(time_with(milliseconds{100}), microseconds{0});
}

TEST_F(ThinkingTime, StaysWithinTheCapOnATurn) {
  info_.shot_cap = milliseconds{500};
  EXPECT_LE(time_with(seconds{600}), milliseconds{350});
}

TEST_F(ThinkingTime, SpendsTheIncrementAsItComes) {
  const auto without = time_with(seconds{20});
  info_.increment = seconds{2};
  EXPECT_GT(time_with(seconds{20}), without + seconds{1});
  EXPECT_LT(time_with(seconds{1}), seconds{1});
}

TEST_F(ThinkingTime, HasAnEndHoweverMuchThereIs) {
  EXPECT_LE(time_with(std::chrono::hours{1}), longest_thought);
}

}  // namespace
}  // namespace poolhall::bots
