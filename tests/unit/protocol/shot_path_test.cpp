#include "protocol/shot_path.hpp"

#include <gtest/gtest.h>

#include "protocol/events_json.hpp"

namespace poolhall::protocol::shot_path_tests {
namespace {

const physics::Table table = physics::preset_table("olympiad").value();
const physics::Materials materials = physics::preset_materials("olympiad").value();
const rules::GameState start = rules::new_game({}, table, materials);
constexpr physics::Vec2<double> spot{0.558, 0.5};

tl::expected<ReadyShot, ShotRefusal> asked(const physics::Vec2<double>& cue_ball,
                                           const ShotParams& stroke) {
  return ready_shot(start, {}, cue_ball, stroke, table, materials);
}

TEST(ShotPath, RefusesAPlacementWithItsPlaceInTheRequest) {
  const auto ready = asked({0.558, 1.0}, {0, 0, 5, 90, 4});
  ASSERT_FALSE(ready);
  const Error error = request_error(ready.error());
  EXPECT_EQ(error.code, ErrorCode::bad_cue_ball_position);
  EXPECT_EQ(error.field, "/params/cue_ball/y");
}

TEST(ShotPath, RefusesAStrokeWithItsPlaceInTheRequest) {
  const auto ready = asked(spot, {0, 0, 5, 90, materials.max_cue_speed + 1});
  ASSERT_FALSE(ready);
  const Error error = request_error(ready.error());
  EXPECT_EQ(error.code, ErrorCode::bad_shot);
  EXPECT_EQ(error.field, "/params/params/v");
}

TEST(ShotPath, PlacesTheCueBallAndPlaysWhatWasAskedFor) {
  const auto ready = asked(spot, {0, 0, 5, 90, 9});
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->scene.balls[0].position, spot);
  const auto played = play_shot(*ready);
  ASSERT_TRUE(played);
  EXPECT_TRUE(played->ruling.first_contact);
  EXPECT_EQ(played->ruling.next.turn, start.turn + 1);
}

TEST(ShotPath, PlaysTheStrokeThatNoiseHasMade) {
  auto ready = asked(spot, {0, 0, 5, 90, 9});
  ASSERT_TRUE(ready);
  const ShotParams backwards{0, 0, 5, 270, 1};
  ready->scene.shot = to_physics(backwards);
  const auto played = play_shot(*ready);
  ASSERT_TRUE(played);
  EXPECT_EQ(played->ruling.first_contact, std::nullopt);
  EXPECT_EQ(encode_events(played->simulation.events, EventDetail::full),
            encode_events(play_shot(asked(spot, backwards).value()).value().simulation.events,
                          EventDetail::full));
}

}  // namespace
}  // namespace poolhall::protocol::shot_path_tests
