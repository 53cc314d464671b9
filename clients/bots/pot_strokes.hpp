// Strokes that pot along a line: speed, follow or draw and side varied, each aimed in the
// simulator so that throw, squirt and the curve of a raised cue are taken out.
//
//   std::vector<protocol::ShotParams> strokes = pot_strokes(line, placed, grid, trial);
#pragma once

#include <span>
#include <vector>

#include "clients/bots/position.hpp"
#include "clients/bots/trial.hpp"

namespace poolhall::bots {

struct StrokeGrid {
  std::vector<double> speeds;   // times the least that brings the ball to the pocket
  std::vector<double> follows;  // of the radius, > 0 follow, < 0 draw
  std::vector<double> sides;    // of the radius, > 0 to the left
};

// A wide grid for the shot to be played, a small one for shots further on. Side is left out where
// neither cushions nor balls nor the cue's squirt care for it.
[[nodiscard]] StrokeGrid wide_grid(const physics::Materials& materials);
[[nodiscard]] StrokeGrid narrow_grid();

// The cue's speed that just brings the object ball to the pocket, m/s.
[[nodiscard]] double least_speed(const PotLine& line, const physics::Materials& materials);

// `placed` has the cue ball where the line begins. Strokes that the cue has no room for, or that
// cannot be aimed, are left out.
[[nodiscard]] std::vector<protocol::ShotParams> pot_strokes(const PotLine& line,
                                                            const Position& placed,
                                                            const StrokeGrid& grid, Trial& trial);

}  // namespace poolhall::bots
