// Seeded random shots and breaks: the same for tests, benchmarks and other programs' checks.
//
//   RandomShot shot = random_shot({.seed = 7, .balls = 8, .table = table, .materials = materials});
//   physics::Scene<double> scene = scene_of(shot);
#pragma once

#include <cstdint>

#include "physics/simulator.hpp"
#include "protocol/units.hpp"

namespace poolhall::test_support {

struct RandomShot {
  physics::Table table;
  physics::Materials materials;
  physics::BallSet<double> balls;
  protocol::ShotParams shot;
};

struct RandomShotOrder {
  std::uint64_t seed = 0;
  std::size_t balls = 2;  // with the cue ball, at most 16
  physics::Table table;
  physics::Materials materials;
  double least_speed = 0.5;  // m/s, of the cue
  double most_speed = 6;
};

// Balls anywhere on the table at least 0.1 mm apart and off the rails, a cue ball struck in any
// direction up to 10 mm off centre at an elevation of up to 10 degrees, or more where the cue would
// touch something; half the shots are aimed at the middle of a ball within 5 degrees, so that
// something happens.
[[nodiscard]] RandomShot random_shot(const RandomShotOrder& order);

struct RandomBreakOrder {
  std::uint64_t seed = 0;
  double gap = 1e-4;  // m between the surfaces of neighbours in the rack
  physics::Table table;
  physics::Materials materials;
  double least_speed = 6;  // m/s, of the cue
  double most_speed = 10;
};

// A full rack, the cue ball anywhere in the kitchen, struck at the apex ball within one degree.
[[nodiscard]] RandomShot random_break(const RandomBreakOrder& order);

[[nodiscard]] physics::Scene<double> scene_of(const RandomShot& shot);

}  // namespace poolhall::test_support
