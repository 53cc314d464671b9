#include "physics/reference/reference_simulator.hpp"

#include <gtest/gtest.h>

namespace poolhall::physics::reference {
namespace {

Ball<double> ball_at(unsigned id, double x, double y) {
  Ball<double> ball;
  ball.id = BallId{static_cast<std::uint8_t>(id)};
  ball.position = {x, y};
  return ball;
}

ReferenceScene open_table(std::initializer_list<Ball<double>> balls) {
  ReferenceScene scene;
  scene.table.width = 20;
  scene.table.length = 40;
  scene.table.pockets = NoPockets{};
  for (const Ball<double>& ball : balls) {
    scene.balls[scene.balls.count++] = ball;
  }
  return scene;
}

double as_double(const Number& x) {
  return x.convert_to<double>();
}

TEST(Reference, ACentreHitSlidesAndRollsAsTheFormulasSay) {
  ReferenceScene scene = open_table({ball_at(0, 10, 2)});
  scene.shot = ReferenceShot{0, 0, 0, 90, 1};
  const ReferenceSimulation run = reference_simulate(scene, {});
  const Materials& m = scene.materials;
  const double v = 2 / (1 + m.ball_mass / m.cue_mass);
  ASSERT_EQ(run.events.size(), 3u);
  EXPECT_NEAR(as_double(run.events[0].after[0].velocity.y), v, 1e-15);
  const double slide = 2 * v / (7 * m.mu_slide * m.gravity);
  EXPECT_NEAR(as_double(run.events[1].t), slide, 1e-15);
  const double rolled = 5 * v / 7;
  EXPECT_NEAR(as_double(run.events[1].after[0].velocity.y), rolled, 1e-15);
  EXPECT_NEAR(as_double(run.duration), slide + rolled / (m.mu_roll * m.gravity), 1e-14);
  EXPECT_NEAR(as_double(run.balls[0].position.y),
              2 + 12 * v * v / (49 * m.mu_slide * m.gravity) +
                  rolled * rolled / (2 * m.mu_roll * m.gravity),
              1e-14);
}

TEST(Reference, AStunShotStopsTheCueBallAtOneHundredDigits) {
  ReferenceScene scene = open_table({ball_at(0, 10, 10), ball_at(1, 10, 10.5)});
  scene.materials.ball_friction = ConstantFriction{0};
  scene.materials.separation_speed = 0;
  scene.balls[0].velocity = {0, 3};
  const ReferenceSimulation run = reference_simulate(scene, {});
  const auto& hit = run.events.front();
  ASSERT_EQ(hit.type, EventType::ball_collision);
  EXPECT_LT(abs(hit.after[0].velocity.y), Number("1e-95"));
  const Number distance = hit.after[1].position.y - hit.after[0].position.y;
  EXPECT_LT(abs(distance - 2 * Number(scene.materials.ball_radius)), Number("1e-95"));
  // v^2 = v0^2 - 2 mu g s over the way that the cue ball slid.
  const Number way = hit.after[0].position.y - 10;
  const Number deceleration = Number(scene.materials.mu_slide) * scene.materials.gravity;
  const Number speed = hit.after[1].velocity.y;
  EXPECT_LT(abs(speed * speed - (9 - 2 * deceleration * way)), Number("1e-90"));
}

TEST(Reference, FrictionlessBallsLeaveAtARightAngle) {
  ReferenceScene scene = open_table({ball_at(0, 10, 10), ball_at(1, 10.03, 10.5)});
  scene.materials.ball_friction = ConstantFriction{0};
  scene.balls[0].velocity = {0, 2};
  const ReferenceSimulation run = reference_simulate(scene, {});
  const auto& hit = run.events.front();
  ASSERT_EQ(hit.type, EventType::ball_collision);
  EXPECT_LT(abs(dot(hit.after[0].velocity, hit.after[1].velocity)), Number("1e-90"));
}

}  // namespace
}  // namespace poolhall::physics::reference
