#include "server/tournament/director.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "server/tournament/format.hpp"

namespace poolhall::tournament {
namespace {

std::vector<std::uint32_t> numbers(const std::vector<Pairing>& pairings) {
  std::vector<std::uint32_t> numbers;
  for (const Pairing& pairing : pairings) {
    numbers.push_back(pairing.number);
  }
  return numbers;
}

// 0: 1-2, 1: 0-1, 2: 2-0.
TEST(Director, NobodyPlaysMoreGamesAtOnceThanAllowed) {
  Director director(round_robin(3), {.games = 3, .games_per_entry = 1});
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(director.begin_due().empty());
  director.end(0);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{1}));
}

TEST(Director, NoMoreGamesGoOnAtOnceThanAllowed) {
  Director director(round_robin(3), {.games = 2, .games_per_entry = 2});
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{0, 1}));
  director.end(1);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{2}));
}

TEST(Director, WhatIsOverOrGoingOnFromBeforeIsNotBegunAgain) {
  Director director(round_robin(3), {.games = 3, .games_per_entry = 2});
  director.end(0);
  director.resume(2);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{1}));
  EXPECT_FALSE(director.all_over());
  director.end(1);
  director.end(2);
  EXPECT_TRUE(director.all_over());
}

TEST(Director, AMatchThatWasGoingOnCountsAgainstTheLimits) {
  Director director(round_robin(3), {.games = 3, .games_per_entry = 1});
  director.resume(2);
  EXPECT_TRUE(director.begin_due().empty());
}

TEST(Director, ANewPlanKeepsWhatHasBegunAndTakesTheRestAsItIsNow) {
  Director director({{2, 0, entry_id(0), entry_id(1)},
                     {4, 0, entry_id(2), entry_id(3)},
                     {6, 0, entry_id(0), entry_id(2)},
                     {8, 0, entry_id(1), entry_id(3)}},
                    {.games = 9, .games_per_entry = 1});
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{2, 4}));
  director.end(2);
  director.plan({{1, 0, entry_id(0), entry_id(1)}, {8, 0, entry_id(0), entry_id(1)}});
  EXPECT_TRUE(director.is_over(2));
  EXPECT_EQ(director.running(), (std::vector<std::uint32_t>{4}));
  EXPECT_FALSE(director.is_known(6));
  EXPECT_FALSE(director.is_known(9));
  director.end(4);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{1}));
  director.drop(1);
  const auto due = director.begin_due();
  ASSERT_EQ(numbers(due), (std::vector<std::uint32_t>{8}));
  EXPECT_EQ(due[0].second, entry_id(1)) << "as the new plan has it";
}

TEST(Director, MatchesOfARoundWaitForTheRoundBefore) {
  Director director({{0, 1, entry_id(0), entry_id(1)},
                     {1, 0, entry_id(2), entry_id(3)},
                     {2, 0, entry_id(4), entry_id(5)}},
                    {.games = 2, .games_per_entry = 1}, Pace::by_rounds);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{1, 2}));
  director.end(1);
  EXPECT_TRUE(director.begin_due().empty());
  director.end(2);
  EXPECT_EQ(numbers(director.begin_due()), (std::vector<std::uint32_t>{0}));
}

// The work is a few walks over the schedule for each match: with a walk for each waiting match as
// well, this one does not end.
TEST(Director, PlaysThousandsOfMatches) {
  FormatSettings format;
  format.kind = FormatKind::sprt;
  format.rounds = 6000;
  format.sprt = {.elo0 = -0.1, .elo1 = 0.1};
  const std::vector<EntrySpan> field(2);
  Happened happened;
  Schedule now = schedule(format, field, happened);
  Director director(now.pairings, {.games = 4, .games_per_entry = 4});
  std::deque<Pairing> going_on;
  std::uint32_t begun = 0;
  while (!now.is_complete) {
    for (const Pairing& pairing : director.begin_due()) {
      ASSERT_EQ(pairing.number, begun++);
      going_on.push_back(pairing);
    }
    ASSERT_FALSE(going_on.empty());
    const std::uint32_t number = going_on.front().number;
    going_on.pop_front();
    happened.begun.insert(number);
    happened.results[number] = {{{0, 1.0}, {1, 0.0}}};
    director.end(number);
    now = schedule(format, field, happened, now);
    director.plan(now.pairings);
  }
  EXPECT_TRUE(director.all_over());
  EXPECT_EQ(now.sprt->pairs, format.rounds);
}

}  // namespace
}  // namespace poolhall::tournament
