#include "server/tournament/render.hpp"

#include <gtest/gtest.h>

namespace poolhall::tournament {
namespace {

using namespace std::chrono_literals;

constexpr EntryId anna{0};
constexpr EntryId bob{1};
constexpr EntryId carl{2};
const Names names{"Anna", "Bob-the-Builder", "Carl"};

std::vector<PlayedGame> games() {
  const auto won = [](EntryId breaker, EntryId other, EntryId winner) {
    return PlayedGame{0, 0, breaker, other, winner, rules::EndReason::eight_pocketed};
  };
  std::vector<PlayedGame> games{won(anna, bob, anna), won(bob, anna, anna),  won(anna, bob, bob),
                                won(bob, anna, bob),  won(anna, carl, anna), won(carl, bob, bob)};
  games.push_back({0, 0, anna, bob, std::nullopt, rules::EndReason::stalemate});
  games.push_back({0, 0, bob, carl, bob, rules::EndReason::timeout});
  return games;
}

TEST(StandingsText, IsAnAlignedTable) {
  const Standings table = standings(
      3, games(), std::vector<TieBreak>{TieBreak::direct_encounter, TieBreak::sonneborn_berger});
  EXPECT_EQ(standings_text(table, names),
            "#  Entry            Points  Games  W  L  D         Elo  Direct    S-B\n"
            "1  Bob-the-Builder     4.5      7  4  2  1  +0 +/- 155       0   8.75\n"
            "2  Anna                3.5      6  3  2  1  +0 +/- 155       0  11.25\n"
            "3  Carl                  0      3  0  3  0    lost all       0      0\n"
            "Advantage of the break: +0 +/- 311 Elo. Elo by maximum likelihood, mean 0, with "
            "95 % intervals.\n"
            "No finite Elo: who won or lost every game against those with one.\n");
}

TEST(StandingsText, NothingPlayedYetIsATableOfZeros) {
  const Standings table = standings(2, {}, std::vector<TieBreak>{});
  EXPECT_EQ(standings_text(table, names),
            "#  Entry            Points  Games  W  L  D  Elo\n"
            "1  Anna                  0      0  0  0  0    -\n"
            "1  Bob-the-Builder       0      0  0  0  0    -\n");
}

TEST(StandingsText, AnEloNearZeroHasNoMinus) {
  Standings table = standings(2, {}, std::vector<TieBreak>{});
  table.rows[0].rating = {ratings::RatingStatus::rated, ratings::Estimate{-0.2, 369}, 0};
  table.break_advantage = ratings::Estimate{-1e-12, 20};
  const std::string text = standings_text(table, names);
  EXPECT_NE(text.find(" +0 +/- 369\n"), std::string::npos) << text;
  EXPECT_NE(text.find("break: +0 +/- 20 Elo"), std::string::npos) << text;
}

TEST(StandingsText, ALadderHasTheRatingsThatDecide) {
  TableRules rules;
  rules.places = {1, 0};
  rules.ladder = {{1455.4, 120.6, 0.06}, {1544.6, 99.5, 0.06}};
  EXPECT_EQ(standings_text(standings(2, {}, rules), {"Anna", "Bob"}),
            "#  Entry  Points  Games  W  L  D  Elo  Glicko-2  Dev\n"
            "1  Bob         0      0  0  0  0    -      1545  100\n"
            "2  Anna        0      0  0  0  0    -      1455  121\n");
}

TEST(StandingsText, NobodyIsComparedWithThoseWhoHaveAnEloWhereNobodyHasOne) {
  const Standings table = standings(3, {{0, 0, anna, bob, anna, rules::EndReason::eight_pocketed}},
                                    std::vector<TieBreak>{});
  EXPECT_EQ(standings_text(table, names).find("No finite Elo"), std::string::npos);
}

TEST(CrosstableText, ShowsPointsAndGamesInTheOrderOfTheStandings) {
  const Standings table = standings(3, games(), std::vector<TieBreak>{});
  EXPECT_EQ(crosstable_text(crosstable(3, games()), table, names),
            "#  Entry                1      2    3\n"
            "1  Bob-the-Builder      x  2.5/5  2/2\n"
            "2  Anna             2.5/5      x  1/1\n"
            "3  Carl               0/2    0/1    x\n");
}

TEST(EndingsText, NamesEveryWayAGameEnded) {
  EXPECT_EQ(endings_text(standings(3, games(), std::vector<TieBreak>{})),
            "Games ended: eight pocketed 6, stalemate 1, timeout 1\n");
  EXPECT_EQ(endings_text(standings(3, {}, std::vector<TieBreak>{})), "Games ended: none yet\n");
}

TEST(ProgressText, FillsTheBarByGamesPlayed) {
  EXPECT_EQ(
      progress_text(
          {.finished = 6, .running = 2, .total = 12, .elapsed = 35s, .remaining = Seconds{40}}),
      "[############............] 6/12 games, 2 running, 0:35 gone, about 0:40 left");
  EXPECT_EQ(progress_text({.finished = 0, .running = 1, .total = 3}),
            "[........................] 0/3 games, 1 running, 0:00 gone, no game over yet");
  EXPECT_EQ(
      progress_text(
          {.finished = 3, .running = 0, .total = 3, .elapsed = 3700s, .remaining = Seconds{0}}),
      "[########################] 3/3 games, 0 running, 1:01:40 gone, about 0:00 left");
}

}  // namespace
}  // namespace poolhall::tournament
