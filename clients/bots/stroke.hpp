// A stroke that the cue can make: the lowest elevation at which the stick clears rails and balls,
// with the tip moved so that the wanted follow or draw stays.
//
//   auto stroke = clear_stroke({.phi = phi, .speed = 2.5}, balls, table, materials);
#pragma once

#include <optional>

#include "protocol/units.hpp"

namespace poolhall::bots {

// A stroke without its elevation, in SI units and radians.
struct StrokeWish {
  double phi = 0;    // rad, heading
  double speed = 0;  // m/s, of the cue
  double side = 0;   // m, offset to the left
  // m, by which the cue's line passes above the ball's centre: > 0 follow, < 0 draw, 0 stun,
  // whatever the elevation.
  double follow = 0;
};

// Nothing if the stick is in the way at any elevation. `balls` holds the cue ball in its place.
[[nodiscard]] std::optional<protocol::ShotParams> clear_stroke(
    const StrokeWish& wish, const physics::BallSet<double>& balls, const physics::Table& table,
    const physics::Materials& materials);

}  // namespace poolhall::bots
