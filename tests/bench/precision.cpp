// poolhall bench precision: its parts one after another.
#include <algorithm>
#include <cmath>

#include "tests/bench/precision_parts.hpp"

namespace poolhall::bench {

std::size_t scaled_count(std::size_t full, const BenchOptions& options) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::llround(static_cast<double>(full) * options.share)));
}

bool bench_precision(const BenchOptions& options, std::ostream& out) {
  const auto wanted = [&](const char* part) {
    return options.part.empty() || options.part == part;
  };
  bool held = true;
  if (wanted("accuracy")) {
    held = accuracy(options, out) && held;
  }
  if (wanted("solvers")) {
    held = solvers_on_pairs(options, out) && held;
  }
  if (wanted("methods")) {
    work_precision(options, out);
  }
  if (wanted("growth")) {
    error_growth(options, out);
  }
  if (wanted("operations")) {
    operation_counts(options, out);
  }
  return held;
}

}  // namespace poolhall::bench
