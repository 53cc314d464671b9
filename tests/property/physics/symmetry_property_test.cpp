// The laws know no left, no head and no numbers: a shot's image under a symmetry of the table comes
// out as the image of the shot.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_shots.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/symmetry.hpp"

namespace poolhall::test_support {
namespace {

using namespace physics;

struct Given {
  Scene<double> scene;
  SimulationOptions options;
};

// Any table and material, any number of balls, or the first moments of a break: later its
// amplification is beyond what doubles hold.
Given given(std::uint32_t seed) {
  const auto table = *preset_table(seed % 2 == 0 ? "olympiad" : "wpa9");
  const auto materials = *preset_materials(seed / 2 % 2 == 0 ? "olympiad" : "modern");
  if (seed / 4 % 3 == 0) {
    const double gaps[] = {0, 1e-12, 1e-6, 1e-4};
    return {
        scene_of(random_break(
            {.seed = seed, .gap = gaps[seed / 16 % 4], .table = table, .materials = materials})),
        {.t_max = 0.4}};
  }
  return {scene_of(random_shot(
              {.seed = seed, .balls = 2 + seed % 15, .table = table, .materials = materials})),
          {}};
}

void hold_symmetry(std::uint32_t seed, Symmetry how) {
  const auto [scene, options] = given(seed);
  const double growth = amplification(scene, options);
  RC_PRE(growth < 1e9);
  const auto original = simulate(scene, options);
  const auto image = simulate(transformed(scene, how), options);
  RC_ASSERT(original.has_value() && image.has_value());
  RC_ASSERT(original->events.size() == image->events.size());
  // Issue 3 allows 1e-12.
  RC_ASSERT(image_distance(*original, *image, scene.table, how) < 1e-13 * growth);
}

RC_GTEST_PROP(Symmetry, AMirroredSceneGivesTheMirroredShot, (std::uint32_t seed)) {
  hold_symmetry(seed, Symmetry::mirrored);
}

RC_GTEST_PROP(Symmetry, ASceneRotatedBy180DegreesGivesTheRotatedShot, (std::uint32_t seed)) {
  hold_symmetry(seed, Symmetry::rotated);
}

RC_GTEST_PROP(Symmetry, OtherNumbersOnTheBallsGiveTheSameShot, (std::uint32_t seed)) {
  hold_symmetry(seed, Symmetry::renumbered);
}

}  // namespace
}  // namespace poolhall::test_support
