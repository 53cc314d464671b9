// Where a ball is spotted.
//
//   std::optional<Vec2<double>> place = spot_place(state, ball, table, materials);
#pragma once

#include <optional>

#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "rules/game_state.hpp"

namespace poolhall::rules {

// Gap that a spotted ball keeps from the cue ball, m: never touching it, and not frozen to it.
inline constexpr double cue_ball_clearance = 1e-5;

// On the long string from the foot spot towards the foot rail, as near the spot as the balls on
// the table leave room, touching object balls but never the cue ball; towards the head rail when
// there is no room behind the spot. Nothing if the whole string is full.
[[nodiscard]] std::optional<physics::Vec2<double>> spot_place(const GameState& state, BallId ball,
                                                              const physics::Table& table,
                                                              const physics::Materials& materials);

// The state with `ball` spotted. On a table too short for that, which check_settings refuses, the
// ball stays down.
[[nodiscard]] GameState spotted(GameState state, BallId ball, const physics::Table& table,
                                const physics::Materials& materials);

}  // namespace poolhall::rules
