// The parts of `poolhall bench precision`. Each prints its tables, writes them as CSV and its plots
// as SVG, and those that check something return whether it held.
#pragma once

#include <iosfwd>

#include "tests/bench/benchmarks.hpp"

namespace poolhall::bench {

// Misses and false hits of every solver on random pairs.
bool solvers_on_pairs(const BenchOptions& options, std::ostream& out);

// Random shots and breaks against 100 digits, every difference in the sequence explained.
bool accuracy(const BenchOptions& options, std::ostream& out);

// Every method on the same scenes: error against run time.
void work_precision(const BenchOptions& options, std::ostream& out);

// How an error grows event by event, and where it has grown so far that double no longer knows the
// shot.
void error_growth(const BenchOptions& options, std::ostream& out);

// The paper's count of operations, beside counted ones.
void operation_counts(const BenchOptions& options, std::ostream& out);

}  // namespace poolhall::bench
