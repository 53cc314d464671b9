// The cue stick as a solid: a cylinder about its axis from the tip backwards, and whether it has
// room among the balls and over the rails.
//
//   if (auto obstacle = obstacle_of(cue_stick(shot, cue_ball, radius), balls, table, materials))
#pragma once

#include <optional>
#include <string>

#include "physics/ball.hpp"
#include "physics/cue_strike.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

inline constexpr double cue_stick_radius = 0.0065;  // m
inline constexpr double cue_stick_length = 1.45;    // m

// What is nearer than this to touching is touching, and touching is allowed, m.
inline constexpr double touching_tolerance = 1e-12;

struct CueStick {
  Vec3<double> tip;        // m, the contact point on the cue ball
  Vec3<double> backwards;  // unit vector
};

[[nodiscard]] CueStick cue_stick(const CueShot<double>& shot, const Vec2<double>& ball,
                                 double ball_radius);

// What the stick would pass through, in words ("ball 7", "the head rail"); nothing if it is clear.
// The cue ball itself is no obstacle.
[[nodiscard]] std::optional<std::string> obstacle_of(const CueStick& stick,
                                                     const BallSet<double>& balls,
                                                     const Table& table,
                                                     const Materials& materials);

}  // namespace poolhall::physics
