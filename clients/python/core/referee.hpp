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

// Why a move cannot be played, and the simulator's own word for it.
struct Refused {
  protocol::Error error;
  std::string fault;
};

// A move with the cue ball in its place, found possible without noise.
struct ReadyMove {
  rules::GameState state;
  physics::BallSet<double> balls;
  Move move;
};
[[nodiscard]] tl::expected<ReadyMove, Refused> ready_move(const rules::GameState& state,
                                                          const Move& move, const PlayTable& play);

struct PlayedMove {
  protocol::ExecutedShot executed;
  physics::Simulation<double> simulation;
  rules::Ruling ruling;
};
[[nodiscard]] tl::expected<PlayedMove, Refused> play_move(const ReadyMove& ready,
                                                          const protocol::NoiseParams& noise,
                                                          const physics::ShotDeviates& deviates,
                                                          const PlayTable& play);

void bind_referee(py::module_& module);
void bind_play(py::module_& module);

}  // namespace poolhall::python
