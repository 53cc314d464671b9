// Scene files (physics.md 10): reading what `poolhall simulate` is given, writing what it prints.
//
//   Expected<SceneFile> file = decode_scene(text);
//   physics::Expected<physics::Simulation<double>> done =
//       physics::simulate(scene_of(*file), file->options);
//   std::string out = encode_simulation(*done);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "physics/simulator.hpp"
#include "protocol/errors.hpp"
#include "protocol/units.hpp"

namespace poolhall::protocol {

enum class Precision : std::uint8_t { double_precision, long_double, float128, mp100 };
// "double", "long_double", "float128", "mp100".
[[nodiscard]] std::string_view name(Precision precision);

struct SceneFile {
  physics::Table table;
  physics::Materials materials;
  physics::BallSet<double> balls{};
  std::optional<ShotParams> shot{};  // in the wire's units, converted in the precision asked for
  physics::SimulationOptions options;
  Precision precision = Precision::double_precision;
};

// Unknown keys are errors that name the key. Checks the form; what makes a scene impossible is
// physics::check_scene's answer.
[[nodiscard]] Expected<SceneFile> decode_scene(std::string_view text);

// What the workbench asks: a scene with a shot, played `samples` times with noise.
struct EvaluationOrder {
  SceneFile scene;
  NoiseParams noise;
  std::uint32_t samples = 200;
  std::uint64_t seed = 0;
};
// {"scene": {...}, "noise": "olympiad" | {a, b, theta, phi, v}, "samples"?, "seed"?}
[[nodiscard]] Expected<EvaluationOrder> decode_evaluation(std::string_view text,
                                                          std::uint32_t most_samples);

// The scene in SI. Its numbers are the file's doubles in every precision, so that two precisions
// simulate the same scene; only the shot's directions are computed in the precision asked for.
template <class Real = double>
[[nodiscard]] physics::Scene<Real> scene_of(const SceneFile& file) {
  physics::Scene<Real> scene{file.table, file.materials, {}, {}};
  scene.balls.count = file.balls.count;
  for (std::size_t i = 0; i < file.balls.count; ++i) {
    const physics::Ball<double>& ball = file.balls[i];
    const auto& w = ball.angular_velocity;
    scene.balls[i] = {.id = ball.id,
                      .state = ball.state,
                      .position = {Real(ball.position.x), Real(ball.position.y)},
                      .velocity = {Real(ball.velocity.x), Real(ball.velocity.y)},
                      .angular_velocity = {Real(w.x), Real(w.y), Real(w.z)},
                      .pocket = ball.pocket};
  }
  if (file.shot) {
    scene.shot = physics::cue_shot(physics::ShotParameters<Real>{
        Real(file.shot->a), Real(file.shot->b), Real(file.shot->theta), Real(file.shot->phi),
        Real(file.shot->v)});
  }
  return scene;
}

// physics::check_scene's answer as an error of the file.
[[nodiscard]] Error scene_error(const physics::Error& error);

// {"events", "final", "duration", "energy", "stats"}, one line without its end.
[[nodiscard]] std::string encode_simulation(const physics::Simulation<double>& simulation);

}  // namespace poolhall::protocol
