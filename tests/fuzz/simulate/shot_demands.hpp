// What must be true of every simulated shot.
#pragma once

#include "physics/simulator.hpp"

namespace poolhall::fuzz {

// Finite numbers, times in order, balls inside and apart, no energy out of nothing.
void demand_sound(const physics::Scene<double>& scene, const physics::Simulation<double>& result);

}  // namespace poolhall::fuzz
