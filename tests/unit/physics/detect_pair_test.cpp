#include "physics/detect_pair.hpp"

#include <gtest/gtest.h>

#include "physics/quartic_closed_form.hpp"

namespace poolhall::physics {
namespace {

constexpr double two_r = 2 * 0.028575;

PairMotion<double> pair(Vec2<double> d, Vec2<double> v, Vec2<double> a = {}) {
  return {d, v, a, two_r * two_r};
}

TEST(DetectPair, HeadOnAtConstantSpeed) {
  const auto t = first_contact(pair({1, 0}, {-2, 0}), 10.0);
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, (1 - two_r) / 2, 1e-16);
}

TEST(DetectPair, DeceleratingBallsMeetAtTheEarlierRoot) {
  const auto t = first_contact(pair({0.3, 0}, {-1, 0}, {0.4, 0}), 10.0);
  ASSERT_TRUE(t);
  const double way = 0.3 - two_r;
  EXPECT_NEAR(*t, (1 - std::sqrt(1 - 0.8 * way)) / 0.4, 1e-15);
}

TEST(DetectPair, BallThatStopsShortMeetsNobody) {
  EXPECT_FALSE(first_contact(pair({1, 0}, {-1, 0}, {0.6, 0}), 10.0));
}

TEST(DetectPair, NothingBeyondTheHorizon) {
  EXPECT_FALSE(first_contact(pair({1, 0}, {-1, 0}), 0.9));
  EXPECT_TRUE(first_contact(pair({1, 0}, {-1, 0}), 0.95));
}

TEST(DetectPair, AContactInTheFirstInstantsOfALongHorizonIsFound) {
  for (const double horizon : {1e3, 1e20, 1e40, 1e59}) {
    const auto t = first_contact(pair({two_r + 1e-13, 0}, {-0.01, 0.001}, {1e4, 0}), horizon);
    ASSERT_TRUE(t) << horizon;
    EXPECT_NEAR(*t, 1e-11, 1e-14) << horizon;
  }
}

TEST(DetectPair, TouchingAndRecedingIsNoContact) {
  EXPECT_FALSE(first_contact(pair({two_r, 0}, {0.5, 0.1}), 10.0));
  EXPECT_FALSE(first_contact(pair({two_r * (1 - 1e-16), 0}, {1e-9, 0}), 10.0));
}

TEST(DetectPair, TouchingAndApproachingIsContactNow) {
  EXPECT_EQ(first_contact(pair({two_r, 0}, {-1e-9, 3}), 10.0), 0.0);
  EXPECT_EQ(first_contact(pair({two_r * (1 - 1e-13), 0}, {-1, 0}), 10.0), 0.0);
}

TEST(DetectPair, AnApproachThatEndsWithinTheLeastOfTimesIsContactNow) {
  EXPECT_EQ(first_contact(pair({two_r - 1e-13, 0}, {-5e-313, 0}, {1e5, 0}), 10.0), 0.0);
}

TEST(DetectPair, TouchingWithClosingAccelerationIsApproaching) {
  EXPECT_EQ(first_contact(pair({two_r, 0}, {0, 0}, {-1, 0}), 10.0), 0.0);
}

TEST(DetectPair, RecedingPairThatComesBackMeetsFromAbove) {
  const auto t = first_contact(pair({two_r, 0}, {1, 0}, {-2, 0}), 10.0);
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, 1, 1e-15);
}

TEST(DetectPair, OverlappingPairThatTurnsBackMeetsWhenItTurns) {
  const auto t = first_contact(pair({two_r - 1e-10, 0}, {1e-9, 0}, {-1, 0}), 10.0);
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, 1e-9, 1e-17);
}

TEST(DetectPair, GrazesAreToldApartTo1e15) {
  for (const double off : {1e-12, 1e-14, 1e-15}) {
    EXPECT_TRUE(first_contact(pair({1, two_r - off}, {-1, 0}), 10.0)) << off;
    EXPECT_FALSE(first_contact(pair({1, two_r + off}, {-1, 0}), 10.0)) << off;
  }
}

TEST(DetectPair, CurvedPathThatComesCloseTwiceMeetsAtTheFirstTime) {
  // d = (0.2 - t + t^2 ..., ...): passes the contact distance, recedes, returns.
  const auto p = pair({0.5, 0.04}, {-1.5, 0}, {1.0, 0.1});
  const auto t = first_contact(p, 5.0);
  ASSERT_TRUE(t);
  EXPECT_NEAR(p.gap(*t), 0, 1e-16);
  EXPECT_LT(p.half_slope(*t), 0);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_GT(p.gap(*t * i / 1000.0), 0);
  }
}

TEST(DetectPair, EqualMotionsNeverMeet) {
  EXPECT_FALSE(first_contact(pair({two_r, 0}, {0, 0}), 10.0));
  EXPECT_FALSE(first_contact(pair({0.3, 0.1}, {0, 0}), 10.0));
}

// The balls lose no side speed: from the middle of the course the quartic has no odd terms.
TEST(ClosedForm, FindsARestingBallThatAStraightRollWouldNotRollThrough) {
  for (int i = 0; i < 2000; ++i) {
    const double speed = 0.05 + 0.0007 * i, deceleration = 0.147;
    const double angle = 0.37 * i, aside = 0.05 * std::sin(1.7 * i);
    const double way = (0.1 + 0.8 * std::abs(std::sin(0.9 * i))) * speed * speed / 0.294;
    const double ahead = way + std::sqrt(two_r * two_r - aside * aside);
    const double c = std::cos(angle), s = std::sin(angle);
    const auto p = pair({c * ahead - s * aside, s * ahead + c * aside}, {-c * speed, -s * speed},
                        {c * deceleration, s * deceleration});
    const double met = 2 * way / (speed + std::sqrt(speed * speed - 2 * deceleration * way));
    for (const Polish polish : {Polish::no, Polish::yes}) {
      const auto t = closed_form_contact(p, speed / deceleration, polish);
      ASSERT_TRUE(t) << i;
      EXPECT_NEAR(*t, met, 1e-7) << i;
    }
  }
}

TEST(Roots, FirstClosingOfAGapThatIsClosedAndOpening) {
  EXPECT_EQ(first_closing(0.0, 1.0, 0.0, 99.0), 99.0);
  EXPECT_EQ(first_closing(0.0, -1.0, 0.0, 99.0), 0.0);
  EXPECT_EQ(first_closing(0.0, 0.0, -1.0, 99.0), 0.0);
  EXPECT_EQ(first_closing(0.0, 1.0, -2.0, 99.0), 1.0);
  EXPECT_EQ(first_closing(0.5, -1.0, 0.0, 99.0), 0.5);
}

}  // namespace
}  // namespace poolhall::physics
