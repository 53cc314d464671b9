#include "server/tournament/progress.hpp"

#include <gtest/gtest.h>

// A namespace of its own: its entries have the names of another file's.
namespace poolhall::tournament::progress_tests {
namespace {

using namespace std::chrono_literals;

constexpr EntryId a{0};
constexpr EntryId b{1};
constexpr EntryId c{2};

TEST(Progress, BeforeTheFirstGameIsOverNobodyKnows) {
  const Progress now = progress({.finished = {},
                                 .running = {{a, b, 5s}},
                                 .waiting = {{a, b, 0s}},
                                 .finished_before = 3,
                                 .elapsed = 5s});
  EXPECT_FALSE(now.remaining);
  EXPECT_EQ(now.finished, 3u);
  EXPECT_EQ(now.total, 5u);
}

TEST(Progress, GamesToComeTakeAsLongAsThoseOfTheSamePlayers) {
  const Progress now = progress({.finished = {{a, b, 10s}, {b, a, 20s}, {a, c, 90s}},
                                 .running = {{a, b, 5s}},
                                 .waiting = {{a, b, 0s}, {c, a, 0s}, {b, c, 0s}},
                                 .finished_before = 0,
                                 .elapsed = 125s});
  // One at a time so far: (15 - 5) + 15 + 90 + average 40.
  ASSERT_TRUE(now.remaining);
  EXPECT_DOUBLE_EQ(now.remaining->count(), 155);
}

TEST(Progress, GamesAtTheSameTimeShortenTheRest) {
  const Progress now = progress({.finished = {{a, b, 10s}, {a, c, 10s}},
                                 .running = {},
                                 .waiting = {{a, b, 0s}, {a, c, 0s}, {b, c, 0s}, {b, c, 0s}},
                                 .finished_before = 0,
                                 .elapsed = 10s});
  EXPECT_DOUBLE_EQ(now.remaining.value().count(), 20);
}

TEST(Progress, AGameThatTakesLongerThanTheAverageIsNotExpectedToHaveEndedAlready) {
  const Progress now = progress({.finished = {{a, b, 10s}},
                                 .running = {{a, b, 50s}},
                                 .waiting = {},
                                 .finished_before = 0,
                                 .elapsed = 60s});
  EXPECT_EQ(now.remaining.value().count(), 0);
}

TEST(Progress, WhenEverythingIsOverNothingRemains) {
  const Progress now = progress(
      {.finished = {}, .running = {}, .waiting = {}, .finished_before = 12, .elapsed = 0s});
  EXPECT_EQ(now.remaining.value().count(), 0);
  EXPECT_EQ(now.total, 12u);
}

}  // namespace
}  // namespace poolhall::tournament::progress_tests
