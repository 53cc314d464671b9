// The bodies of simulate and check_scene for any number type. The library holds them for double
// and long double; tests and tools that need other types include this header.
#pragma once

#include "physics/adaptive_loop.hpp"
#include "physics/scene_check.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {

template <class Real>
Expected<Simulation<Real>> simulate(const Scene<Real>& scene, const SimulationOptions& options) {
  if (auto fine = check_scene(scene); !fine) {
    return tl::unexpected(fine.error());
  }
  if (options.t_max && !(*options.t_max >= 0 && *options.t_max <= 1e9)) {
    return check::refuse(Fault::out_of_range, "/t_max",
                         "expected 0 to 1e9 seconds, got " + decimal(*options.t_max));
  }
  AdaptiveLoop<Real> loop(scene.table, scene.materials);
  Recorder<Real> recorder;
  Simulation<Real> result;
  result.ending = loop.run(scene.balls, scene.shot, options, recorder);
  result.events = recorder.take();
  result.balls = loop.balls();
  result.duration = loop.duration();
  result.energy = loop.energy();
  return result;
}

}  // namespace poolhall::physics
