// The way of one ball through a shot's event log, piece by piece, by the motion laws between two
// events (physics.md 2). For what a ruling must know between events: how far a ball came.
//
//   std::vector<PathPiece> path = ball_path(cue_ball, events, materials);
//   double farthest = largest(path[0], {0, 1});  // its largest y
#pragma once

#include <cstddef>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"

namespace poolhall::rules {

// Whether the log says where the ball is. A summary does not: its places are all zero, where no
// ball can lie.
[[nodiscard]] bool has_place(const physics::Ball<double>& ball);

// r(t) = position + velocity t + acceleration t^2 / 2 for t in [0, duration]; SI.
struct PathPiece {
  physics::Vec2<double> position{};
  physics::Vec2<double> velocity{};
  physics::Vec2<double> acceleration{};
  double duration = 0;
  std::size_t from = 0;  // index of the event that begins the piece
  std::size_t to = 0;    // index of the event that ends it; the log's size when none does
};

// Events that say no place begin no piece.
[[nodiscard]] std::vector<PathPiece> ball_path(physics::BallId ball,
                                               const physics::EventLog<double>& events,
                                               const physics::Materials& materials);

// The piece that begins with `ball` and lasts `duration` seconds.
[[nodiscard]] PathPiece piece_from(const physics::Ball<double>& ball,
                                   const physics::Materials& materials, double duration);

// Largest value of r(t) . direction on the piece.
[[nodiscard]] double largest(const PathPiece& piece, const physics::Vec2<double>& direction);

// Where the ball is `t` seconds into the piece.
[[nodiscard]] physics::Vec2<double> position_at(const PathPiece& piece, double t);

}  // namespace poolhall::rules
