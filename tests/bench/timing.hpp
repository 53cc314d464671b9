// The time of something short: the least of some runs, for what the machine does beside is not its.
// The processor's time of something long, which another program does not lengthen.
//
//   double us = least_microseconds(5, [&] { shoot(); });
//   double us = processor_microseconds([&] { step_for_a_second(); });
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace poolhall::bench {

template <class Run>
[[nodiscard]] double least_microseconds(int runs, const Run& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count());
  }
  return least;
}

// Right to a microsecond or so; what takes less than a few milliseconds runs three times.
template <class Run>
[[nodiscard]] double processor_microseconds(const Run& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t begin = std::clock();
    run();
    const double took = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    least = std::min(least, took);
    if (took > 5000) {
      break;
    }
  }
  return least;
}

}  // namespace poolhall::bench
