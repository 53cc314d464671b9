#include "server/tournament/round_robin.hpp"

#include <gtest/gtest.h>

namespace poolhall::tournament {
namespace {

TEST(RoundRobin, FewerThanTwoEntriesHaveNobodyToMeet) {
  EXPECT_TRUE(round_robin(0).empty());
  EXPECT_TRUE(round_robin(1).empty());
}

TEST(RoundRobin, TwoEntriesMeetOnce) {
  const std::vector<Pairing> expected{{0, 0, EntryId{0}, EntryId{1}}};
  EXPECT_EQ(round_robin(2), expected);
}

TEST(RoundRobin, ThreeEntriesSitOutARoundEachAndAreFirstOnceEach) {
  const std::vector<Pairing> expected{{0, 0, EntryId{1}, EntryId{2}},
                                      {1, 1, EntryId{0}, EntryId{1}},
                                      {2, 2, EntryId{2}, EntryId{0}}};
  EXPECT_EQ(round_robin(3), expected);
}

}  // namespace
}  // namespace poolhall::tournament
