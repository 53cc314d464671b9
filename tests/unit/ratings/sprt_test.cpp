#include "server/ratings/sprt.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace poolhall::ratings {
namespace {

TEST(PairCounts, CountsPairsByPointsAndLeavesOutAGameWithoutItsPartner) {
  const PairCounts counts = pair_counts({1, 1, 1, 0, 0, 1, 0, 0, 0.5, 1, 1});
  EXPECT_EQ(counts.by_points, (std::array<std::uint32_t, 5>{1, 0, 2, 1, 1}));
  EXPECT_EQ(counts.pairs(), 5U);
}

// 10 WW, 20 split, 10 LL: mean 1/2, variance of a pair's mean score (10/4 + 10/4) / 39.
TEST(PairStatistics, TakesTheErrorFromThePairsAndNotFromTheGames) {
  const PairStatistics even = pair_statistics({{10, 0, 20, 0, 10}});
  EXPECT_DOUBLE_EQ(even.score, 0.5);
  EXPECT_NEAR(even.standard_error, std::sqrt(5.0 / 39 / 40), 1e-12);
  EXPECT_DOUBLE_EQ(even.elo, 0);
  EXPECT_DOUBLE_EQ(even.superiority, 0.5);
  const PairStatistics split = pair_statistics({{0, 0, 40, 0, 0}});
  EXPECT_EQ(split.standard_error, 0) << "all split: the games cancel out";
}

TEST(PairStatistics, SuperiorityIsTheNormalProbabilityOfALead) {
  const PairStatistics statistics = pair_statistics({{10, 0, 20, 0, 20}});
  const double z = (statistics.score - 0.5) / statistics.standard_error;
  EXPECT_NEAR(statistics.superiority, 0.5 * std::erfc(-z / std::sqrt(2.0)), 1e-12);
  EXPECT_GT(statistics.superiority, 0.9);
}

// For outcomes 0 and 1 alone the ratio is that of Wald's test of a proportion:
// n (s ln(p1 / p0) + (1 - s) ln((1 - p1) / (1 - p0))).
TEST(Sprt, WithoutSplitsItIsWaldsTestOfAProportion) {
  const SprtSettings settings{.elo0 = 0, .elo1 = 50};
  const double p1 = 1 / (1 + std::pow(10.0, -50 / 400.0));
  const double expected = 60 * std::log(p1 / 0.5) + 40 * std::log((1 - p1) / 0.5);
  // A thousandth of a pair stands for the outcome that has not come.
  EXPECT_NEAR(pair_log_likelihood_ratio({{40, 0, 0, 0, 60}}, settings), expected, 2e-3);
}

TEST(Sprt, WhatComesAfterTheVerdictDoesNotCount) {
  std::vector<double> scores(200, 1.0);
  const SprtSettings settings{.elo0 = 0, .elo1 = 100};
  const SprtState state = sprt(scores, settings);
  EXPECT_EQ(state.verdict, SprtVerdict::h1);
  EXPECT_LT(state.pairs, 100U);
  scores.insert(scores.end(), 1000, 0.0);
  const SprtState later = sprt(scores, settings);
  EXPECT_EQ(later.verdict, SprtVerdict::h1);
  EXPECT_EQ(later.pairs, state.pairs);
}

TEST(Sprt, BoundsAreWalds) {
  const SprtState state = sprt({}, {.elo0 = 0, .elo1 = 10, .alpha = 0.05, .beta = 0.1});
  EXPECT_EQ(state.verdict, SprtVerdict::undecided);
  EXPECT_DOUBLE_EQ(state.lower, std::log(0.1 / 0.95));
  EXPECT_DOUBLE_EQ(state.upper, std::log(0.9 / 0.05));
}

}  // namespace
}  // namespace poolhall::ratings
