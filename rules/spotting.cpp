#include "rules/spotting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/common_clauses.hpp"

namespace poolhall::rules {
namespace {

using physics::Vec2;

struct Obstacle {
  Vec2<double> centre;
  double reach = 0;  // m, smallest distance of the spotted ball's centre
};

std::vector<Obstacle> obstacles(const GameState& state, BallId ball,
                                const physics::Materials& materials) {
  std::vector<Obstacle> found;
  for (const BallPlace& place : state.balls) {
    if (place.where != Whereabouts::on_table || place.id == ball) {
      continue;
    }
    const bool clear = applies(clauses::spot_clear_of_cue_ball, place.id == physics::cue_ball);
    found.push_back(
        {place.position, 2 * materials.ball_radius + (clear ? cue_ball_clearance : 0.0)});
  }
  return found;
}

// The nearest place to the spot that the obstacle leaves on the string in this direction (+1 to
// the foot, -1 to the head), at its full reach as computed.
std::optional<double> place_behind(const Obstacle& obstacle, double x, double direction) {
  const double across = x - obstacle.centre.x;
  if (std::abs(across) >= obstacle.reach) {
    return std::nullopt;
  }
  const double along = std::sqrt(obstacle.reach * obstacle.reach - across * across);
  double y = obstacle.centre.y + direction * along;
  while (length(Vec2<double>{x, y} - obstacle.centre) < obstacle.reach) {
    y = std::nextafter(y, direction * std::numeric_limits<double>::infinity());
  }
  return y;
}

// Free places on the string, nearest to the spot first, all on this side of it.
std::optional<Vec2<double>> nearest_free(const std::vector<Obstacle>& balls, double direction,
                                         const physics::Table& table, double radius) {
  const double x = table.foot_spot_x;
  std::vector<double> candidates{table.foot_spot_y};
  for (const Obstacle& ball : balls) {
    if (const auto y = place_behind(ball, x, direction)) {
      candidates.push_back(*y);
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [direction](double p, double q) { return direction > 0 ? p < q : p > q; });
  for (const double y : candidates) {
    const bool this_side = direction * (y - table.foot_spot_y) >= 0;
    const bool on_table = y >= radius && y <= table.length - radius;
    const bool free = std::all_of(balls.begin(), balls.end(), [&](const Obstacle& ball) {
      return !applies(clauses::spot_beyond_balls,
                      length(Vec2<double>{x, y} - ball.centre) < ball.reach);
    });
    if (this_side && on_table && free) {
      return Vec2<double>{x, y};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec2<double>> spot_place(const GameState& state, BallId ball,
                                       const physics::Table& table,
                                       const physics::Materials& materials) {
  const std::vector<Obstacle> balls = obstacles(state, ball, materials);
  const auto behind = nearest_free(balls, 1, table, materials.ball_radius);
  if (!applies(clauses::spot_towards_head, !behind.has_value())) {
    return behind;
  }
  return nearest_free(balls, -1, table, materials.ball_radius);
}

GameState spotted(GameState state, BallId ball, const physics::Table& table,
                  const physics::Materials& materials) {
  const std::optional<Vec2<double>> place = spot_place(state, ball, table, materials);
  const auto found = std::find_if(state.balls.begin(), state.balls.end(),
                                  [ball](const BallPlace& p) { return p.id == ball; });
  if (place) {
    *found = {ball, Whereabouts::on_table, *place, {}};
  }
  return state;
}

}  // namespace poolhall::rules
