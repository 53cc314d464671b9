// Random pairs of discs, each moving along its own parabola: what a solver for the first contact
// may be asked. Seven classes, from what a shot is made of to what no shot will ever see.
//
//   DiscPair pair = random_pair(PairClass::grazing, seed, 17);   // the 18th of its class
#pragma once

#include <array>
#include <cstdint>

#include "physics/vector.hpp"

namespace poolhall::bench {

struct Disc {
  physics::Vec2<double> position;      // m, at t = 0; so is the velocity
  physics::Vec2<double> velocity;      // m/s
  physics::Vec2<double> acceleration;  // m/s^2
};

// The numbers are taken as exact: a double is what it is.
struct DiscPair {
  Disc first;
  Disc second;
  double radius = 0.028575;  // m, of both
  double horizon = 0;        // s, of interest is [0, horizon]
};

enum class PairClass : std::uint8_t {
  moving,                // both move, as in shots
  touching_receding,     // in touch, but for rounding, and moving apart
  touching_approaching,  // in touch and moving together
  grazing,               // pass within 1e-15 m of touching, on either side
  slow,                  // stop where they would just meet
  near_equal,            // motions alike to 1e-16 .. 1e-3
  extreme,               // 1e-9 .. 1e3 m/s, horizons of 1e-300 .. 1e60 s, denormal numbers
};
inline constexpr std::array<PairClass, 7> pair_classes{PairClass::moving,
                                                       PairClass::touching_receding,
                                                       PairClass::touching_approaching,
                                                       PairClass::grazing,
                                                       PairClass::slow,
                                                       PairClass::near_equal,
                                                       PairClass::extreme};

[[nodiscard]] const char* name(PairClass pair_class);

[[nodiscard]] DiscPair random_pair(PairClass pair_class, std::uint64_t seed, std::uint64_t index);

}  // namespace poolhall::bench
