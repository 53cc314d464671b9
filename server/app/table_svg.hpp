// A picture of a shot: the table from above, head at the bottom, every ball's path, where it began
// and where it ended. A path between two events is a parabola, which SVG draws exactly.
//
//   std::string svg = table_svg(scene, simulation, simulation.duration);
#pragma once

#include <string>

#include "physics/simulator.hpp"

namespace poolhall::app {

// `until`, in seconds: when the simulation ended, which may be after its last event.
[[nodiscard]] std::string table_svg(const physics::Scene<double>& scene,
                                    const physics::Simulation<double>& simulation, double until);

// Width and height of that picture, px.
[[nodiscard]] physics::Vec2<double> picture_size(const physics::Table& table);

}  // namespace poolhall::app
