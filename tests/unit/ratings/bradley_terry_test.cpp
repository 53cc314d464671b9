#include "server/ratings/bradley_terry.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace poolhall::ratings {
namespace {

// `wins` of 20 games for the breaker.
void add_twenty(std::vector<RatedGame>& games, std::size_t breaker, std::size_t other,
                std::uint32_t wins) {
  games.push_back({breaker, other, 1, wins});
  games.push_back({breaker, other, 0, 20 - wins});
}

std::vector<RatedGame> published() {
  std::vector<RatedGame> games;
  enum : std::size_t { a, b, c, d };
  add_twenty(games, a, b, 14);
  add_twenty(games, b, a, 9);
  add_twenty(games, a, c, 17);
  add_twenty(games, c, a, 6);
  add_twenty(games, a, d, 18);
  add_twenty(games, d, a, 4);
  add_twenty(games, b, c, 13);
  add_twenty(games, c, b, 9);
  add_twenty(games, b, d, 16);
  add_twenty(games, d, b, 7);
  add_twenty(games, c, d, 13);
  add_twenty(games, d, c, 10);
  return games;
}

TEST(BradleyTerry, AgreesWithPublishedPrograms) {
  const RatingTable table = bradley_terry(4, published());
  EXPECT_NEAR(table.players[0].rated.value().elo, 151.6514, 1e-3);
  EXPECT_NEAR(table.players[1].rated.value().elo, 38.2110, 1e-3);
  EXPECT_NEAR(table.players[2].rated.value().elo, -59.1705, 1e-3);
  EXPECT_NEAR(table.players[3].rated.value().elo, -130.6919, 1e-3);
  EXPECT_NEAR(table.break_advantage.value().elo, 57.7222, 1e-3);
}

// Two players, 2n games, each breaks n times: p = score share, the variance of one strength with
// mean 0 and no break effect is 1 / (4 * 2n p (1 - p)) logits^2.
TEST(BradleyTerry, TheIntervalOfTwoEqualPlayersIsTheTextbooks) {
  std::vector<RatedGame> games;
  games.push_back({0, 1, 1, 50});
  games.push_back({0, 1, 0, 50});
  games.push_back({1, 0, 1, 50});
  games.push_back({1, 0, 0, 50});
  const RatingTable table = bradley_terry(2, games);
  const double logits = 1.959963984540054 / std::sqrt(4 * 200 * 0.25);
  EXPECT_NEAR(table.players[0].rated.value().elo, 0, 1e-9);
  EXPECT_NEAR(table.players[0].rated.value().margin, logits * 400 / std::log(10.0), 1e-6);
  EXPECT_NEAR(table.break_advantage.value().margin,
              1.959963984540054 / std::sqrt(200 * 0.25) * 400 / std::log(10.0), 1e-6);
}

TEST(BradleyTerry, DrawsAreHalfAWinForEach) {
  const RatingTable drawn = bradley_terry(2, {{0, 1, 0.5, 10}, {1, 0, 0.5, 10}});
  EXPECT_NEAR(drawn.players[0].rated.value().elo, 0, 1e-9);
  EXPECT_NEAR(drawn.break_advantage.value().elo, 0, 1e-9);
}

TEST(BradleyTerry, WhoWonOrLostEverythingIsReportedAsSuch) {
  std::vector<RatedGame> games;
  add_twenty(games, 0, 1, 12);
  add_twenty(games, 1, 0, 9);
  for (const std::size_t player : {0u, 1u}) {
    games.push_back({player, 2, 1, 10});
    games.push_back({2, player, 0, 10});
    games.push_back({3, player, 1, 10});
  }
  const RatingTable table = bradley_terry(5, games);
  EXPECT_EQ(table.players[0].status, RatingStatus::rated);
  EXPECT_EQ(table.players[1].status, RatingStatus::rated);
  EXPECT_EQ(table.players[2].status, RatingStatus::lost_everything);
  EXPECT_EQ(table.players[3].status, RatingStatus::won_everything);
  EXPECT_EQ(table.players[4].status, RatingStatus::no_games);
  EXPECT_FALSE(table.players[2].rated);
}

TEST(BradleyTerry, APlayerBetweenTwoGroupsIsUnconnected) {
  const RatingTable table = bradley_terry(3, {{0, 1, 1, 3}, {1, 2, 1, 3}, {2, 0, 0, 3}});
  EXPECT_EQ(table.players[0].status, RatingStatus::won_everything);
  EXPECT_EQ(table.players[1].status, RatingStatus::unconnected);
  EXPECT_EQ(table.players[2].status, RatingStatus::lost_everything);
}

TEST(BradleyTerry, GroupsThatNeverMetHaveScalesOfTheirOwn) {
  std::vector<RatedGame> games;
  add_twenty(games, 0, 1, 12);
  add_twenty(games, 1, 0, 9);
  add_twenty(games, 2, 3, 15);
  add_twenty(games, 3, 2, 9);
  const RatingTable table = bradley_terry(4, games);
  EXPECT_EQ(table.players[0].group, table.players[1].group);
  EXPECT_EQ(table.players[2].group, table.players[3].group);
  EXPECT_NE(table.players[0].group, table.players[2].group);
  EXPECT_NEAR(table.players[0].rated->elo + table.players[1].rated->elo, 0, 1e-9);
  EXPECT_NEAR(table.players[2].rated->elo + table.players[3].rated->elo, 0, 1e-9);
}

TEST(BradleyTerry, WhenTheBreakerAlwaysWinsNoAdvantageIsInvented) {
  const RatingTable table = bradley_terry(2, {{0, 1, 1, 10}, {1, 0, 1, 10}});
  EXPECT_FALSE(table.break_advantage);
  EXPECT_NEAR(table.players[0].rated.value().elo, 0, 1e-9);
}

TEST(BradleyTerry, WhenOnePlayerAlwaysBreaksTheAdvantageIsNotTold) {
  const RatingTable table = bradley_terry(2, {{0, 1, 1, 15}, {0, 1, 0, 5}});
  EXPECT_FALSE(table.break_advantage);
  EXPECT_NEAR(table.players[0].rated.value().elo, 200 * std::log10(3.0), 1e-6);
}

// Two games with one rack, each breaking once; the scores are of the first.
void add_pair(std::vector<RatedGame>& games, std::size_t first, std::size_t second, double one,
              double two) {
  const std::uint64_t pair = games.size();
  games.push_back({first, second, one, 1, pair});
  games.push_back({second, first, 1 - two, 1, pair});
}

std::vector<RatedGame> without_pairs(std::vector<RatedGame> games) {
  for (RatedGame& game : games) {
    game.pair.reset();
  }
  return games;
}

TEST(BradleyTerry, AFewPairsOfOnesOwnAreTooFewHoweverManyTheOthersHave) {
  std::vector<RatedGame> games;
  for (int i = 0; i < 100; ++i) {
    add_pair(games, 0, 1, i % 3 == 0 ? 0 : 1, i % 2);
  }
  add_pair(games, 2, 0, 1, 0);
  add_pair(games, 2, 1, 0, 1);
  const RatingTable table = bradley_terry(3, games);
  const RatingTable independent = bradley_terry(3, without_pairs(games));
  EXPECT_EQ(table.players[2].rated.value().margin, independent.players[2].rated.value().margin);
  EXPECT_GT(table.players[2].rated->margin, 200);
}

TEST(BradleyTerry, SplitPairsDoNotMakeARatingCertain) {
  std::vector<RatedGame> games;
  for (int i = 0; i < 60; ++i) {
    add_pair(games, 0, 1, i % 2, 1 - i % 2);
  }
  const RatingTable table = bradley_terry(2, games);
  EXPECT_NEAR(table.players[0].rated.value().elo, 0, 1e-6);
  EXPECT_GT(table.players[0].rated->margin, 10);
  EXPECT_NEAR(likelihood_of_superiority(table, 0, 1).value_or(0), 0.5, 1e-6);
}

TEST(BradleyTerry, NoGamesGiveNoRatings) {
  const RatingTable table = bradley_terry(2, {});
  EXPECT_EQ(table.players[0].status, RatingStatus::no_games);
  EXPECT_FALSE(table.break_advantage);
}

}  // namespace
}  // namespace poolhall::ratings
