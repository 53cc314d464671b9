// A shot seen in a mirror, from the other end of the table, or with other numbers on the balls: the
// laws do not care, so that the same must come of it.
//
//   const auto image = transformed(scene, Symmetry::rotated);
//   const double off = image_distance(*simulate(scene, {}), *simulate(image, {}), scene.table,
//                                     Symmetry::rotated);
//   // off <= 1e-12 * amplification(scene, {}): coordinates round as they are transformed
#pragma once

#include "physics/simulator.hpp"

namespace poolhall::test_support {

enum class Symmetry {
  mirrored,    // x -> W - x
  rotated,     // by 180 degrees about the table's middle
  renumbered,  // other ids on the object balls, and the balls given in another order
};

[[nodiscard]] physics::Scene<double> transformed(const physics::Scene<double>& scene, Symmetry how);

// How far the image's balls lie from where the original's are seen to lie, m; infinity if one is
// pocketed in one of them only.
[[nodiscard]] double image_distance(const physics::Simulation<double>& original,
                                    const physics::Simulation<double>& image,
                                    const physics::Table& table, Symmetry how);

// By how much the shot magnifies a small displacement of its first ball, at least 1; infinity if
// other events come of it.
[[nodiscard]] double amplification(const physics::Scene<double>& scene,
                                   const physics::SimulationOptions& options);

}  // namespace poolhall::test_support
