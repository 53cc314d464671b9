#include "physics/motion.hpp"

#include <gtest/gtest.h>

namespace poolhall::physics {
namespace {

const Coefficients<double> c = coefficients<double>(Materials{});

Ball<double> ball_with(Vec2<double> v, Vec3<double> w) {
  Ball<double> ball;
  ball.position = {0.5, 1.0};
  ball.velocity = v;
  ball.angular_velocity = w;
  return settled(ball, c.radius);
}

TEST(Motion, SlipOfABallWithoutSpinIsItsVelocity) {
  EXPECT_EQ(cloth_slip(Vec2<double>{1, 2}, Vec3<double>{}, c.radius), (Vec2<double>{1, 2}));
}

TEST(Motion, StunShotSlidesForTwoSeventhsOfItsSpeedOverFriction) {
  const auto s = segment(ball_with({0, 2}, {}), {}, c);
  ASSERT_EQ(s.state, MotionState::sliding);
  EXPECT_NEAR(s.duration, 2 * 2.0 / (7 * 0.2 * 9.81), 1e-15);  // (13)
  const auto after = after_transition(s, BallId{3}, c);
  EXPECT_EQ(after.state, MotionState::rolling);
  EXPECT_NEAR(after.velocity.y, 10.0 / 7, 1e-15);
  EXPECT_NEAR(after.angular_velocity.x, -10.0 / 7 / c.radius, 1e-12);
  const double travelled = 12.0 * 4 / (49 * 0.2 * 9.81);  // 12 v^2 / (49 mu_s g)
  EXPECT_NEAR(after.position.y, 1 + travelled, 1e-15);
}

TEST(Motion, SlipDecaysAsTwelveSaysWithTheSignOfNinePutRight) {
  const auto s = segment(ball_with({1, 0.5}, {30, -20, 10}), {}, c);
  const Vec2<double> u0 = s.slip;
  const double t = s.duration / 3;
  const auto b = ball_at(s, BallId{1}, t, c);
  const Vec2<double> u = cloth_slip(b.velocity, b.angular_velocity, c.radius);
  const double left = 1 - 3.5 * c.slide_acceleration * t / length(u0);
  EXPECT_NEAR(u.x, left * u0.x, 1e-15);
  EXPECT_NEAR(u.y, left * u0.y, 1e-15);
}

TEST(Motion, RollingEndsAtSpeedOverRollingFriction) {
  const double v = 0.7;
  const auto s = segment(ball_with({v, 0}, {0, v / c.radius, 0}), {}, c);
  ASSERT_EQ(s.state, MotionState::rolling);
  EXPECT_NEAR(s.duration, v / (0.015 * 9.81), 1e-14);  // (17)
  const auto after = after_transition(s, BallId{1}, c);
  EXPECT_EQ(after.state, MotionState::stationary);
  EXPECT_EQ(after.velocity, (Vec2<double>{}));
  EXPECT_EQ(after.angular_velocity, (Vec3<double>{}));
  EXPECT_NEAR(after.position.x, 0.5 + v * v / (2 * 0.015 * 9.81), 1e-15);
}

TEST(Motion, VerticalSpinOutlivesRollingAndDecaysFromEitherSign) {
  for (const double sign : {1.0, -1.0}) {
    const double v = 0.1;
    const auto s = segment(ball_with({v, 0}, {0, v / c.radius, sign * 100}), {}, c);
    const auto after = after_transition(s, BallId{1}, c);
    EXPECT_EQ(after.state, MotionState::spinning);
    const double rate = 5 * 0.044 * 9.81 / (2 * c.radius);  // (10)
    EXPECT_NEAR(after.angular_velocity.z, sign * (100 - rate * s.duration), 1e-11);
    const auto spin = segment(after, {}, c);
    EXPECT_NEAR(spin.duration, 100 / rate - s.duration, 1e-12);
    EXPECT_EQ(after_transition(spin, BallId{1}, c).state, MotionState::stationary);
  }
}

TEST(Motion, VerticalSpinThatEndsBeforeTheRollChangesNothingElse) {
  const auto s = segment(ball_with({1, 0}, {0, 1 / c.radius, 0.5}), {}, c);
  const auto after = after_transition(s, BallId{1}, c);
  EXPECT_EQ(after.angular_velocity.z, 0);
  EXPECT_EQ(after.state, MotionState::stationary);
}

TEST(Motion, BallSpinningOnTheSpotStartsToMoveAgainstItsSlip) {
  const auto s = segment(ball_with({0, 0}, {0, 50, 0}), {}, c);
  ASSERT_EQ(s.state, MotionState::sliding);
  EXPECT_GT(s.acceleration.x, 0);
  const auto after = after_transition(s, BallId{0}, c);
  EXPECT_NEAR(after.velocity.x, 2.0 / 7 * 50 * c.radius, 1e-15);
}

TEST(Motion, DrawWithoutRollOutStopsDead) {
  // 5 v = 2 R w_y backwards: the slide ends at rest.
  const double v = 1.1;
  const auto s = segment(ball_with({v, 0}, {0, -2.5 * v / c.radius, 0}), {}, c);
  const auto after = after_transition(s, BallId{0}, c);
  EXPECT_EQ(after.state, MotionState::stationary);
  EXPECT_EQ(after.velocity, (Vec2<double>{}));
}

TEST(Motion, RoundingOfARollingBallsSpinIsNoSlide) {
  const double v = 0.3;
  EXPECT_EQ(ball_with({v, 0}, {0, v / c.radius * (1 + 1e-15), 0}).state, MotionState::rolling);
  EXPECT_EQ(ball_with({v, 0}, {0, v / c.radius * (1 + 1e-12), 0}).state, MotionState::sliding);
}

TEST(Motion, DenormalSpeedsGiveNoNaN) {
  const auto s = segment(ball_with({5e-324, 0}, {}), {}, c);
  const auto after = after_transition(s, BallId{0}, c);
  EXPECT_TRUE(std::isfinite(after.position.x));
  EXPECT_TRUE(std::isfinite(after.velocity.x));
}

TEST(Motion, WithoutFrictionNothingEverEnds) {
  Materials slick;
  slick.mu_slide = slick.mu_roll = 0;
  slick.mu_spin = 0;
  const auto k = coefficients<double>(slick);
  EXPECT_EQ(segment(ball_with({1, 0}, {}), {}, k).duration, forever<double>());
  EXPECT_EQ(segment(ball_with({0, 0}, {0, 0, 9}), {}, k).duration, forever<double>());
}

TEST(Instant, KeepsWhatALongClockWouldRound) {
  Instant<double> t{};
  for (int i = 0; i < 100000; ++i) {
    t = later(t, 0.1);
  }
  const Instant<double> start = t;
  EXPECT_NEAR(later(start, 1e-13) - start, 1e-13, 1e-27);
  EXPECT_LT(start, later(start, 1e-25));
}

}  // namespace
}  // namespace poolhall::physics
