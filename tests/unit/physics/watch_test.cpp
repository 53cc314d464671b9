#include "physics/watch.hpp"

#include <gtest/gtest.h>

#include "physics/event_loop.hpp"

namespace poolhall::physics {
namespace {

Event<double> rail_hit(double t, unsigned ball, RailId rail) {
  Event<double> e;
  e.t = t;
  e.type = EventType::rail_collision;
  e.after[0].id = BallId{static_cast<std::uint8_t>(ball)};
  e.rail = rail;
  return e;
}

Event<double> contact(double t, unsigned first, unsigned second) {
  Event<double> e;
  e.t = t;
  e.type = EventType::ball_collision;
  e.ball_count = 2;
  e.after[0].id = BallId{static_cast<std::uint8_t>(first)};
  e.after[1].id = BallId{static_cast<std::uint8_t>(second)};
  return e;
}

TEST(Recorder, ThreeHopsInARowAreThreeEntries) {
  Recorder<double> log;
  for (int i = 0; i < 3; ++i) {
    log.record(rail_hit(i, 1, RailId::head), Hop::yes);
  }
  EXPECT_EQ(log.take().size(), 3U);
}

TEST(Recorder, MoreThanThreeHopsInARowAreOneEntryAsAtItsEnd) {
  Recorder<double> log;
  for (int i = 0; i < 6; ++i) {
    auto hop = rail_hit(i, 1, RailId::head);
    hop.after[0].position.x = i;
    log.record(hop, Hop::yes);
    log.record(rail_hit(i + 0.5, 2, RailId::foot), Hop::no);
  }
  const auto events = log.take();
  ASSERT_EQ(events.size(), 7U);
  EXPECT_EQ(events[0].count, 6U);
  EXPECT_EQ(events[0].t, 0);
  EXPECT_EQ(events[0].until, 5.0);
  EXPECT_EQ(events[0].after[0].position.x, 5);
}

TEST(Recorder, AnotherCollisionOfTheBallBreaksTheRow) {
  Recorder<double> log;
  for (int i = 0; i < 3; ++i) {
    log.record(rail_hit(i, 1, RailId::head), Hop::yes);
  }
  log.record(contact(3, 1, 2), Hop::no);
  for (int i = 4; i < 7; ++i) {
    log.record(rail_hit(i, 1, RailId::head), Hop::yes);
  }
  EXPECT_EQ(log.take().size(), 7U);
}

TEST(Recorder, ATransitionOfTheBallBreaksTheRow) {
  Recorder<double> log;
  for (int i = 0; i < 3; ++i) {
    log.record(contact(i, 1, 2), Hop::yes);
  }
  auto transition = rail_hit(3, 2, RailId::foot);
  transition.type = EventType::transition;
  transition.rail.reset();
  log.record(transition, Hop::no);
  log.record(contact(4, 1, 2), Hop::yes);
  EXPECT_EQ(log.take().size(), 5U);
}

TEST(Recorder, HopsOfAPairAreBrokenByEitherBall) {
  for (const unsigned breaker : {1U, 2U}) {
    Recorder<double> log;
    for (int i = 0; i < 3; ++i) {
      log.record(contact(i, 1, 2), Hop::yes);
    }
    log.record(rail_hit(3, breaker, RailId::foot), Hop::no);
    log.record(contact(4, 1, 2), Hop::yes);
    EXPECT_EQ(log.take().size(), 5U) << breaker;
  }
  Recorder<double> log;
  for (int i = 0; i < 5; ++i) {
    log.record(contact(i, 1, 2), Hop::yes);
  }
  EXPECT_EQ(log.take().size(), 1U);
}

Scene<double> two_balls() {
  Scene<double> scene;
  scene.table = *preset_table("olympiad");
  scene.materials = *preset_materials("olympiad");
  scene.balls.count = 2;
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {0.5, 1.0};
  scene.balls[1].id = BallId{7};
  scene.balls[1].position = {0.3, 0.6};
  return scene;
}

TEST(FirstContactQuestion, StopsAtTheFirstBallTouched) {
  Scene<double> scene = two_balls();
  scene.shot = cue_shot_from_degrees(0.0, 0.0, 10.0, 243.43, 2.0);
  EventLoop<double> loop(scene.table, scene.materials);
  FirstContact question{cue_ball, {}};
  EXPECT_EQ(loop.run(scene.balls, scene.shot, {}, question), Ending::stopped);
  EXPECT_EQ(question.touched, BallId{7});
  EXPECT_LT(loop.duration(), 0.5);
}

TEST(WillBePocketedQuestion, StopsWhenTheBallIsDown) {
  Scene<double> scene = two_balls();
  scene.balls[1].position = {0.1, 0.1};
  scene.balls[1].velocity = {-0.5, -0.5};
  scene.balls[1].state = MotionState::sliding;
  EventLoop<double> loop(scene.table, scene.materials);
  WillBePocketed question{BallId{7}, {}};
  EXPECT_EQ(loop.run(scene.balls, {}, {}, question), Ending::stopped);
  EXPECT_EQ(question.pocket, PocketId::head_left);
}

TEST(SustainedContact, BallPressedToARailHopsAtTheSeparationSpeed) {
  Scene<double> scene = two_balls();
  scene.table.pockets = NoPockets{};
  scene.materials.cushion = DampedCushion{0.6, 1.0, 1.0};
  const double radius = scene.materials.ball_radius;
  scene.balls[0].position = {radius, 0.6};
  scene.balls[0].velocity = {0, 1.5};
  scene.balls[0].angular_velocity = {0, -60, 0};
  scene.balls[0].state = MotionState::sliding;
  const auto result = simulate(scene, {});
  ASSERT_TRUE(result);
  const auto& first = result->events.front();
  EXPECT_EQ(first.type, EventType::rail_collision);
  EXPECT_GT(first.count, 3U);
  ASSERT_TRUE(first.until);
  EXPECT_GT(*first.until, first.t);
  EXPECT_EQ(first.after[0].position.x, radius);
  EXPECT_GT(result->energy.added_by_separation, 0);
}

}  // namespace
}  // namespace poolhall::physics
