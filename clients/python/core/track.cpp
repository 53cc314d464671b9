// Any instant of a shot from its event log (physics/README.md, "The event log").
#include <algorithm>
#include <limits>

#include "clients/python/core/simulation.hpp"

namespace poolhall::python {
namespace {

using physics::Ball;
using physics::Vec2;

// Cubic Hermite interpolation from p with slope dp to q with slope dq; 0 <= s <= 1.
double hermite(double s, double p, double dp, double q, double dq) {
  const double r = 1 - s;
  return r * r * (1 + 2 * s) * p + r * r * s * dp + s * s * (3 - 2 * s) * q - s * s * r * dq;
}

Ball<double> during_hops(const TrackPiece& piece, double t) {
  const double whole = piece.end - piece.start;
  const double s = whole > 0 ? (t - piece.start) / whole : 1;
  const auto& from = piece.motion;
  const Ball<double>& to = piece.to;
  Ball<double> ball = to;
  ball.id = piece.id;
  ball.position = {
      hermite(s, from.position.x, whole * from.velocity.x, to.position.x, whole * to.velocity.x),
      hermite(s, from.position.y, whole * from.velocity.y, to.position.y, whole * to.velocity.y)};
  ball.velocity = from.velocity + s * (to.velocity - from.velocity);
  const auto& w = from.angular_velocity;
  ball.angular_velocity = {w.x + s * (to.angular_velocity.x - w.x),
                           w.y + s * (to.angular_velocity.y - w.y),
                           w.z + s * (to.angular_velocity.z - w.z)};
  ball.state = from.state;
  return ball;
}

Ball<double> ball_in(const TrackPiece& piece, double t,
                     const physics::Coefficients<double>& coefficients) {
  if (piece.is_hops) {
    return during_hops(piece, t);
  }
  Ball<double> ball =
      physics::ball_at(piece.motion, piece.id, std::max(0.0, t - piece.start), coefficients);
  if (piece.motion.state == physics::MotionState::pocketed) {
    ball = piece.to;
  }
  return ball;
}

TrackPiece piece_of(const Ball<double>& ball, double start,
                    const physics::Coefficients<double>& coefficients) {
  TrackPiece piece;
  piece.start = start;
  piece.motion = physics::segment(ball, physics::Instant<double>{}, coefficients);
  piece.id = ball.id;
  piece.to = ball;
  return piece;
}

const TrackPiece& piece_at(const Track& track, double t) {
  const auto after =
      std::upper_bound(track.begin() + 1, track.end(), t,
                       [](double value, const TrackPiece& piece) { return value < piece.start; });
  return *(after - 1);
}

void take(Track& track, const physics::Event<double>& event, const Ball<double>& after,
          const physics::Coefficients<double>& coefficients) {
  const double until = event.until.value_or(event.t);
  if (until > event.t) {
    const Ball<double> before = ball_in(track.back(), event.t, coefficients);
    TrackPiece hops = piece_of(before, event.t, coefficients);
    hops.is_hops = true;
    hops.end = until;
    hops.to = after;
    track.push_back(hops);
  }
  track.push_back(piece_of(after, until, coefficients));
}

}  // namespace

const std::vector<Track>& SimulationResult::tracks() const {
  if (!tracks_.empty()) {
    return tracks_;
  }
  const auto coefficients = physics::coefficients<double>(table_or_default(scene_.table).materials);
  std::array<std::size_t, physics::max_balls> index{};
  for (std::size_t i = 0; i < scene_.balls.set.count; ++i) {
    const Ball<double>& ball = scene_.balls.set[i];
    index[physics::number(ball.id)] = i;
    tracks_.push_back({piece_of(ball, 0, coefficients)});
  }
  for (const physics::Event<double>& event : done_.events) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      take(tracks_[index[physics::number(event.after[i].id)]], event, event.after[i], coefficients);
    }
  }
  return tracks_;
}

double SimulationResult::end() const {
  return done_.ending == physics::Ending::t_max ? scene_.options.t_max.value_or(done_.duration)
                                                : done_.duration;
}

std::vector<Ball<double>> SimulationResult::balls_at(double t) const {
  const auto coefficients = physics::coefficients<double>(table_or_default(scene_.table).materials);
  const double when = std::min(t, end());
  std::vector<Ball<double>> balls;
  for (const Track& track : tracks()) {
    balls.push_back(ball_in(piece_at(track, when), when, coefficients));
  }
  return balls;
}

}  // namespace poolhall::python
