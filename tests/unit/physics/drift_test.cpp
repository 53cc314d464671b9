#include "physics/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace poolhall::physics {
namespace {

TEST(Drift, OfGivenBallsIsNothingUntilTheyMove) {
  EXPECT_EQ(Drift<double>{}.after(0, 0).place, 0);
}

TEST(Drift, GrowsWithTimeByTheErrorOfTheVelocity) {
  const Drift<double> d{0, 1e-28};
  EXPECT_NEAR(std::sqrt(d.after(3, 0).place), 3e-14, 1e-20);
}

TEST(Drift, CountsTheRoundingOfPlaces) {
  EXPECT_DOUBLE_EQ(std::sqrt(Drift<double>{}.after(0, 2).place),
                   2 * std::numeric_limits<double>::epsilon());
}

// Along its path a ball that turns back by dv where it is late by e / g ends e dv / g off.
TEST(Drift, OfALateImpactIsTheChangeOfVelocityTimesTheDelay) {
  const Drift<double> d{1e-30, 0};
  EXPECT_NEAR(std::sqrt(d.turned(1, 9).place), std::sqrt(1 + 9.0) * 1e-15, 1e-20);
}

// The line of centres turns by e / 2R, and the impulse with it.
TEST(Drift, OfAHeadOnImpactIsTheSpeedTimesTheErrorOverTheReach) {
  const double reach = 0.05715;
  const Drift<double> d{1e-30, 0};
  EXPECT_NEAR(std::sqrt(d.slanted(4, 4, reach * reach).velocity), std::sqrt(2) * 2e-15 / reach,
              1e-18);
}

TEST(Drift, OfAGrazeIsNotBounded) {
  const Drift<double> d{1e-30, 0};
  EXPECT_FALSE(d.slanted(0, 1, 1).velocity < 1);
}

}  // namespace
}  // namespace poolhall::physics
