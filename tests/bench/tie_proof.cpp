#include "tests/bench/tie_proof.hpp"

#include <cmath>
#include <limits>

#include "physics/samples.hpp"
#include "tests/bench/event_runs.hpp"

namespace poolhall::bench {

namespace {

using test_support::RandomShot;

// The numbers of a scene that a shot depends on.
std::vector<double*> numbers_of(RandomShot& shot) {
  std::vector<double*> all{&shot.shot.v, &shot.shot.phi, &shot.shot.theta, &shot.shot.a,
                           &shot.shot.b};
  for (auto& ball : shot.balls) {
    all.push_back(&ball.position.x);
    all.push_back(&ball.position.y);
  }
  return all;
}

double next_to(double x, bool up) {
  const double limit = std::numeric_limits<double>::infinity();
  return std::nextafter(x, up ? limit : -limit);
}

// The scene with its `i`th number changed by an ulp up or down, or, after the last number, with all
// of them changed, each up or down at random.
constexpr std::size_t random_changes = 32;
RandomShot changed_by_an_ulp(const RandomShot& shot, std::size_t i) {
  RandomShot near = shot;
  const std::vector<double*> numbers = numbers_of(near);
  if (i < 2 * numbers.size()) {
    *numbers[i / 2] = next_to(*numbers[i / 2], i % 2 == 0);
    return near;
  }
  const std::uint64_t bits = physics::random_words(1, i, 0).first;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    *numbers[k] = next_to(*numbers[k], (bits >> k & 1) != 0);
  }
  return near;
}

}  // namespace

Verdict verdict(const RandomShot& shot, const std::vector<TimedEvent>& found,
                const physics::reference::ReferenceSimulation& truth) {
  const Sequence here = compare_sequences(found, timed_events(truth.events));
  if (here.has_ties_in_another_order) {
    return Verdict::tied;
  }
  if (here.same) {
    return Verdict::same;
  }
  const std::size_t changes = 2 * (5 + 2 * shot.balls.count) + random_changes;
  for (std::size_t i = 0; i < changes; ++i) {
    const auto near = reference_simulate(reference_scene(changed_by_an_ulp(shot, i)), {});
    const Sequence there = compare_sequences(found, timed_events(near.events));
    // It goes along with what was found beyond where the scene itself parted from it.
    if (there.same || there.time_errors.size() > here.time_errors.size()) {
      return Verdict::flips_under_an_ulp;
    }
  }
  return Verdict::unexplained;
}

}  // namespace poolhall::bench
