// What must hold of every game, over random games; `poolhall bench rules` plays 100,000.
#include <gtest/gtest.h>

#include "tests/support/random_games.hpp"

namespace poolhall::test_support {
namespace {

struct Venue {
  rules::RuleSet rules;
  const char* table;
  const char* materials;
  std::size_t games;
};

class RandomGames : public testing::TestWithParam<Venue> {};

TEST_P(RandomGames, EndAndAddUpAndAreJudgedFromTheLogAlone) {
  const Venue& venue = GetParam();
  const GamesReport report = play_random_games({.rules = venue.rules,
                                                .games = venue.games,
                                                .seed = 20261121,
                                                .table = venue.table,
                                                .materials = venue.materials});
  EXPECT_EQ(report.games, venue.games);
  EXPECT_GT(report.rejudged_from_store, 0U);
  for (const std::string& broken : report.broken) {
    ADD_FAILURE() << broken;
  }
}

INSTANTIATE_TEST_SUITE_P(
    BothGames, RandomGames,
    testing::Values(Venue{rules::RuleSet::eight_ball, "olympiad", "olympiad", 60},
                    Venue{rules::RuleSet::nine_ball, "olympiad", "olympiad", 60},
                    Venue{rules::RuleSet::eight_ball, "wpa9", "modern", 10},
                    Venue{rules::RuleSet::nine_ball, "bar7", "modern", 10}));

}  // namespace
}  // namespace poolhall::test_support
