#include "clients/bots/pot_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace poolhall::bots {
namespace {

constexpr double aim_error = 2.2e-3;  // rad

physics::Ball<double> ball(unsigned id, Point at) {
  physics::Ball<double> result;
  result.id = BallId{static_cast<std::uint8_t>(id)};
  result.position = at;
  return result;
}

Layout layout(std::vector<physics::Ball<double>> balls) {
  const physics::Table table;  // the Olympiad's
  const double radius = 0.028575;
  return {table.width, table.length, radius, pocket_targets(table, radius), std::move(balls)};
}

std::vector<PotLine> lines_of(const Layout& table, Point cue) {
  const std::vector<BallId> targets{BallId{1}};
  return pot_lines(table, cue, targets, aim_error);
}

TEST(PotLines, MouthTargetsLieOnTheMouthLineAndMirrorEachOther) {
  const auto pockets = pocket_targets({}, 0.028575);
  ASSERT_EQ(pockets.size(), 6U);
  const double line = 0.11 / std::sqrt(2.0) + 0.028575;
  EXPECT_NEAR(pockets[0].centre.x + pockets[0].centre.y, line, 1e-12);
  EXPECT_NEAR(pockets[5].centre.x, 1.116 - pockets[0].centre.x, 1e-12);
  EXPECT_NEAR(pockets[5].centre.y, 2.236 - pockets[0].centre.y, 1e-12);
  EXPECT_NEAR(pockets[2].centre.x, 0.028575, 1e-12);
  EXPECT_NEAR(pockets[2].half_width, 0.06, 1e-12);
}

TEST(PotLines, AStraightShotHasItsGhostBehindTheObjectBall) {
  const Layout table = layout({ball(0, {0.558, 0.558}), ball(1, {0.3, 1.118})});
  const auto lines = lines_of(table, {0.8, 1.118});
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front().pocket, PocketId::side_left);
  EXPECT_NEAR(lines.front().ghost.x, 0.3 + 2 * 0.028575, 1e-12);
  EXPECT_NEAR(lines.front().cos_cut, 1, 1e-12);
  EXPECT_GT(lines.front().chance, 0.9);
}

TEST(PotLines, ABallInTheWayOfTheObjectBallClosesTheLine) {
  const Layout table =
      layout({ball(0, {0.8, 1.118}), ball(1, {0.3, 1.118}), ball(9, {0.15, 1.13})});
  for (const auto& line : lines_of(table, {0.8, 1.118})) {
    EXPECT_NE(line.pocket, PocketId::side_left);
  }
}

TEST(PotLines, ABallInTheWayOfTheCueBallClosesEveryLine) {
  const Layout table =
      layout({ball(0, {0.8, 1.118}), ball(1, {0.3, 1.118}), ball(9, {0.6, 1.118})});
  EXPECT_TRUE(lines_of(table, {0.8, 1.118}).empty());
}

TEST(PotLines, NoLineAsksForACutBeyondNinetyDegrees) {
  const Layout table = layout({ball(0, {0.1, 1.118}), ball(1, {0.3, 1.118})});
  for (const auto& line : lines_of(table, {0.1, 1.118})) {
    EXPECT_GT(line.cos_cut, 0);
    EXPECT_NE(line.pocket, PocketId::side_left);
  }
}

TEST(PotLines, ChancesFallWithDistanceAndComeBestFirst) {
  const Layout table = layout({ball(0, {0.558, 0.4}), ball(1, {0.5, 1.8})});
  const auto far = lines_of(table, {0.558, 0.4});
  const auto near = lines_of(table, {0.52, 1.6});
  ASSERT_FALSE(far.empty());
  ASSERT_FALSE(near.empty());
  EXPECT_GT(near.front().chance, far.front().chance);
  EXPECT_TRUE(std::ranges::is_sorted(far, std::ranges::greater{}, &PotLine::chance));
}

TEST(PotLines, ATableWithoutPocketsHasNoLines) {
  Layout table = layout({ball(0, {0.558, 0.4}), ball(1, {0.5, 1.8})});
  physics::Table closed;
  closed.pockets = physics::NoPockets{};
  table.pockets = pocket_targets(closed, table.radius);
  EXPECT_TRUE(lines_of(table, {0.558, 0.4}).empty());
}

}  // namespace
}  // namespace poolhall::bots
