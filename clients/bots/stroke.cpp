#include "clients/bots/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace poolhall::bots {
namespace {

constexpr double degree = std::numbers::pi / 180;
// Above the lowest clear elevation, so that noise seldom puts the stick into the rail.
constexpr double elevation_margin = 0.3 * degree;

// In the vertical plane of the cue the contact point lies at the angle beta above the horizontal
// on a circle of radius rho about the ball's centre; the cue's line passes the centre at the
// distance rho sin(beta - theta).
protocol::ShotParams stroke_at(const StrokeWish& wish, double theta, double radius) {
  const double rho = std::sqrt(std::max(radius * radius - wish.side * wish.side, 0.0));
  const double lift = rho > 0 ? std::asin(std::clamp(wish.follow / rho, -1.0, 1.0)) : 0.0;
  const double beta = std::min(theta + lift, 90 * degree);
  return {.a = 1000 * wish.side,
          .b = 1000 * rho * std::sin(beta),
          .theta = theta / degree,
          .phi = wish.phi / degree,
          .v = wish.speed};
}

double next_elevation(double theta) {
  return theta + (theta < 10 * degree ? 0.5 * degree : 2 * degree);
}

}  // namespace

std::optional<protocol::ShotParams> clear_stroke(const StrokeWish& wish,
                                                 const physics::BallSet<double>& balls,
                                                 const physics::Table& table,
                                                 const physics::Materials& materials) {
  for (double theta = 0; theta < 88 * degree; theta = next_elevation(theta)) {
    const auto stroke = stroke_at(wish, theta, materials.ball_radius);
    const auto checked = physics::check_shot(protocol::to_physics(stroke), balls, table, materials);
    if (checked) {
      const auto safer = stroke_at(wish, theta + elevation_margin, materials.ball_radius);
      return physics::check_shot(protocol::to_physics(safer), balls, table, materials) ? safer
                                                                                       : stroke;
    }
    if (checked.error().fault != physics::Fault::cue_obstructed) {
      return std::nullopt;  // a higher cue would not help
    }
  }
  return std::nullopt;
}

}  // namespace poolhall::bots
