// Why a simulated shot's events are not the reference's: because they cannot be told apart. Either
// the reference itself has two events closer than a tie, or a change of one ulp in a number of the
// scene gives the reference the order that was found.
//
//   Verdict v = verdict(shot, timed_events(run.events), truth);
#pragma once

#include "tests/bench/against_reference.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

enum class Verdict : std::uint8_t { same, tied, flips_under_an_ulp, unexplained };

[[nodiscard]] Verdict verdict(const test_support::RandomShot& shot,
                              const std::vector<TimedEvent>& found,
                              const physics::reference::ReferenceSimulation& truth);

}  // namespace poolhall::bench
