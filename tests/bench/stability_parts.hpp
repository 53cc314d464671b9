// The parts of `bench stability` that have files of their own.
#pragma once

#include <iosfwd>

#include "tests/bench/benchmarks.hpp"

namespace poolhall::bench {

// Velocity error of `cluster` over 100 breaks at gaps 0 and 0.1 mm, with `hertz` as the truth.
bool clusters_against_springs(const BenchOptions& options, std::ostream& out);

// Step sweeps of the stiff parts (`hertz`, `spring`, `mathavan2010`): energy drift, error and
// largest stable step, explicit against implicit.
bool stiff_steps(const BenchOptions& options, std::ostream& out);

}  // namespace poolhall::bench
