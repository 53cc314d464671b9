#include "server/tournament/standings.hpp"

#include <gtest/gtest.h>

#include "server/tournament/crosstable.hpp"

namespace poolhall::tournament {
namespace {

constexpr EntryId a{0};
constexpr EntryId b{1};
constexpr EntryId c{2};
constexpr EntryId d{3};

PlayedGame won(EntryId breaker, EntryId other, EntryId winner,
               rules::EndReason reason = rules::EndReason::eight_pocketed) {
  return {0, 0, breaker, other, winner, reason};
}
PlayedGame drawn(EntryId breaker, EntryId other) {
  return {0, 0, breaker, other, std::nullopt, rules::EndReason::stalemate};
}

std::vector<EntryId> order(const Standings& table) {
  std::vector<EntryId> order;
  for (const StandingsRow& row : table.rows) {
    order.push_back(row.entry);
  }
  return order;
}

TEST(Standings, PointsAreAWinOneADrawHalf) {
  const Standings table = standings(3, {won(a, b, b), drawn(b, c), won(c, a, a), won(a, c, c)},
                                    std::vector<TieBreak>{});
  EXPECT_EQ(order(table), (std::vector{b, c, a}));
  EXPECT_EQ(table.rows[0].points, 1.5);
  EXPECT_EQ(table.rows[0].wins, 1u);
  EXPECT_EQ(table.rows[0].draws, 1u);
  EXPECT_EQ(table.rows[1].points, 1.5);
  EXPECT_EQ(table.rows[2].points, 1);
  EXPECT_EQ(table.rows[2].losses, 2u);
}

TEST(Standings, EntriesThatNothingPartsShareARank) {
  const Standings table = standings(3, {won(a, b, a), won(b, a, b), won(a, c, a), won(b, c, b)},
                                    std::vector<TieBreak>{TieBreak::direct_encounter});
  EXPECT_EQ(order(table), (std::vector{a, b, c}));
  EXPECT_EQ(table.rows[0].rank, 1u);
  EXPECT_EQ(table.rows[1].rank, 1u);
  EXPECT_EQ(table.rows[2].rank, 3u);
}

TEST(Standings, DirectEncounterCountsOnlyGamesAmongTheTied) {
  // a and b have 2 points each; b beat a; a beat c twice, which does not count.
  const Standings table =
      standings(4, {won(a, b, b), won(a, c, a), won(a, c, a), won(b, d, b), won(b, d, d)},
                std::vector<TieBreak>{TieBreak::direct_encounter});
  EXPECT_EQ(order(table).front(), b);
  EXPECT_EQ(table.rows[0].points, table.rows[1].points);
  EXPECT_EQ(table.rows[0].tie_breaks.at(0), 1);
  EXPECT_EQ(table.rows[1].tie_breaks.at(0), 0);
}

TEST(Standings, SonnebornBergerPrefersPointsAgainstTheStrong) {
  // a and b have 1 point each; a's is against c (2 points), b's against d (0 points).
  const std::vector<PlayedGame> games{won(a, c, a), won(b, d, b), won(c, b, c), won(c, d, c),
                                      won(d, a, a), won(a, b, b), won(b, a, a), won(a, d, d),
                                      won(b, c, c), won(c, a, c), won(d, b, b)};
  const Standings table = standings(4, games, std::vector<TieBreak>{TieBreak::sonneborn_berger});
  // c 4, a 3, b 3, d 1: S-B of a = 4 + 1 + 3 = 8, of b = 1 + 3 + 1 = 5.
  EXPECT_EQ(order(table), (std::vector{c, a, b, d}));
  EXPECT_EQ(table.rows[1].tie_breaks.at(0), 8);
  EXPECT_EQ(table.rows[2].tie_breaks.at(0), 5);
}

TEST(Standings, TieBreaksApplyInTheDeclaredOrder) {
  // a: a win against c (0 points) and a loss. b: two draws with d (2 points). Both have 1 point;
  // wins prefer a (1 to 0), Sonneborn-Berger prefers b (0.5 * 2 + 0.5 * 2 = 2 to 0).
  const std::vector<PlayedGame> games{won(a, c, a), won(a, d, d), drawn(b, d), drawn(b, d)};
  EXPECT_EQ(
      order(standings(4, games, std::vector<TieBreak>{TieBreak::wins, TieBreak::sonneborn_berger})),
      (std::vector{d, a, b, c}));
  EXPECT_EQ(
      order(standings(4, games, std::vector<TieBreak>{TieBreak::sonneborn_berger, TieBreak::wins})),
      (std::vector{d, b, a, c}));
}

TEST(Standings, EndingsAreCounted) {
  const Standings table = standings(
      2, {won(a, b, a), won(a, b, a), won(b, a, a, rules::EndReason::timeout), drawn(a, b)},
      std::vector<TieBreak>{});
  EXPECT_EQ(table.endings.at(rules::EndReason::eight_pocketed), 2u);
  EXPECT_EQ(table.endings.at(rules::EndReason::timeout), 1u);
  EXPECT_EQ(table.endings.at(rules::EndReason::stalemate), 1u);
}

TEST(Standings, RatingsComeWithTheTable) {
  const Standings table =
      standings(3, {won(a, b, a), won(b, a, a), won(a, b, b), won(b, a, b), won(a, c, a)},
                std::vector<TieBreak>{});
  EXPECT_EQ(table.rows.back().entry, c);
  EXPECT_EQ(table.rows.back().rating.status, ratings::RatingStatus::lost_everything);
  EXPECT_TRUE(table.rows.front().rating.rated);
}

TEST(TieBreakNames, AreReadAsTheyAreWritten) {
  for (const TieBreak each :
       {TieBreak::direct_encounter, TieBreak::sonneborn_berger, TieBreak::wins}) {
    EXPECT_EQ(tie_break(name(each)), each);
  }
  EXPECT_FALSE(tie_break("luck"));
}

TEST(Crosstable, CellsHoldWhatTheRowScoredAgainstTheColumn) {
  const Crosstable table = crosstable(3, {won(a, b, a), drawn(b, a), won(c, b, b)});
  EXPECT_EQ(table.at(a, b).points, 1.5);
  EXPECT_EQ(table.at(b, a).points, 0.5);
  EXPECT_EQ(table.at(a, b).games, 2u);
  EXPECT_EQ(table.at(b, c).points, 1);
  EXPECT_EQ(table.at(a, c).games, 0u);
}

}  // namespace
}  // namespace poolhall::tournament
