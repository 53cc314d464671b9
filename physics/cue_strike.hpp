// The cue strikes the ball: (3)-(5) of the paper with tip restitution, and what makes a strike
// impossible.
#pragma once

#include <cstdint>

#include "physics/ball.hpp"
#include "physics/expected.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

// SI and radians. On the wire and in files a, b are mm and theta, phi degrees.
template <class Real>
struct CueShot {
  Real a{};      // m, offset of the contact point to the left as the player sees it
  Real b{};      // m, offset upwards
  Real theta{};  // rad, elevation of the cue, 0..pi/2
  Real phi{};    // rad, heading, counter-clockwise from +x
  Real speed{};  // m/s, of the cue before the strike
};

// The cue ball right after the strike, sliding, spinning or rolling. `shot` must be possible.
template <class Real>
[[nodiscard]] Ball<Real> strike(const Ball<Real>& ball, const CueShot<Real>& shot,
                                const Materials& materials);

// Why `shot` cannot be played on this table with these balls; Error.field is one of "/a", "/b",
// "/theta", "/phi", "/v" or "".
[[nodiscard]] Expected<void> check_shot(const CueShot<double>& shot, const BallSet<double>& balls,
                                        const Table& table, const Materials& materials);

// The nearest shot that can be played, for what noise made impossible (physics.md 3).
struct NearestShot {
  CueShot<double> shot;
  bool moved = false;
};
[[nodiscard]] NearestShot nearest_possible_shot(const CueShot<double>& shot,
                                                const BallSet<double>& balls, const Table& table,
                                                const Materials& materials);

}  // namespace poolhall::physics
