#include "server/tournament/director.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace poolhall::tournament
