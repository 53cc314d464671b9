// The path of a shot, for whoever plays one: placement and call checked by the referee, the stroke
// by the simulator; then simulated and judged. What noise makes of the stroke comes between the
// two.
//
//   auto ready = ready_shot(state, call, cue_ball, stroke, table, materials);
//   if (!ready) return tl::unexpected(request_error(ready.error()));
//   const ExecutedShot executed =
//       executed_shot(stroke, noise, deviates, ready->scene.balls, table, materials);
//   ready->scene.shot = to_physics(executed.params);
//   auto played = play_shot(*ready);
#pragma once

#include <optional>
#include <variant>

#include <tl/expected.hpp>

#include "physics/simulator.hpp"
#include "protocol/errors.hpp"
#include "protocol/units.hpp"
#include "rules/referee.hpp"

namespace poolhall::protocol {

using ShotRefusal = std::variant<rules::Refusal, physics::Error>;

// As the answer to a `shot`: the field points into that line.
[[nodiscard]] Error request_error(const ShotRefusal& refusal);

// Found possible as it is asked for.
struct ReadyShot {
  rules::GameState state;  // the cue ball placed
  rules::Call call;
  physics::Scene<double> scene;  // with the stroke that was asked for
};
[[nodiscard]] tl::expected<ReadyShot, ShotRefusal> ready_shot(
    const rules::GameState& state, const rules::Call& call,
    const std::optional<physics::Vec2<double>>& cue_ball, const ShotParams& stroke,
    const physics::Table& table, const physics::Materials& materials);

struct PlayedShot {
  physics::Simulation<double> simulation;
  rules::Ruling ruling;
};
// Refuses nothing that ready_shot gave, unless the simulator met its bound on events.
[[nodiscard]] tl::expected<PlayedShot, ShotRefusal> play_shot(const ReadyShot& ready);

}  // namespace poolhall::protocol
