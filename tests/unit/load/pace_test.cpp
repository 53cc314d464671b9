#include "clients/load/pace.hpp"

#include <gtest/gtest.h>

namespace poolhall::load {
namespace {

using namespace std::chrono_literals;

constexpr Pace::Time start{1h};
constexpr Pace pace{.from = start, .period = 400ms, .games = 4};

TEST(Pace, GivesEachGameItsOwnPlaceInTheRowWheneverItBegins) {
  for (std::size_t game = 0; game < pace.games; ++game) {
    for (auto begun = 0ms; begun < 1s; begun += 7ms) {
      const auto due = pace.first_due(game, start + begun);
      EXPECT_EQ((due - start) % pace.period, game * 100ms) << begun.count();
      EXPECT_GT(due, start + begun);
      EXPECT_LE(due, start + begun + pace.period);
    }
  }
}

TEST(Pace, PutsAGameThatBeginsWhenItsPlaceComesToTheNext) {
  EXPECT_EQ(pace.first_due(1, start + 99ms), start + 100ms);
  EXPECT_EQ(pace.first_due(1, start + 100ms), start + 500ms);
}

}  // namespace
}  // namespace poolhall::load
