// What the same work costs in C++, for `python3 -m poolhall.bench`: both sides of its ratios are
// taken in one process.
#include <chrono>

#include "clients/python/core/simulation.hpp"
#include "physics/batch.hpp"

namespace poolhall::python {
namespace {

template <class Run>
double seconds_of(unsigned repeats, const Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  for (unsigned i = 0; i < repeats; ++i) {
    run();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / repeats;
}

physics::Scene<double> scene_from(const py::object& balls, const py::object& shot) {
  const PlayTable& play = table_or_default(py::none());
  return {play.table, play.materials, read_balls(balls, play.materials.ball_radius, "/balls").set,
          physics::cue_shot(read_shot(shot, "/shot"))};
}

// Of the call that poolhall.simulate makes, with a scene of its own and its result let go.
double simulate_seconds(const py::object& balls, const py::object& shot, unsigned repeats) {
  const physics::Scene<double> scene = scene_from(balls, shot);
  return seconds_of(repeats, [&] {
    if (!physics::simulate(physics::Scene<double>(scene), {})) {
      refuse("/shot", "expected a shot that can be played");
    }
  });
}

double evaluate_seconds(const py::object& balls, const py::object& shot, std::uint64_t samples,
                        unsigned threads, unsigned repeats) {
  const physics::Scene<double> scene = scene_from(balls, shot);
  const physics::NoiseLevel noise = *physics::preset_noise("olympiad");
  return seconds_of(repeats, [&] {
    if (!physics::evaluate(scene, noise, {.samples = samples, .threads = threads})) {
      refuse("/shot", "expected a shot that can be played");
    }
  });
}

}  // namespace

void bind_timing(py::module_& module) {
  module.def("_simulate_seconds", &simulate_seconds);
  module.def("_evaluate_seconds", &evaluate_seconds);
}

}  // namespace poolhall::python
