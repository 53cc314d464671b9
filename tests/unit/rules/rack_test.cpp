#include "rules/rack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "rule_rows.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules::test {
namespace {

double gap(const BallPlace& p, const BallPlace& q) {
  const auto way = p.position - q.position;
  return std::sqrt(dot(way, way)) - 2 * row_materials().ball_radius;
}

double smallest_gap(const GameState& state) {
  double smallest = 1;
  for (std::size_t i = 1; i < state.balls.size(); ++i) {
    for (std::size_t k = i + 1; k < state.balls.size(); ++k) {
      smallest = std::min(smallest, gap(state.balls[i], state.balls[k]));
    }
  }
  return smallest;
}

// Places in the order of the rows, from left to right.
std::vector<BallId> in_rows(const GameState& state) {
  std::vector<BallPlace> places(state.balls.begin() + 1, state.balls.end());
  std::sort(places.begin(), places.end(), [](const BallPlace& p, const BallPlace& q) {
    return std::abs(p.position.y - q.position.y) > 0.01 ? p.position.y < q.position.y
                                                        : p.position.x < q.position.x;
  });
  std::vector<BallId> ids;
  for (const BallPlace& place : places) {
    ids.push_back(place.id);
  }
  return ids;
}

GameState game(const GameSettings& settings) {
  return new_game(settings, row_table(), row_materials());
}

TEST(Rack, HasTheApexOnTheFootSpotTheEightInTheMiddleAndTwoGroupsInTheBackCorners) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const GameState state = game({.rack_seed = seed});
    const std::vector<BallId> rows = in_rows(state);
    const BallPlace& apex = state.balls[physics::number(rows[0])];
    EXPECT_EQ(apex.position.x, row_table().foot_spot_x);
    EXPECT_EQ(apex.position.y, row_table().foot_spot_y);
    EXPECT_EQ(rows[4], BallId{8});
    EXPECT_NE(group_of(rows[10]), group_of(rows[14]));
    EXPECT_EQ(std::set<BallId>(rows.begin(), rows.end()).size(), 15U);
  }
}

TEST(Rack, OfNineBallHasTheOneInFrontAndTheNineInTheMiddle) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const GameState state = game({.rules = RuleSet::nine_ball, .rack_seed = seed});
    const std::vector<BallId> rows = in_rows(state);
    EXPECT_EQ(state.balls.size(), 10U);
    EXPECT_EQ(rows[0], BallId{1});
    EXPECT_EQ(rows[4], BallId{9});
    EXPECT_EQ(state.balls[1].position.y, row_table().foot_spot_y);
  }
}

TEST(Rack, WithoutGapTouchesAndNeverOverlaps) {
  for (const RuleSet rules : {RuleSet::eight_ball, RuleSet::nine_ball}) {
    const GameState state = game({.rules = rules, .rack_seed = 7});
    EXPECT_GE(smallest_gap(state), 0);
    std::size_t touching = 0;
    for (std::size_t i = 1; i < state.balls.size(); ++i) {
      for (std::size_t k = i + 1; k < state.balls.size(); ++k) {
        touching += gap(state.balls[i], state.balls[k]) < 1e-15 ? 1 : 0;
      }
    }
    EXPECT_EQ(touching, rules == RuleSet::eight_ball ? 30U : 16U);
  }
}

TEST(Rack, IsSymmetricAboutTheLongString) {
  const GameState state = game({.rack_seed = 3});
  std::map<double, double> sum_of_row;
  for (std::size_t i = 1; i < state.balls.size(); ++i) {
    sum_of_row[state.balls[i].position.y] += state.balls[i].position.x - row_table().foot_spot_x;
  }
  EXPECT_EQ(sum_of_row.size(), 5U);
  for (const auto& [y, sum] : sum_of_row) {
    EXPECT_NEAR(sum, 0, 1e-15);
  }
}

TEST(Rack, KeepsTheGapThatWasAskedFor) {
  const GameState state = game({.rack_seed = 5, .rack_gap = 1e-4});
  EXPECT_NEAR(smallest_gap(state), 1e-4, 1e-15);
  EXPECT_GE(smallest_gap(state), 1e-4 - 1e-17);
}

TEST(Rack, DisplacesEveryBallByAtMostTheJitterAndNeverIntoAnother) {
  const double jitter = 5e-4;
  bool moved = false;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const GameState state = game({.rack_seed = seed, .rack_jitter = jitter});
    EXPECT_GE(smallest_gap(state), -1e-16);
    const BallPlace& apex = state.balls[physics::number(in_rows(state)[0])];
    EXPECT_LE(std::abs(apex.position.x - row_table().foot_spot_x), jitter);
    EXPECT_LE(std::abs(apex.position.y - row_table().foot_spot_y), jitter);
    moved = moved || apex.position.x != row_table().foot_spot_x;
    EXPECT_TRUE(check_state(state, row_table(), row_materials()));
  }
  EXPECT_TRUE(moved);
}

TEST(Rack, IsTheSameForTheSameSeedAndAnotherForAnotherSeedOrRack) {
  EXPECT_EQ(game({.rack_seed = 42}), game({.rack_seed = 42}));
  EXPECT_NE(in_rows(game({.rack_seed = 42})), in_rows(game({.rack_seed = 43})));
  GameState decision = row_state(
      "8 decision second accept rerack_chooser_breaks "
      "rerack_breaker_breaks");
  const auto reracked =
      decide(decision, Decision::rerack_breaker_breaks, row_table(), row_materials());
  ASSERT_TRUE(reracked);
  EXPECT_EQ(reracked->rack, 2U);
  EXPECT_NE(in_rows(*reracked), in_rows(new_game(decision.settings, row_table(), row_materials())));
}

// The random numbers are part of every stored game: they must never change.
TEST(Rack, OfASeedIsTheOneThatWasPublished) {
  // Known answer of philox4x32-10 for counter 0 and key 0, from Random123's kat_vectors.
  EXPECT_EQ(RackRandom(0, 0).bits(), 0xe169c58d6627e8d5U);
  std::vector<unsigned> rows;
  for (const BallId id : in_rows(game({.rack_seed = 2024}))) {
    rows.push_back(physics::number(id));
  }
  EXPECT_EQ(rows, (std::vector<unsigned>{6, 10, 5, 11, 8, 2, 7, 4, 12, 13, 1, 15, 9, 3, 14}));
}

TEST(Rack, PutsEveryBallAnywhereOverManySeeds) {
  std::map<BallId, std::size_t> at_apex;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    ++at_apex[in_rows(game({.rack_seed = seed}))[0]];
  }
  EXPECT_EQ(at_apex.size(), 14U);
  for (const auto& [ball, count] : at_apex) {
    // 4000 / 14 = 286, six standard deviations of 16.3 either way.
    EXPECT_NEAR(static_cast<double>(count), 286, 98) << physics::number(ball);
  }
}

TEST(Rack, LeavesTheCueBallInTheKitchenOfTheBreaker) {
  const GameState state = game({.breaker = Seat::second});
  EXPECT_EQ(state.to_move, Seat::second);
  EXPECT_EQ(state.breaker, Seat::second);
  EXPECT_EQ(state.kind, TurnKind::break_shot);
  EXPECT_LT(state.balls[0].position.y, row_table().head_string);
}

}  // namespace
}  // namespace poolhall::rules::test
