#include "rules/ball_path.hpp"

#include <algorithm>
#include <cmath>

namespace poolhall::rules {
namespace {

using physics::Ball;
using physics::MotionState;
using physics::Vec2;

Vec2<double> scaled_to(const Vec2<double>& direction, double length) {
  const double size = std::sqrt(dot(direction, direction));
  return size > 0 ? (length / size) * direction : Vec2<double>{};
}

// Leckie & Greenspan (8) and (11): a = -mu_s g u0/|u0| sliding, with the contact point's slip u
// of (6), a = -mu_r g v0/|v0| rolling.
Vec2<double> acceleration(const Ball<double>& ball, const physics::Materials& materials) {
  if (ball.state == MotionState::sliding) {
    const Vec2<double> slip{ball.velocity.x - materials.ball_radius * ball.angular_velocity.y,
                            ball.velocity.y + materials.ball_radius * ball.angular_velocity.x};
    return scaled_to(slip, -materials.mu_slide * materials.gravity);
  }
  if (ball.state == MotionState::rolling) {
    return scaled_to(ball.velocity, -materials.mu_roll * materials.gravity);
  }
  return {};
}

}  // namespace

bool has_place(const Ball<double>& ball) {
  return !(ball.position == Vec2<double>{});
}

PathPiece piece_from(const Ball<double>& ball, const physics::Materials& materials,
                     double duration) {
  return {ball.position, ball.velocity, acceleration(ball, materials), duration};
}

std::vector<PathPiece> ball_path(physics::BallId ball, const physics::EventLog<double>& events,
                                 const physics::Materials& materials) {
  std::vector<PathPiece> path;
  double began = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const physics::Event<double>& event = events[i];
    if (!event.involves(ball)) {
      continue;
    }
    if (!path.empty() && path.back().to == events.size()) {
      path.back().duration = std::max(0.0, event.t - began);
      path.back().to = i;
    }
    const Ball<double>& after = event.after[event.after[0].id == ball ? 0 : 1];
    if (!has_place(after)) {
      continue;
    }
    path.push_back(piece_from(after, materials, 0));
    path.back().from = i;
    path.back().to = events.size();
    began = event.until.value_or(event.t);
  }
  return path;
}

double largest(const PathPiece& piece, const Vec2<double>& direction) {
  const double start = dot(direction, piece.position);
  const double speed = dot(direction, piece.velocity);
  const double bend = dot(direction, piece.acceleration);
  const auto at = [&](double t) { return start + (speed + 0.5 * bend * t) * t; };
  double result = std::max(start, at(piece.duration));
  if (bend < 0 && speed > 0 && speed < -bend * piece.duration) {
    result = std::max(result, at(-speed / bend));
  }
  return result;
}

Vec2<double> position_at(const PathPiece& piece, double t) {
  return piece.position + t * piece.velocity + (0.5 * t * t) * piece.acceleration;
}

}  // namespace poolhall::rules
