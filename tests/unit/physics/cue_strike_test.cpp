#include "physics/cue_strike.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/cue_stick.hpp"

namespace poolhall::physics {
namespace {

using ::testing::HasSubstr;

const Materials olympiad = preset_materials("olympiad").value();
const Materials modern = preset_materials("modern").value();
const double R = olympiad.ball_radius;  // NOLINT(readability-identifier-naming): the paper's

Ball<double> struck(const CueShot<double>& shot, const Materials& m = olympiad) {
  return strike(Ball<double>{}, shot, m);
}

double speed(const Ball<double>& ball) {
  return std::hypot(ball.velocity.x, ball.velocity.y);
}

TEST(CueShotFromDegrees, ConvertsUnitsAndKeepsWhatWasGiven) {
  const CueShot<double> shot = cue_shot_from_degrees(1.1, -2.3, 7.7, 123.4, 3.3);
  EXPECT_EQ(shot.a, 0.0011);
  EXPECT_EQ(shot.b, -0.0023);
  EXPECT_DOUBLE_EQ(shot.theta, 7.7 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(shot.phi, 123.4 * std::numbers::pi / 180);
  EXPECT_EQ(shot.speed, 3.3);
  EXPECT_EQ(shot.given, (ShotParameters<double>{1.1, -2.3, 7.7, 123.4, 3.3}));
}

// (5): F = 2 m V0 / (1 + m/M + 5/(2R^2) (...)), a head-on elastic hit of two masses at a = b = 0.
TEST(Strike, ThroughTheCentreIsAnElasticHitOfTwoMasses) {
  const Ball<double> ball = struck(cue_shot_from_degrees(0.0, 0.0, 0.0, 0.0, 2.0));
  const double m = olympiad.ball_mass;
  const double M = olympiad.cue_mass;  // NOLINT(readability-identifier-naming): the paper's
  EXPECT_NEAR(ball.velocity.x, 2 * M / (M + m) * 2.0, 1e-15);
  EXPECT_EQ(ball.velocity.y, 0);
  EXPECT_EQ(ball.angular_velocity, (Vec3<double>{0, 0, 0}));
}

TEST(Strike, WithALevelElasticTipConservesEnergyAndMomentum) {
  const double m = olympiad.ball_mass;
  const double M = olympiad.cue_mass;  // NOLINT(readability-identifier-naming): the paper's
  for (const double a : {-12.0, 0.0, 7.5}) {
    for (const double b : {-9.0, 0.0, 14.0}) {
      const CueShot<double> shot = cue_shot_from_degrees(a, b, 0.0, 37.0, 3.0);
      const Ball<double> ball = struck(shot);
      const double v = speed(ball);
      const double cue = 3.0 - m * v / M;
      const double spin = dot(ball.angular_velocity, ball.angular_velocity);
      EXPECT_NEAR(0.5 * m * v * v + 0.2 * m * R * R * spin + 0.5 * M * cue * cue, 0.5 * M * 9.0,
                  1e-14)
          << a << ' ' << b;
    }
  }
}

TEST(Strike, TwoFifthsOfTheRadiusAboveTheCentreRolls) {
  // w R = 5/2 (b / R) v: rolling at once for b = 2/5 R.
  const Ball<double> ball = struck(cue_shot_from_degrees(0.0, 0.4 * 28.575, 0.0, 90.0, 3.0));
  EXPECT_NEAR(ball.angular_velocity.x, -ball.velocity.y / R, 1e-12);
}

TEST(Strike, LeftEnglishSpinsClockwise) {
  const Ball<double> ball = struck(cue_shot_from_degrees(10.0, 0.0, 0.0, 0.0, 3.0));
  EXPECT_LT(ball.angular_velocity.z, 0);
  EXPECT_NEAR(ball.angular_velocity.z, -2.5 * 0.01 / (R * R) * ball.velocity.x, 1e-10);
  EXPECT_EQ(ball.velocity.y, 0);
}

TEST(Strike, RaisedCueGivesMasseSpinAboutTheShot) {
  // w = (1/I)(-c J sin + b J cos, a J sin, -a J cos) with j back towards the player.
  const Ball<double> ball = struck(cue_shot_from_degrees(8.0, 0.0, 60.0, 0.0, 3.0));
  const double c = std::sqrt(R * R - 0.008 * 0.008);
  const double impulse = ball.velocity.x / 0.5;  // J / m
  const double turn = 2.5 * impulse / (R * R);
  const double sine = std::sqrt(3.0) / 2;
  EXPECT_NEAR(ball.angular_velocity.x, -turn * 0.008 * sine, 1e-10);
  EXPECT_NEAR(ball.angular_velocity.y, -turn * c * sine, 1e-10);
  EXPECT_NEAR(ball.angular_velocity.z, -turn * 0.008 * 0.5, 1e-10);
}

TEST(Strike, StraightDownOnlySpins) {
  const Ball<double> ball = struck(cue_shot_from_degrees(10.0, 5.0, 90.0, 20.0, 4.0));
  EXPECT_EQ(ball.velocity, (Vec2<double>{0, 0}));
  EXPECT_GT(std::hypot(ball.angular_velocity.x, ball.angular_velocity.y), 1);
  EXPECT_EQ(ball.angular_velocity.z, 0);
}

TEST(Strike, LeatherTipTakesSpeed) {
  Materials leather = olympiad;
  leather.tip_restitution = 0.73;
  const CueShot<double> shot = cue_shot_from_degrees(3.0, 2.0, 5.0, 70.0, 3.0);
  EXPECT_NEAR(speed(struck(shot, leather)) / speed(struck(shot)), 1.73 / 2, 1e-14);
}

// Alciatore TP A.31: tan(alpha) = 2.5 x sqrt(1 - x^2) / (1 + m/m_end + 2.5 (1 - x^2)); 1.8 degrees
// at half a radius with an end mass of 1/30.
TEST(Squirt, TurnsAwayFromTheStruckSide) {
  Materials m = olympiad;
  m.squirt_end_mass_ratio = 30;
  const CueShot<double> left = cue_shot_from_degrees(0.5 * 28.575, 0.0, 0.0, 0.0, 3.0);
  const Ball<double> ball = struck(left, m);
  const double alpha = std::atan2(-ball.velocity.y, ball.velocity.x);
  EXPECT_NEAR(std::tan(alpha), 2.5 * 0.5 * std::sqrt(0.75) / (31 + 2.5 * 0.75), 1e-15);
  EXPECT_NEAR(alpha * 180 / std::numbers::pi, 1.886, 1e-3);
  const Ball<double> straight = struck(left);
  EXPECT_NEAR(speed(ball), speed(straight), 1e-15);
  EXPECT_EQ(ball.angular_velocity, straight.angular_velocity);
  const Ball<double> right = struck(cue_shot_from_degrees(-0.5 * 28.575, 0.0, 0.0, 0.0, 3.0), m);
  EXPECT_EQ(right.velocity.x, ball.velocity.x);
  EXPECT_EQ(right.velocity.y, -ball.velocity.y);
}

TEST(Strike, AgreesWithFiftyDigits) {
  using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                             boost::multiprecision::et_off>;
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double a = -11 + 0.0551 * i;
    const double b = 10 - 0.0493 * i;
    const double theta = 0.173 * i;
    const double phi = -350 + 1.7307 * i;
    const auto narrow =
        strike(Ball<double>{}, cue_shot_from_degrees(a, b, theta, phi, 3.7), modern);
    const auto wide =
        strike(Ball<Wide>{}, cue_shot_from_degrees<Wide>(a, b, theta, phi, 3.7), modern);
    worst = std::max({worst, static_cast<double>(abs(narrow.velocity.x - wide.velocity.x)),
                      static_cast<double>(abs(narrow.velocity.y - wide.velocity.y))});
  }
  EXPECT_LT(worst, 4e-15);
}

class ShotOnTheTable : public ::testing::Test {
 protected:
  void place(unsigned id, double x, double y) {
    Ball<double>& ball = balls.balls[balls.count++];
    ball.id = BallId{static_cast<std::uint8_t>(id)};
    ball.position = {origin.x + x, origin.y + y};
  }
  void move_to_olympiad_table() {
    table = preset_table("olympiad").value();
    origin = {0, 0};
  }
  Expected<void> check(double a, double b, double theta, double phi, double v) const {
    return check_shot(cue_shot_from_degrees(a, b, theta, phi, v), balls, table, materials);
  }
  void expect_refused(const Expected<void>& checked, Fault fault, const char* field) const {
    ASSERT_FALSE(checked.has_value());
    EXPECT_EQ(checked.error().fault, fault);
    EXPECT_EQ(checked.error().field, field);
    EXPECT_THAT(checked.error().reason, HasSubstr("expected"));
  }

  // So large that no cue reaches a rail.
  static Table hall() {
    Table large;
    large.width = 10;
    large.length = 10;
    large.pockets = NoPockets{};
    return large;
  }

  Table table = hall();
  Vec2<double> origin{4, 4};
  Materials materials = olympiad;
  BallSet<double> balls;
};

TEST_F(ShotOnTheTable, InTheOpenIsPossible) {
  place(0, 0.5, 0.6);
  EXPECT_TRUE(check(0, 0, 0, 90, 10).has_value());
  EXPECT_TRUE(check(-10, 5, 45, 1e6, 0.001).has_value());
}

TEST_F(ShotOnTheTable, WithANumberOutOfRangeIsRefused) {
  place(0, 0.5, 0.6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  expect_refused(check(nan, 0, 0, 90, 3), Fault::not_finite, "/a");
  expect_refused(check(0, -inf, 0, 90, 3), Fault::not_finite, "/b");
  expect_refused(check(0, 0, nan, 90, 3), Fault::not_finite, "/theta");
  expect_refused(check(0, 0, 0, inf, 3), Fault::not_finite, "/phi");
  expect_refused(check(0, 0, 0, 90, nan), Fault::not_finite, "/v");
  expect_refused(check(0, 0, -0.1, 90, 3), Fault::out_of_range, "/theta");
  expect_refused(check(0, 0, 90.1, 90, 3), Fault::out_of_range, "/theta");
  expect_refused(check(0, 0, 0, 90, 0), Fault::out_of_range, "/v");
  expect_refused(check(0, 0, 0, 90, 10.001), Fault::out_of_range, "/v");
}

TEST_F(ShotOnTheTable, OffTheBallIsRefused) {
  place(0, 0.5, 0.6);
  EXPECT_TRUE(check(28.575, 0, 0, 90, 3).has_value());
  EXPECT_TRUE(check(17.145, 22.86, 0, 90, 3).has_value());  // 0.6 R, 0.8 R
  expect_refused(check(28.576, 0, 0, 90, 3), Fault::tip_off_ball, "/a");
  expect_refused(check(15, -25, 0, 90, 3), Fault::tip_off_ball, "/b");
  expect_refused(check(1e308, 1e308, 0, 90, 3), Fault::tip_off_ball, "/a");
}

TEST_F(ShotOnTheTable, BeyondTheMiscueLimitIsRefused) {
  place(0, 0.5, 0.6);
  materials = modern;
  EXPECT_TRUE(check(14.2875, 0, 0, 90, 3).has_value());
  expect_refused(check(14.3, 0, 0, 90, 3), Fault::miscue, "/a");
  expect_refused(check(0, -15, 0, 90, 3), Fault::miscue, "/b");
  // At 45 degrees a cue at b = 0 passes the centre at c sin 45 = .71 R, one at b = R sin 45 at 0.
  expect_refused(check(0, 0, 45, 90, 3), Fault::miscue, "/a");
  EXPECT_TRUE(check(0, 28.575 * std::numbers::sqrt2 / 2, 45, 90, 3).has_value());
}

TEST_F(ShotOnTheTable, WithoutACueBallIsRefused) {
  place(3, 0.5, 0.6);
  expect_refused(check(0, 0, 0, 90, 3), Fault::no_cue_ball, "");
}

TEST_F(ShotOnTheTable, ThroughABallBehindIsRefusedUntilTheCueIsHighEnough) {
  place(0, 0.5, 0.6);
  place(7, 0.5, 0.4);
  const auto checked = check(0, 0, 0, 90, 3);
  expect_refused(checked, Fault::cue_obstructed, "/theta");
  EXPECT_THAT(checked.error().reason, HasSubstr("ball 7"));
  EXPECT_TRUE(check(0, 0, 0, 0, 3).has_value());
  // The axis from the tip at height R, R behind the centre, must pass the centre of the ball, d =
  // .2 - R further back, at R + .0065: d sin(theta) = R + .0065, theta = 11.81 degrees.
  const double limit = std::asin((R + 0.0065) / (0.2 - R)) * 180 / std::numbers::pi;
  EXPECT_NEAR(limit, 11.81, 0.01);
  expect_refused(check(0, 0, limit - 1e-6, 90, 3), Fault::cue_obstructed, "/theta");
  EXPECT_TRUE(check(0, 0, limit + 1e-6, 90, 3).has_value());
}

TEST_F(ShotOnTheTable, MayTouchABallBesideTheCue) {
  place(0, 0.5, 0.6);
  place(7, 0.5 + R + 0.0065, 0.4);
  EXPECT_TRUE(check(0, 0, 0, 90, 3).has_value());
  balls[1].position.x -= 1e-9;
  expect_refused(check(0, 0, 0, 90, 3), Fault::cue_obstructed, "/theta");
}

TEST_F(ShotOnTheTable, IgnoresPocketedBallsAndBallsBeyondTheStick) {
  place(0, 0.5, 2.1);
  place(7, 0.5, 0.6);
  balls[1].position.y = origin.y + 2.1 - R - 1.45 - R - 1e-9;
  EXPECT_TRUE(check(0, 0, 0, 90, 3).has_value());
  balls[1].position.y += 2e-9;
  expect_refused(check(0, 0, 0, 90, 3), Fault::cue_obstructed, "/theta");
  balls[1].state = MotionState::pocketed;
  EXPECT_TRUE(check(0, 0, 0, 90, 3).has_value());
}

TEST_F(ShotOnTheTable, ThroughARailIsRefusedUntilTheCueIsHighEnough) {
  move_to_olympiad_table();
  place(0, 0.558, 0.2);
  const auto checked = check(0, 0, 0, 90, 3);
  expect_refused(checked, Fault::cue_obstructed, "/theta");
  EXPECT_THAT(checked.error().reason, HasSubstr("the head rail"));
  // Height R + d tan(theta) over the nose line, d = .2 - R; perpendicular gap (height - 1.28 R)
  // cos(theta) = .0065.
  const double d = 0.2 - R;
  double low = 0;
  double high = 45;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    const double t = middle * std::numbers::pi / 180;
    ((R + d * std::tan(t) - 1.28 * R) * std::cos(t) < 0.0065 ? low : high) = middle;
  }
  expect_refused(check(0, 0, low - 1e-6, 90, 3), Fault::cue_obstructed, "/theta");
  EXPECT_TRUE(check(0, 0, low + 1e-6, 90, 3).has_value());
}

TEST_F(ShotOnTheTable, AwayFromTheRailOverAPocketMouthIsPossible) {
  move_to_olympiad_table();
  place(0, 0.15, 0.15);
  EXPECT_TRUE(check(0, 0, 0, 45, 3).has_value());
  expect_refused(check(0, 0, 0, 70, 3), Fault::cue_obstructed, "/theta");
}

TEST_F(ShotOnTheTable, FrozenToTheRailNeedsAHighContact) {
  move_to_olympiad_table();
  place(0, 0.558, R);
  expect_refused(check(0, 0, 30, 90, 3), Fault::cue_obstructed, "/theta");
  EXPECT_TRUE(check(0, 20, 20, 90, 3).has_value());
}

TEST_F(ShotOnTheTable, PossibleShotIsItsOwnNearest) {
  place(0, 0.5, 0.6);
  const CueShot<double> shot = cue_shot_from_degrees(3.0, -2.0, 1.0, 45.0, 2.0);
  const NearestShot nearest = nearest_possible_shot(shot, balls, table, materials);
  EXPECT_FALSE(nearest.moved);
  EXPECT_EQ(nearest.shot.given, shot.given);
}

TEST_F(ShotOnTheTable, NearestShotBringsNumbersIntoRange) {
  place(0, 0.5, 0.6);
  const auto moved = [&](double a, double b, double theta, double v) {
    const CueShot<double> shot = cue_shot_from_degrees(a, b, theta, 30.0, v);
    const NearestShot nearest = nearest_possible_shot(shot, balls, table, materials);
    EXPECT_TRUE(nearest.moved);
    EXPECT_TRUE(check_shot(nearest.shot, balls, table, materials).has_value());
    return nearest.shot.given;
  };
  EXPECT_EQ(moved(0, 0, 0, -0.3).v, 0.01);
  EXPECT_EQ(moved(0, 0, 0, 12).v, 10);
  EXPECT_EQ(moved(0, 0, -2, 3).theta, 0);
  EXPECT_EQ(moved(0, 0, 95, 3).theta, 90);
  const auto on_rim = moved(30, -40, 0, 3);
  EXPECT_NEAR(on_rim.a, 0.6 * 28.575, 1e-12);
  EXPECT_NEAR(on_rim.b, -0.8 * 28.575, 1e-12);
  materials = modern;
  const auto at_limit = moved(12, -16, 0, 3);
  EXPECT_NEAR(at_limit.a, 0.6 * 14.2875, 1e-12);
  EXPECT_NEAR(at_limit.b, -0.8 * 14.2875, 1e-12);
}

TEST_F(ShotOnTheTable, NearestShotRaisesTheCueInTenthsOfADegree) {
  place(0, 0.5, 0.6);
  place(7, 0.5, 0.4);
  const CueShot<double> shot = cue_shot_from_degrees(0.0, 0.0, 3.05, 90.0, 2.0);
  const NearestShot nearest = nearest_possible_shot(shot, balls, table, materials);
  EXPECT_TRUE(nearest.moved);
  // 11.81 degrees clear the ball (see above): 3.05 + 88 tenths.
  EXPECT_NEAR(nearest.shot.given.theta, 11.85, 1e-12);
  EXPECT_EQ(nearest.shot.given.v, 2.0);
}

TEST_F(ShotOnTheTable, NearestShotExistsEvenForABallHemmedIn) {
  move_to_olympiad_table();
  place(0, 0.558, R);
  place(1, 0.558 - 2 * R, R);
  place(2, 0.558 + 2 * R, R);
  place(3, 0.558, 3 * R);
  for (const Materials& m : {olympiad, modern}) {
    materials = m;
    for (int phi = 0; phi < 360; phi += 15) {
      const CueShot<double> shot = cue_shot_from_degrees(2.0, -3.0, 0.0, 1.0 * phi, 2.0);
      const NearestShot nearest = nearest_possible_shot(shot, balls, table, materials);
      EXPECT_TRUE(check_shot(nearest.shot, balls, table, materials).has_value()) << phi;
    }
  }
}

TEST_F(ShotOnTheTable, NearestShotTakesWhatIsNotFinite) {
  place(0, 0.5, 0.6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const CueShot<double> shot = cue_shot_from_degrees(nan, nan, nan, nan, nan);
  const NearestShot nearest = nearest_possible_shot(shot, balls, table, materials);
  EXPECT_TRUE(check_shot(nearest.shot, balls, table, materials).has_value());
}

}  // namespace
}  // namespace poolhall::physics
