#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "physics/cushion.hpp"

namespace poolhall::physics {
namespace {

// A number in [low, high] in steps of a millionth of the range.
double drawn(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6;
}

Ball<double> any_ball(const Materials& m) {
  Ball<double> ball;
  ball.velocity = {drawn(1e-6, 6), drawn(-6, 6)};
  const double rim = 6 / m.ball_radius;
  ball.angular_velocity = {drawn(-rim, rim), drawn(-rim, rim), drawn(-rim, rim)};
  return ball;
}

double energy(const Ball<double>& ball, const Materials& m) {
  return dot(ball.velocity, ball.velocity) +
         0.4 * m.ball_radius * m.ball_radius * dot(ball.angular_velocity, ball.angular_velocity);
}

void expect_a_bounce_without_gain(const Materials& m) {
  const Ball<double> before = any_ball(m);
  const NoseAngle<double> nose = nose_angle<double>(preset_table("olympiad").value(), m);
  const Ball<double> after = after_cushion(before, Vec2<double>{1, 0}, m, nose);
  RC_ASSERT(std::isfinite(energy(after, m)));
  RC_ASSERT(energy(after, m) <= energy(before, m) * (1 + 1e-13));
  RC_ASSERT(after.position == before.position);
}

RC_GTEST_PROP(DampedCushion, NeverGainsEnergy, ()) {
  Materials m = preset_materials("olympiad").value();
  expect_a_bounce_without_gain(m);
}

RC_GTEST_PROP(Mathavan2010Cushion, NeverGainsEnergyAndNeverStaysInTheCushion, ()) {
  Materials m = preset_materials("modern").value();
  m.mu_slide = drawn(0, 1);
  m.cushion = Mathavan2010Cushion{drawn(0, 1), drawn(0, 1), drawn(1.0, 1.5) * m.ball_radius};
  expect_a_bounce_without_gain(m);
  const Ball<double> before = any_ball(m);
  const NoseAngle<double> nose = nose_angle<double>(preset_table("olympiad").value(), m);
  const Ball<double> after = after_cushion(before, Vec2<double>{1, 0}, m, nose);
  RC_ASSERT(after.velocity.x <= 1e-12);
}

RC_GTEST_PROP(Mathavan2010Cushion, IsConvergedToLongDouble, ()) {
  Materials m = preset_materials("modern").value();
  m.mu_slide = drawn(0, 0.5);
  m.cushion = Mathavan2010Cushion{drawn(0.3, 1), drawn(0, 0.5), {}};
  const Ball<double> before = any_ball(m);
  Ball<long double> wide;
  wide.velocity = {before.velocity.x, before.velocity.y};
  wide.angular_velocity = {before.angular_velocity.x, before.angular_velocity.y,
                           before.angular_velocity.z};
  const Table table = preset_table("olympiad").value();
  const auto after = after_cushion(before, Vec2<double>{1, 0}, m, nose_angle<double>(table, m));
  const auto exact =
      after_cushion(wide, Vec2<long double>{1, 0}, m, nose_angle<long double>(table, m));
  const double scale = std::sqrt(energy(before, m));
  RC_ASSERT(std::abs(static_cast<double>(exact.velocity.x - after.velocity.x)) < 1e-11 * scale);
  RC_ASSERT(std::abs(static_cast<double>(exact.velocity.y - after.velocity.y)) < 1e-11 * scale);
  RC_ASSERT(std::abs(static_cast<double>(exact.angular_velocity.z - after.angular_velocity.z)) *
                m.ball_radius <
            1e-11 * scale);
}

// Han's impact leaves out the cloth: rolling into the cushion at any angle never gains.
RC_GTEST_PROP(Han2005Cushion, RollingNeverGainsEnergy, ()) {
  Materials m = preset_materials("modern").value();
  m.cushion = Han2005Cushion{drawn(0, 1), drawn(0, 0.4), {}};
  Ball<double> ball;
  ball.velocity = {drawn(1e-6, 6), drawn(-6, 6)};
  ball.angular_velocity = {-ball.velocity.y / m.ball_radius, ball.velocity.x / m.ball_radius, 0};
  const NoseAngle<double> nose = nose_angle<double>(preset_table("olympiad").value(), m);
  const Ball<double> after = after_cushion(ball, Vec2<double>{1, 0}, m, nose);
  RC_ASSERT(energy(after, m) <= energy(ball, m) * (1 + 1e-13));
}

}  // namespace
}  // namespace poolhall::physics
