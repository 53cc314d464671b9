#include "clients/cpp/game_desk.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace poolhall::client {
namespace {

using Step = GameDesk::Step;

class NoPlayer : public Player {
 public:
  Move choose(const TurnView&) override { throw std::logic_error("nobody asked me"); }
};

GameDesk desk() {
  return {{.game = "17"}, std::make_unique<NoPlayer>()};
}

TurnTask task(std::uint32_t turn, std::uint32_t refusals = 0) {
  return {{turn, refusals}, {}, {}};
}

Shot shot(double speed) {
  return {.stroke = {.theta = 5, .phi = 90, .v = speed}};
}

const protocol::Shot& shot_of(const GameDesk& desk) {
  return std::get<protocol::Shot>(desk.answer().value());
}

TEST(GameDesk, ThinksOnceAboutATurnThatIsToldTwice) {
  GameDesk game = desk();
  EXPECT_EQ(game.turn_came(task(3)), Step::think);
  EXPECT_EQ(game.turn_came(task(3)), Step::nothing);
}

TEST(GameDesk, SendsTheSameShotAgainWhenTheTurnComesAgain) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  ASSERT_EQ(game.move_chosen({3, 0}, shot(2)), Step::send);
  const protocol::Shot first = shot_of(game);
  EXPECT_EQ(game.turn_came(task(3)), Step::send);
  EXPECT_EQ(shot_of(game), first);
  EXPECT_EQ(first.game, protocol::GameId{17});
  EXPECT_EQ(first.turn, 3U);
}

TEST(GameDesk, ThinksAgainWithAnotherShotIdAfterARefusal) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  ASSERT_EQ(game.move_chosen({3, 0}, shot(2)), Step::send);
  const protocol::Shot first = shot_of(game);
  EXPECT_EQ(game.refused({3, 0}), Step::think);
  EXPECT_EQ(game.task()->key.refusals, 1U);
  ASSERT_EQ(game.move_chosen({3, 1}, shot(2)), Step::send);
  EXPECT_NE(shot_of(game).shot_id, first.shot_id);
}

TEST(GameDesk, TakesTheServersWordForARefusalAsTheOneItKnows) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  ASSERT_EQ(game.move_chosen({3, 0}, shot(2)), Step::send);
  ASSERT_EQ(game.refused({3, 0}), Step::think);
  EXPECT_EQ(game.turn_came(task(3, 1)), Step::nothing);
}

TEST(GameDesk, DropsAThoughtAboutATurnThatIsOverAndTurnsToTheNextOne) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  game.turn_over(3);
  EXPECT_EQ(game.turn_came(task(5)), Step::nothing) << "the player still thinks about turn 3";
  EXPECT_EQ(game.move_chosen({3, 0}, shot(2)), Step::think);
  EXPECT_FALSE(game.answer());
  EXPECT_EQ(game.task()->key.turn, 5U);
  EXPECT_EQ(game.move_chosen({5, 0}, shot(2)), Step::send);
}

TEST(GameDesk, ForgetsAnAnswerOnceItsTurnIsOver) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  ASSERT_EQ(game.move_chosen({3, 0}, shot(2)), Step::send);
  game.turn_over(3);
  EXPECT_FALSE(game.answer());
  EXPECT_EQ(game.turn_came(task(4)), Step::think);
}

TEST(GameDesk, KeepsTheAnswerToALaterTurnWhenAnEarlierReplyIsLate) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(4)), Step::think);
  ASSERT_EQ(game.move_chosen({4, 0}, shot(2)), Step::send);
  game.turn_over(3);
  EXPECT_TRUE(game.answer());
}

TEST(GameDesk, MakesRequestsOfDecisionsAndConcessions) {
  GameDesk game = desk();
  ASSERT_EQ(game.turn_came(task(2)), Step::think);
  ASSERT_EQ(game.move_chosen({2, 0}, rules::Decision::spot_eight), Step::send);
  const auto& decide = std::get<protocol::Decide>(*game.answer());
  EXPECT_EQ(decide.choice, rules::Decision::spot_eight);
  EXPECT_EQ(decide.turn, 2U);
  ASSERT_EQ(game.turn_came(task(3)), Step::think);
  ASSERT_EQ(game.move_chosen({3, 0}, Concede{}), Step::send);
  EXPECT_EQ(std::get<protocol::Concede>(*game.answer()).game, protocol::GameId{17});
}

}  // namespace
}  // namespace poolhall::client
