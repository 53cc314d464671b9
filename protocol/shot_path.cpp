#include "protocol/shot_path.hpp"

#include <utility>

namespace poolhall::protocol {
namespace {

// Where a `shot` has what the referee and the simulator were given.
std::string_view place_in_request(const rules::Refusal&) {
  return "/params";
}
std::string_view place_in_request(const physics::Error&) {
  return "/params/params";
}

}  // namespace

Error request_error(const ShotRefusal& refusal) {
  return std::visit([](const auto& why) { return error_from(why, place_in_request(why)); },
                    refusal);
}

tl::expected<ReadyShot, ShotRefusal> ready_shot(
    const rules::GameState& state, const rules::Call& call,
    const std::optional<physics::Vec2<double>>& cue_ball, const ShotParams& stroke,
    const physics::Table& table, const physics::Materials& materials) {
  auto placed = rules::prepare_shot(state, call, cue_ball, table, materials);
  if (!placed) {
    return tl::unexpected(ShotRefusal{std::move(placed.error())});
  }
  const physics::BallSet<double> balls = rules::balls_on_table(*placed);
  const physics::CueShot<double> strike = to_physics(stroke);
  if (auto possible = physics::check_shot(strike, balls, table, materials); !possible) {
    return tl::unexpected(ShotRefusal{std::move(possible.error())});
  }
  return ReadyShot{*std::move(placed), call, {table, materials, balls, strike}};
}

tl::expected<PlayedShot, ShotRefusal> play_shot(const ReadyShot& ready) {
  const physics::Scene<double>& scene = ready.scene;
  auto simulation = physics::simulate(scene, {});
  if (!simulation) {
    return tl::unexpected(ShotRefusal{std::move(simulation.error())});
  }
  auto ruling =
      rules::judge(ready.state, ready.call, simulation->events, scene.table, scene.materials);
  if (!ruling) {
    return tl::unexpected(ShotRefusal{std::move(ruling.error())});
  }
  return PlayedShot{*std::move(simulation), *std::move(ruling)};
}

}  // namespace poolhall::protocol
