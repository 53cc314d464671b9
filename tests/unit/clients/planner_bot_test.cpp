#include "clients/bots/planner_bot.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <variant>

#include "clients/bots/exhibition.hpp"
#include "clients/bots/house_bots.hpp"
#include "placed_balls.hpp"

// A namespace of its own: some of its names are another file's.
namespace poolhall::bots::planner_tests {
namespace {

using rules::Decision;
using rules::TurnKind;
using rules::Whereabouts;

constexpr std::uint64_t effort = 60'000;

client::Shot chosen(const client::GameInfo& game, const rules::GameState& state,
                    unsigned cores = 1) {
  PlannerBot bot(game, {.effort = effort, .cores = cores});
  return std::get<client::Shot>(bot.choose({game, state}));
}

TEST(PlannerBot, RunsOutAnOpenTableWithoutNoise) {
  const auto game = info("none");
  auto state = table_with({{0, {0.558, 1.118}},
                           {1, {0.2, 1.9}},
                           {2, {0.9, 0.3}},
                           {3, {0.3, 0.9}},
                           {4, {0.7, 1.6}},
                           {8, {0.9, 1.2}},
                           {9, {0.8, 0.5}}});
  // A stroke may pot two.
  for (int shot = 0; shot < 5 && !state.result; ++shot) {
    ASSERT_EQ(state.to_move, rules::Seat::first) << "after " << shot << " shots";
    state = played_exactly(game, state, chosen(game, state)).next;
  }
  ASSERT_TRUE(state.result);
  EXPECT_EQ(state.result->winner, rules::Seat::first);
}

// Greedy's ghost ball has no room beside the rail.
TEST(PlannerBot, PotsABallAlongTheRailThatItRestsOn) {
  const auto game = info("none");
  const auto state =
      table_with({{0, {0.4, 1.0}}, {1, {0.02859, 1.5}}, {8, {0.9, 1.2}}, {9, {0.8, 0.4}}});
  const auto ruling = played_exactly(game, state, chosen(game, state));
  ASSERT_EQ(ruling.pocketed.size(), 1U);
  EXPECT_EQ(ruling.pocketed[0].ball, BallId{1});
}

TEST(PlannerBot, WithTheBallInHandItPotsAndGoesOn) {
  const auto game = info();
  const auto state =
      table_with({{0, {0.558, 0.3}}, {1, {0.558, 1.6}}, {8, {0.9, 1.2}}, {9, {0.8, 0.4}}},
                 TurnKind::ball_in_hand);
  const auto shot = chosen(game, state);
  ASSERT_TRUE(shot.cue_ball);
  const auto ruling = played_exactly(game, state, shot);
  EXPECT_EQ(ruling.next.to_move, rules::Seat::first);
}

TEST(PlannerBot, SpotsTheEightOrBreaksAgainWhenItMayChoose) {
  const auto game = info();
  auto state = rules::new_game({}, game.table, game.materials);
  state.kind = TurnKind::decision;
  state.options = {Decision::spot_eight, Decision::rerack_breaker_breaks};
  state.balls[8] = {BallId{8}, Whereabouts::pocketed, {}, PocketId::foot_left};
  PlannerBot bot(game, {.effort = effort});
  EXPECT_TRUE(std::holds_alternative<Decision>(bot.choose({game, state})));
}

TEST(PlannerBot, TheSameSeedPlaysTheSameShotOnAnyNumberOfCores) {
  const auto game = info();
  const auto state = table_with(
      {{0, {0.558, 0.5}}, {1, {0.4, 1.5}}, {2, {0.9, 1.8}}, {8, {0.9, 1.2}}, {9, {0.8, 0.4}}});
  const auto alone = chosen(game, state, 1);
  EXPECT_EQ(alone.stroke, chosen(game, state, 1).stroke);
  EXPECT_EQ(alone.stroke, chosen(game, state, 3).stroke);
}

TEST(PlannerBot, AnswersWithAMoveWhenItsClockIsNearlyOut) {
  const auto game = info();
  const auto state =
      table_with({{0, {0.558, 0.5}}, {1, {0.4, 1.5}}, {8, {0.9, 1.2}}, {9, {0.8, 0.4}}});
  for (const int ms : {0, 20, 160, 400}) {
    PlannerBot bot(game, {});
    const client::Move move = bot.choose({game, state, {.own = std::chrono::milliseconds{ms}}});
    ASSERT_TRUE(std::holds_alternative<client::Shot>(move)) << ms << " ms left";
    EXPECT_TRUE(rules::prepare_shot(state, std::get<client::Shot>(move).call, std::nullopt,
                                    game.table, game.materials));
  }
}

struct Venue {
  rules::RuleSet rules;
  std::string table;
  std::string materials;
  std::string noise;
};

class Anywhere : public testing::TestWithParam<Venue> {};

TEST_P(Anywhere, PlannerPlaysAWholeGameWithoutARefusal) {
  ExhibitionSettings settings;
  settings.game.rules = GetParam().rules;
  settings.table = GetParam().table;
  settings.materials = GetParam().materials;
  settings.noise = GetParam().noise;
  settings.hides_noise = true;
  settings.seed = 5;
  const auto planner = house_bot("planner", {.seed = 1, .effort = 5'000}).value();
  const auto random = house_bot("random", {.seed = 1}).value();
  const auto game = play_exhibition(settings, {planner, random});
  EXPECT_EQ(game.fault, "");
  EXPECT_EQ(game.seats[0].refused, 0U);
  EXPECT_EQ(game.result.winner, rules::Seat::first);
}

INSTANTIATE_TEST_SUITE_P(
    PlannerBot, Anywhere,
    testing::Values(Venue{rules::RuleSet::eight_ball, "olympiad", "olympiad", "none"},
                    Venue{rules::RuleSet::eight_ball, "bar7", "modern", "low"},
                    Venue{rules::RuleSet::eight_ball, "wpa9", "modern", "olympiad"},
                    Venue{rules::RuleSet::nine_ball, "olympiad", "olympiad", "high"},
                    Venue{rules::RuleSet::nine_ball, "wpa8", "marlow", "low"}),
    [](const auto& one) {
      return std::string(one.param.rules == rules::RuleSet::eight_ball ? "EightBall" : "NineBall") +
             "On_" + one.param.table + "_" + one.param.noise;
    });

}  // namespace
}  // namespace poolhall::bots::planner_tests
