// The time of something short: the least of some runs, for what the machine does beside is not its.
//
//   double us = least_microseconds(5, [&] { shoot(); });
#pragma once

#include <algorithm>
#include <chrono>
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

}  // namespace poolhall::bench
