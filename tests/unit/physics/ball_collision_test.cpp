#include "physics/ball_collision.hpp"

#include <gtest/gtest.h>

#include "physics/energy.hpp"

namespace poolhall::physics {
namespace {

Materials smooth() {
  Materials m;
  m.ball_friction = ConstantFriction{0};
  return m;
}

Ball<double> at(Vec2<double> position, Vec2<double> v = {}, Vec3<double> w = {}) {
  Ball<double> ball;
  ball.position = position;
  ball.velocity = v;
  ball.angular_velocity = w;
  return ball;
}

PairAfter<double> hit(const Ball<double>& first, const Ball<double>& second, const Materials& m) {
  return collide(first, second, coefficients<double>(m), m.ball_friction);
}

TEST(BallCollision, HeadOnWithoutFrictionSwapsTheVelocities) {
  const Materials m = smooth();
  const auto after = hit(at({0, 0}, {2, 0}), at({2 * m.ball_radius, 0}), m);
  EXPECT_EQ(after.first.velocity, (Vec2<double>{0, 0}));
  EXPECT_EQ(after.second.velocity, (Vec2<double>{2, 0}));
  EXPECT_EQ(after.first.state, MotionState::stationary);
  EXPECT_EQ(after.second.state, MotionState::sliding);
}

TEST(BallCollision, CutShotWithoutFrictionPartsAtRightAngles) {
  const Materials m = smooth();
  const auto after =
      hit(at({0, 0}, {0, 3}), at({2 * m.ball_radius * 0.6, 2 * m.ball_radius * 0.8}), m);
  EXPECT_NEAR(dot(after.first.velocity, after.second.velocity), 0, 3e-15);
  EXPECT_NEAR(after.second.velocity.x / after.second.velocity.y, 0.75, 1e-15);
}

TEST(BallCollision, KeepsMomentumAndNeverGainsEnergy) {
  Materials m;
  m.ball_friction = AlciatoreFriction{};
  m.ball_restitution = 0.95;
  const auto c = coefficients<double>(m);
  for (int i = 0; i < 360; i += 7) {
    const Direction<double> way = direction_of_degrees(static_cast<double>(i));
    const auto first = at({0, 0}, {way.cosine * 2, way.sine * 2}, {30, -10, 40.0 - i});
    const auto second = at({2 * m.ball_radius, 0}, {-2.5, 0.3}, {5, 20, -30});
    const auto after = hit(first, second, m);
    const Vec2<double> before = first.velocity + second.velocity;
    const Vec2<double> now = after.first.velocity + after.second.velocity;
    EXPECT_NEAR(before.x, now.x, 1e-14);
    EXPECT_NEAR(before.y, now.y, 1e-14);
    EXPECT_LE(kinetic_energy(after.first, c) + kinetic_energy(after.second, c),
              kinetic_energy(first, c) + kinetic_energy(second, c));
  }
}

TEST(BallCollision, FrictionStopsTheSlipAtMost) {
  Materials m;
  m.ball_friction = ConstantFriction{1e6};
  const auto first = at({0, 0}, {1, 0.5}, {0, 0, 12});
  const auto second = at({2 * m.ball_radius, 0});
  const auto after = hit(first, second, m);
  const auto slip = contact_slip(after.first, after.second, Vec2<double>{1, 0}, m.ball_radius);
  EXPECT_NEAR(slip.along, 0, 1e-15);
}

TEST(BallCollision, ThrowOfAStunShotIsFrictionTimesNormalSpeedWhileItSlips) {
  Materials m;
  m.ball_friction = ConstantFriction{0.01};
  const auto after = hit(at({0, 0}, {1, 1}), at({2 * m.ball_radius, 0}), m);
  EXPECT_NEAR(after.second.velocity.x, 1, 1e-15);
  EXPECT_NEAR(after.second.velocity.y, 0.01, 1e-15);
  EXPECT_NEAR(after.first.velocity.y, 0.99, 1e-15);
  // Collision-induced spin: both balls turn the same way, 5 Jt / (2 m R).
  EXPECT_NEAR(after.first.angular_velocity.z, -2.5 * 0.01 / m.ball_radius, 1e-13);
  EXPECT_EQ(after.first.angular_velocity, after.second.angular_velocity);
}

TEST(BallCollision, TopspinLiftsNothingButTurnsTheObjectBallBackwards) {
  Materials m;
  m.ball_friction = ConstantFriction{0.05};
  const double v = 1;
  const auto after =
      hit(at({0, 0}, {v, 0}, {0, v / m.ball_radius, 0}), at({2 * m.ball_radius, 0}), m);
  EXPECT_LT(after.second.angular_velocity.y, 0);
  EXPECT_LT(after.first.angular_velocity.y, v / m.ball_radius);
}

TEST(BallCollision, SwappingTheBallsSwapsTheResultBitForBit) {
  Materials m;
  m.ball_friction = AlciatoreFriction{};
  const auto first = at({0.1, 0.2}, {1.3, -0.2}, {3, 70, -5});
  const auto second = at({0.1 + 0.04, 0.2 + 0.0408}, {-0.3, -1}, {9, -4, 8});
  const auto one = hit(first, second, m);
  const auto other = hit(second, first, m);
  EXPECT_EQ(one.first.velocity, other.second.velocity);
  EXPECT_EQ(one.second.velocity, other.first.velocity);
  EXPECT_EQ(one.first.angular_velocity, other.second.angular_velocity);
}

TEST(BallCollision, SlowPairPartsAtTheSeparationSpeed) {
  const Materials m = smooth();
  const auto after = hit(at({0, 0}, {1e-5, 0}), at({2 * m.ball_radius, 0}), m);
  EXPECT_TRUE(after.impact.raised);
  EXPECT_NEAR(after.second.velocity.x - after.first.velocity.x, 1e-3, 1e-18);
}

}  // namespace
}  // namespace poolhall::physics
