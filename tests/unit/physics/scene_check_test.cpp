#include <gtest/gtest.h>

#include <limits>

#include "physics/motion.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {
namespace {

Scene<double> scene_with(std::string_view table = "olympiad") {
  Scene<double> scene;
  scene.table = *preset_table(table);
  scene.materials = *preset_materials("olympiad");
  scene.balls.count = 2;
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {0.4, 0.5};
  scene.balls[1].id = BallId{1};
  scene.balls[1].position = {0.6, 1.0};
  return scene;
}

Error refusal(const Scene<double>& scene) {
  const auto checked = check_scene(scene);
  EXPECT_FALSE(checked.has_value());
  return checked ? Error{Fault::bad_table, "accepted", ""} : checked.error();
}

TEST(CheckScene, AcceptsAnOrdinaryScene) {
  EXPECT_TRUE(check_scene(scene_with()));
}

TEST(CheckScene, NamesTheFieldOfANumberThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    Scene<double> scene = scene_with();
    scene.balls[1].position.y = bad;
    EXPECT_EQ(refusal(scene).field, "/balls/1/y");
    EXPECT_EQ(refusal(scene).fault, Fault::not_finite);
    scene = scene_with();
    scene.balls[1].angular_velocity.z = bad;
    EXPECT_EQ(refusal(scene).field, "/balls/1/wz");
  }
}

TEST(CheckScene, RefusesSpeedsBeyondMeaning) {
  Scene<double> scene = scene_with();
  scene.balls[1].velocity.x = 1e7;
  EXPECT_EQ(refusal(scene).fault, Fault::out_of_range);
}

TEST(CheckScene, TellsNumbersAsTheyWereGiven) {
  Scene<double> scene = scene_with();
  scene.balls[1].velocity.x = 1e300;
  EXPECT_EQ(refusal(scene).reason, "expected a magnitude of at most 1e+06, got 1e+300");
  scene = scene_with();
  scene.balls[0].position.x = 1e-9;
  EXPECT_EQ(refusal(scene).reason, "expected a place on the table, 1e-09 is beyond the rail");
  const auto result = simulate(scene_with(), {.t_max = 1e300});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, "expected 0 to 1e9 seconds, got 1e+300");
}

TEST(CheckScene, RefusesOverlapButNotWhatRoundingLeaves) {
  Scene<double> scene = scene_with();
  const double touching = 2 * scene.materials.ball_radius;
  scene.balls[1].position = {0.4 + touching - 1e-12, 0.5};
  EXPECT_TRUE(check_scene(scene));
  scene.balls[1].position = {0.4 + touching - 1e-6, 0.5};
  EXPECT_EQ(refusal(scene).fault, Fault::overlap);
  EXPECT_EQ(refusal(scene).field, "/balls/1/x");
}

TEST(CheckScene, RefusesABallBeyondARailOrAMouthLine) {
  Scene<double> scene = scene_with();
  scene.balls[0].position.x = 0.028;
  EXPECT_EQ(refusal(scene).field, "/balls/0/x");
  scene.balls[0].position = {0.5, 2.21};
  EXPECT_EQ(refusal(scene).field, "/balls/0/y");
  scene.balls[0].position = {0.05, 0.05};
  EXPECT_EQ(refusal(scene).fault, Fault::outside_table);
}

TEST(CheckScene, AllowsABallBetweenTheJawsButNotInTheHole) {
  Scene<double> scene = scene_with("bar7");
  scene.balls[0].position = {0.055, 0.055};
  EXPECT_TRUE(check_scene(scene));
  scene.balls[0].position = {-0.02, -0.02};
  EXPECT_EQ(refusal(scene).fault, Fault::outside_table);
  scene.balls[0].position = {0.5, 0.02};
  EXPECT_EQ(refusal(scene).fault, Fault::outside_table);
}

TEST(CheckScene, RefusesAStateThatContradictsTheVelocities) {
  Scene<double> scene = scene_with();
  scene.balls[1].velocity = {1, 0};
  EXPECT_EQ(refusal(scene).fault, Fault::inconsistent_state);
  EXPECT_EQ(refusal(scene).field, "/balls/1/state");
  scene.balls[1].state = MotionState::sliding;
  EXPECT_TRUE(check_scene(scene));
  scene.balls[1] = settled(scene.balls[1], scene.materials.ball_radius);
  EXPECT_TRUE(check_scene(scene));
  scene.balls[1] = {};
  scene.balls[1].id = BallId{1};
  scene.balls[1].state = MotionState::pocketed;
  EXPECT_EQ(refusal(scene).fault, Fault::inconsistent_state);
  scene.balls[1].pocket = PocketId::side_left;
  EXPECT_TRUE(check_scene(scene));
}

TEST(CheckScene, RefusesABallThatIsThereTwice) {
  Scene<double> scene = scene_with();
  scene.balls[1].id = cue_ball;
  EXPECT_EQ(refusal(scene).fault, Fault::duplicate_ball);
}

TEST(CheckScene, RefusesABallBeyondFifteen) {
  Scene<double> scene = scene_with();
  scene.balls[1].id = BallId{16};
  EXPECT_EQ(refusal(scene).field, "/balls/1/id");
  EXPECT_EQ(refusal(scene).fault, Fault::out_of_range);
}

TEST(CheckScene, AShotNeedsACueBall) {
  Scene<double> scene = scene_with();
  scene.shot = cue_shot_from_degrees(0.0, 0.0, 10.0, 90.0, 2.0);
  EXPECT_TRUE(check_scene(scene));
  scene.balls[0].id = BallId{5};
  EXPECT_EQ(refusal(scene).fault, Fault::no_cue_ball);
  EXPECT_EQ(refusal(scene).field, "/shot");
}

TEST(Simulate, RefusesATimeLimitThatIsNoTime) {
  for (const double t : {-1.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    const auto result = simulate(scene_with(), {.t_max = t});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().field, "/t_max");
  }
}

TEST(Simulate, StopsAtItsTimeLimitWithTheBallsAsTheyAreThen) {
  Scene<double> scene = scene_with();
  scene.balls[0].velocity = {0, 1};
  scene.balls[0].state = MotionState::sliding;
  const auto result = simulate(scene, {.t_max = 0.05});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->ending, Ending::t_max);
  EXPECT_NEAR(result->balls[0].position.y, 0.5 + 0.05 - 0.1 * 9.81 * 0.0025, 1e-15);
  EXPECT_EQ(result->balls[0].state, MotionState::sliding);
  EXPECT_EQ(result->duration, 0);
}

TEST(CheckScene, NamesWhatIsWrongWithAShot) {
  Scene<double> scene = scene_with();
  scene.shot = cue_shot_from_degrees(40.0, 0.0, 10.0, 90.0, 2.0);
  EXPECT_EQ(refusal(scene).fault, Fault::tip_off_ball);
  scene.shot = cue_shot_from_degrees(0.0, 0.0, 10.0, 90.0, 20.0);
  EXPECT_EQ(refusal(scene).field, "/shot/v");
}

}  // namespace
}  // namespace poolhall::physics
