// The core is a template: the same scene in other number types.
#include <gtest/gtest.h>

// A run in float rounds each number of a scene, all given as doubles: that is what it is for.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "physics/simulator_impl.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::physics {
namespace {

using Fifty = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                            boost::multiprecision::et_off>;

template <class Real>
Scene<Real> in_precision(const Scene<double>& scene) {
  Scene<Real> out;
  out.table = scene.table;
  out.materials = scene.materials;
  out.balls.count = scene.balls.count;
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    out.balls[i].id = scene.balls[i].id;
    out.balls[i].position = {Real(scene.balls[i].position.x), Real(scene.balls[i].position.y)};
  }
  const auto& given = scene.shot->given;
  out.shot = cue_shot_from_degrees(Real(given.a), Real(given.b), Real(given.theta), Real(given.phi),
                                   Real(given.v));
  return out;
}

template <class Real>
double distance(const Simulation<Real>& p, const Simulation<Fifty>& q) {
  double most = 0;
  for (std::size_t i = 0; i < p.balls.count; ++i) {
    most = std::max(
        {most, std::abs(static_cast<double>(Fifty(p.balls[i].position.x) - q.balls[i].position.x)),
         std::abs(static_cast<double>(Fifty(p.balls[i].position.y) - q.balls[i].position.y))});
  }
  return most;
}

TEST(Precision, DoubleGivesTheEventsAndPlacesOfFiftyDigits) {
  std::vector<double> errors;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto scene = test_support::scene_of(
        test_support::random_shot({.seed = seed,
                                   .balls = 2 + seed % 15,
                                   .table = *preset_table("olympiad"),
                                   .materials = *preset_materials("olympiad")}));
    const auto found = simulate(scene, {});
    const auto exact = simulate(in_precision<Fifty>(scene), {});
    ASSERT_TRUE(found && exact) << seed;
    ASSERT_EQ(found->events.size(), exact->events.size()) << seed;
    for (std::size_t i = 0; i < found->events.size(); ++i) {
      ASSERT_EQ(found->events[i].type, exact->events[i].type) << seed;
      ASSERT_EQ(found->events[i].after[0].id, exact->events[i].after[0].id) << seed;
    }
    errors.push_back(distance(*found, *exact));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 1e-15);
  EXPECT_LT(errors.back(), 1e-11);
}

TEST(Precision, FloatRunsToo) {
  const auto scene = test_support::scene_of(
      test_support::random_shot({.seed = 4,
                                 .balls = 2,
                                 .table = *preset_table("olympiad"),
                                 .materials = *preset_materials("olympiad")}));
  const auto rough = simulate(in_precision<float>(scene), {});
  const auto exact = simulate(in_precision<Fifty>(scene), {});
  ASSERT_TRUE(rough && exact);
  EXPECT_LT(distance(*rough, *exact), 1e-3);
}

}  // namespace
}  // namespace poolhall::physics
