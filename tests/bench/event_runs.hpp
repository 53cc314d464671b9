// A random shot played by the event method in any number type, with its log, and the same scene as
// the reference wants it.
//
//   const auto run = played<double, physics::AdaptiveLoop<double>>(shot,
//   physics::RootSolver::bracketed); const auto truth = reference_simulate(reference_scene(shot),
//   {});
#pragma once

#include "physics/adaptive_loop.hpp"
#include "physics/reference/reference_simulator.hpp"
#include "physics/watch.hpp"
#include "protocol/scene_json.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

template <class Real>
[[nodiscard]] physics::Scene<Real> scene_in(const test_support::RandomShot& shot) {
  protocol::SceneFile file;
  file.table = shot.table;
  file.materials = shot.materials;
  file.balls = shot.balls;
  file.shot = shot.shot;
  return protocol::scene_of<Real>(file);
}

// Contacts one after another, as in the reference; rounding cannot end a shot of float's, so that
// is stopped after as many events as no real shot has.
[[nodiscard]] inline physics::SimulationOptions sequential_with(physics::RootSolver solver) {
  physics::SimulationOptions options;
  options.contact = physics::ContactModel::sequential;
  options.solver = solver;
  options.event_limit = 20'000;
  return options;
}

template <class Real, class Loop>
[[nodiscard]] physics::Simulation<Real> played(const test_support::RandomShot& shot,
                                               physics::RootSolver solver) {
  const physics::Scene<Real> scene = scene_in<Real>(shot);
  Loop loop(scene.table, scene.materials);
  physics::Recorder<Real> recorder;
  physics::Simulation<Real> run;
  run.ending = loop.run(scene.balls, scene.shot, sequential_with(solver), recorder);
  run.events = recorder.take();
  run.balls = loop.balls();
  return run;
}

[[nodiscard]] inline physics::reference::ReferenceScene reference_scene(
    const test_support::RandomShot& shot) {
  return {shot.table, shot.materials, shot.balls,
          physics::reference::ReferenceShot{shot.shot.a, shot.shot.b, shot.shot.theta,
                                            shot.shot.phi, shot.shot.v}};
}

}  // namespace poolhall::bench
