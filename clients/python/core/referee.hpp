// The referee in Python: poolhall.GameState, and pure functions of states (rules/referee.hpp).
#pragma once

#include "clients/python/core/simulation.hpp"
#include "rules/referee.hpp"

namespace poolhall::python {

// A stroke with everything that goes with it on the wire.
struct Move {
  physics::ShotParameters<double> shot;
  rules::Call call{};
  std::optional<physics::Vec2<double>> cue_ball{};  // m
};
// (shot, call, cue_ball)
[[nodiscard]] Move read_move(py::handle argument, const std::string& field);

void bind_referee(py::module_& module);
void bind_play(py::module_& module);

}  // namespace poolhall::python
