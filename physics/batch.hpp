// What becomes of a shot under noise: the same shot many times, each with deviates of its own.
//
//   auto outcomes = evaluate(scene, *preset_noise("olympiad"), {.samples = 1000, .threads = 4});
//   outcomes->pocketed[3].total();   // how often the 3 went down
//
// Bit-identical for any number of threads: sample i draws its deviates from its own number, and
// sums are taken over blocks of fixed size in a fixed order.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "physics/noise.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {

struct EvaluationOptions {
  std::uint64_t samples = 1000;
  unsigned threads = 1;
  std::uint64_t seed = 0;
  SimulationOptions simulation{};
  // Asked now and then, by any of the threads; after true Outcomes::samples says how many were
  // played.
  std::function<bool()> stop{};
};

struct PocketCounts {
  std::array<std::uint64_t, pocket_count> in{};  // by PocketId

  [[nodiscard]] std::uint64_t total() const;
  friend bool operator==(const PocketCounts&, const PocketCounts&) = default;
};

// Where a ball comes to rest when it stays on the table.
struct RestingPlace {
  std::uint64_t count = 0;
  Vec2<double> sum{};      // m
  Vec2<double> squares{};  // m^2, sum of squared offsets from where the ball began

  [[nodiscard]] Vec2<double> mean() const;
  friend bool operator==(const RestingPlace&, const RestingPlace&) = default;
};

struct Outcomes {
  std::uint64_t samples = 0;
  std::uint64_t moved = 0;       // noise made the shot impossible: the nearest one was played
  std::uint64_t unfinished = 0;  // t_max or the event limit was met
  std::uint64_t no_contact = 0;  // the cue ball touched nothing
  std::array<std::uint64_t, max_balls> first_contact{};  // by ball number
  std::array<PocketCounts, max_balls> pocketed{};        // by ball number
  std::array<RestingPlace, max_balls> resting{};         // by ball number

  friend bool operator==(const Outcomes&, const Outcomes&) = default;
};

// `scene` must have a shot that can be played.
[[nodiscard]] Expected<Outcomes> evaluate(const Scene<double>& scene, const NoiseLevel& noise,
                                          const EvaluationOptions& options);

}  // namespace poolhall::physics
