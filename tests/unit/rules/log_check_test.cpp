#include "rules/log_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "physics/simulator.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules {
namespace {

struct Place {
  unsigned id;
  physics::Vec2<double> at;
};

GameState table_with(const std::vector<Place>& balls, const physics::Table& table,
                     const physics::Materials& materials) {
  GameState state = new_game({}, table, materials);
  state.kind = TurnKind::shot;
  for (BallPlace& ball : state.balls) {
    ball.where = Whereabouts::pocketed;
  }
  for (const auto& [id, at] : balls) {
    state.balls[id] = {BallId{static_cast<std::uint8_t>(id)}, Whereabouts::on_table, at, {}};
  }
  return state;
}

// The cue ball's own spin presses it to the left rail, along which it slides: its hops are one
// entry, whose `after` is far from where the first of them happened.
TEST(LogCheck, AcceptsAnEntryThatStandsForManyHops) {
  const auto table = physics::preset_table("olympiad").value();
  auto materials = physics::preset_materials("olympiad").value();
  materials.cushion = physics::DampedCushion{.normal = 0.6, .tangential = 1, .spin = 1};
  const physics::Vec2<double> at_rail{materials.ball_radius, 0.4};
  const GameState state = table_with({{0, at_rail}, {8, {0.6, 1.7}}}, table, materials);
  physics::Scene<double> scene{table, materials, balls_on_table(state), {}};
  physics::Ball<double>& ball = scene.balls[0];
  ball.velocity = {0, 0.3};
  ball.angular_velocity = {0, -60, 0};
  ball.state = physics::MotionState::sliding;
  physics::Event<double> strike;
  strike.type = physics::EventType::cue_strike;
  strike.after[0] = ball;
  physics::EventLog<double> events{strike};
  std::ranges::copy(physics::simulate(scene, {}).value().events, std::back_inserter(events));
  ASSERT_TRUE(std::ranges::any_of(events, [](const auto& event) { return event.count > 3; }));
  const auto fits = check_log(state, events, materials);
  EXPECT_TRUE(fits) << fits.error().field << " " << fits.error().reason;
}

}  // namespace
}  // namespace poolhall::rules
