// Runs a scene file in the precision that it asks for.
//
//   physics::Expected<SceneRun> run = run_scene(file);
//   std::cout << run->text << '\n';
#pragma once

#include <string>

#include "physics/simulator.hpp"
#include "protocol/scene_json.hpp"
#include "protocol/simulation_text.hpp"

namespace poolhall::app {

struct SceneRun {
  std::string text;                     // the result as JSON, every number with all its digits
  physics::Simulation<double> rounded;  // the same, for pictures
};

[[nodiscard]] physics::Expected<SceneRun> run_scene(const protocol::SceneFile& file);

// The precisions that need more than the machine's own number types.
[[nodiscard]] physics::Expected<SceneRun> run_scene_wide(const protocol::SceneFile& file);

template <class Real>
[[nodiscard]] physics::Ball<double> rounded(const physics::Ball<Real>& ball) {
  const auto number = [](const Real& value) { return static_cast<double>(value); };
  const auto& w = ball.angular_velocity;
  return {.id = ball.id,
          .state = ball.state,
          .position = {number(ball.position.x), number(ball.position.y)},
          .velocity = {number(ball.velocity.x), number(ball.velocity.y)},
          .angular_velocity = {number(w.x), number(w.y), number(w.z)},
          .pocket = ball.pocket};
}

template <class Real>
[[nodiscard]] physics::Simulation<double> rounded(const physics::Simulation<Real>& from) {
  physics::Simulation<double> to;
  to.ending = from.ending;
  to.duration = static_cast<double>(from.duration);
  to.balls.count = from.balls.count;
  for (std::size_t i = 0; i < from.balls.count; ++i) {
    to.balls[i] = rounded(from.balls[i]);
  }
  for (const physics::Event<Real>& event : from.events) {
    physics::Event<double>& copy = to.events.emplace_back();
    copy.t = static_cast<double>(event.t);
    copy.type = event.type;
    copy.ball_count = event.ball_count;
    copy.rail = event.rail;
    copy.pocket = event.pocket;
    copy.count = event.count;
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      copy.after[i] = rounded(event.after[i]);
    }
  }
  return to;
}

template <class Real>
[[nodiscard]] physics::Expected<SceneRun> run_scene_in(const protocol::SceneFile& file) {
  const auto simulated = physics::simulate(protocol::scene_of<Real>(file), file.options);
  if (!simulated) {
    return tl::unexpected(simulated.error());
  }
  return SceneRun{protocol::simulation_text(*simulated), rounded(*simulated)};
}

}  // namespace poolhall::app
