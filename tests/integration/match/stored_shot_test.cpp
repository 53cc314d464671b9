// A stored row is enough to draw a shot: any instant, rebuilt from the row by the motion laws of
// the paper as they are written out here, is where the simulator has the balls.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "physics/simulator.hpp"
#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::match {
namespace {

// The Olympiad's materials (protocol/README.md), not read from the physics library.
constexpr double radius = 0.028575;
constexpr double gravity = 9.81;
constexpr double mu_slide = 0.2;
constexpr double mu_roll = 0.015;

struct Place {
  double x = 0;
  double y = 0;
};

// A ball's motion since its last event.
struct Motion {
  double since = 0;
  bool pocketed = false;
  Place at{};
  Place velocity{};
  Place acceleration{};

  [[nodiscard]] Place place(double t) const {
    const double dt = t - since;
    return {at.x + velocity.x * dt + acceleration.x * dt * dt / 2,
            at.y + velocity.y * dt + acceleration.y * dt * dt / 2};
  }
};

Motion motion_after(double t, const physics::Ball<double>& ball) {
  Motion motion{.since = t, .at = {ball.position.x, ball.position.y}};
  const Place v{ball.velocity.x, ball.velocity.y};
  Place against = v;  // a rolling ball is slowed against its velocity
  double deceleration = mu_roll * gravity;
  switch (ball.state) {
    case physics::MotionState::pocketed:
      motion.pocketed = true;
      return motion;
    case physics::MotionState::stationary:
    case physics::MotionState::spinning:
      return motion;
    case physics::MotionState::sliding:  // against the slip at the cloth, (6)
      against = {v.x - radius * ball.angular_velocity.y, v.y + radius * ball.angular_velocity.x};
      deceleration = mu_slide * gravity;
      break;
    case physics::MotionState::rolling:
      break;
  }
  const double size = std::hypot(against.x, against.y);
  motion.velocity = v;
  motion.acceleration = {-deceleration * against.x / size, -deceleration * against.y / size};
  return motion;
}

using Motions = std::map<unsigned, Motion>;

Motions motions_at(const storage::TurnRecord& row, double t) {
  Motions motions;
  const rules::GameState before = protocol::decode_state(row.state_before).value();
  for (const rules::BallPlace& ball : before.balls) {
    if (ball.where == rules::Whereabouts::on_table)
      motions[physics::number(ball.id)] = {.at = {ball.position.x, ball.position.y}};
  }
  if (row.shot->cue_ball)
    motions[0] = {.at = {row.shot->cue_ball->x, row.shot->cue_ball->y}};
  const auto events = protocol::decode_events(row.shot->events).value();
  for (const auto& event : events) {
    if (event.t > t)
      break;
    for (std::size_t i = 0; i < event.ball_count; ++i)
      motions[physics::number(event.after[i].id)] = motion_after(event.t, event.after[i]);
  }
  return motions;
}

// Largest distance between the row's and the simulator's balls at that instant.
double largest_error(const storage::TurnRecord& row, const Board& board, double t) {
  const rules::GameState before = protocol::decode_state(row.state_before).value();
  const auto ready =
      rules::prepare_shot(before, row.shot->call, row.shot->cue_ball, board.table, board.materials);
  const auto simulated =
      physics::simulate(scene_of(*ready, board, row.shot->executed), {.t_max = t});
  Motions motions = motions_at(row, t);
  double largest = 0;
  for (const auto& ball : simulated->balls) {
    const Motion& motion = motions.at(physics::number(ball.id));
    EXPECT_EQ(motion.pocketed, ball.state == physics::MotionState::pocketed);
    if (motion.pocketed)
      continue;
    const Place place = motion.place(t);
    largest = std::max(largest, std::hypot(place.x - ball.position.x, place.y - ball.position.y));
  }
  return largest;
}

TEST(StoredShot, has_every_instant_in_its_row) {
  test_support::TemporaryDirectory directory;
  auto database = storage::open_sqlite(directory / "test.db").value();
  add_players(*database);
  PlayedGame played(*database, order_of(1), 3);
  played.play(12);

  int instants = 0;
  int shots = 0;
  double largest = 0;
  must(database->each_turn(protocol::GameId{1}, [&](const storage::TurnRecord& row) {
    if (!row.shot)
      return true;
    ++shots;
    const double end = protocol::decode_events(row.shot->events).value().back().t;
    for (int i = 0; i <= 40; ++i, ++instants)
      largest = std::max(largest, largest_error(row, played.game().board(), end * i / 39.5));
    return true;
  }));
  std::ostringstream written;
  written << largest;
  RecordProperty("largest_error_m", written.str());
  EXPECT_GE(shots, 8);
  EXPECT_LT(largest, 1e-12) << instants << " instants";
}

TEST(StoredShot, is_the_shot_that_its_executed_parameters_give) {
  test_support::TemporaryDirectory directory;
  auto database = storage::open_sqlite(directory / "test.db").value();
  add_players(*database);
  PlayedGame played(*database, order_of(1), 4);
  played.play(8);
  must(database->each_turn(protocol::GameId{1}, [&](const storage::TurnRecord& row) {
    if (!row.shot)
      return true;
    const Board& board = played.game().board();
    const auto before = protocol::decode_state(row.state_before).value();
    const auto ready = rules::prepare_shot(before, row.shot->call, row.shot->cue_ball, board.table,
                                           board.materials);
    const auto simulated = physics::simulate(scene_of(*ready, board, row.shot->executed), {});
    EXPECT_EQ(protocol::encode_events(simulated->events, protocol::EventDetail::full),
              row.shot->events);
    EXPECT_NE(row.shot->intended, row.shot->executed);
    return true;
  }));
}

}  // namespace
}  // namespace poolhall::match
