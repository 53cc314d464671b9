// Pool by an adaptive integrator with event location: Dormand-Prince 5(4) with dense output
// (Boost.Odeint), the balls' equations of motion as one system, an event where one of the watched
// gaps falls through zero within a step, found by bisection of the dense output. The collision
// models are the core's own. Tables with mouth lines or without pockets.
//
//   SteppedShot run = integrate_adaptively(scene, 1e-9);
#pragma once

#include "tests/bench/time_stepping.hpp"

namespace poolhall::bench {

// `tolerance`: absolute and relative, of the integrator and (in s) of the event location. Steps are
// at most 10 ms long.
[[nodiscard]] SteppedShot integrate_adaptively(const physics::Scene<double>& scene,
                                               double tolerance, double longest = 60);

}  // namespace poolhall::bench
