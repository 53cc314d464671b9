#include "server/ratings/glicko2.hpp"

#include <gtest/gtest.h>

namespace poolhall::ratings {
namespace {

TEST(Glicko2, AgreesWithTheExampleOfThePaper) {
  const Glicko2Rating after =
      glicko2({1500, 200, 0.06},
              {{{1400, 30, 0.06}, 1}, {{1550, 100, 0.06}, 0}, {{1700, 300, 0.06}, 0}}, 0.5);
  EXPECT_NEAR(after.rating, 1464.05, 0.01);
  EXPECT_NEAR(after.deviation, 151.52, 0.01);
  EXPECT_NEAR(after.volatility, 0.05999, 0.00001);
}

TEST(Glicko2, WithoutGamesOnlyTheDeviationGrows) {
  const Glicko2Rating after = glicko2({1600, 50, 0.06}, {}, 0.5);
  EXPECT_EQ(after.rating, 1600);
  EXPECT_EQ(after.volatility, 0.06);
  EXPECT_NEAR(after.deviation, 51.0748, 1e-3);  // sqrt(50^2 + (173.7178 * 0.06)^2)
}

TEST(Glicko2, ASurprisingSeriesRaisesTheVolatility) {
  std::vector<Glicko2Game> games(20, {{2200, 50, 0.06}, 1});
  const Glicko2Rating after = glicko2({1500, 60, 0.06}, games, 0.9);
  EXPECT_GT(after.volatility, 0.06);
  EXPECT_GT(after.rating, 1500);
}

}  // namespace
}  // namespace poolhall::ratings
