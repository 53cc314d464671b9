// Simulated tournaments with known strengths, to see how often intervals hold the truth and how
// often a sequential test is wrong.
//
//   Coverage coverage = interval_coverage(Rack::independent, 2000, 100, 7);
//   coverage.share();   // about 0.95
#pragma once

#include <cstddef>
#include <cstdint>

#include "server/ratings/sprt.hpp"

namespace poolhall::test_support {

// What the two games of a pair have in common.
enum class Rack : std::uint8_t {
  independent,          // nothing
  favours_the_breaker,  // a rack is good or bad for the break by 150 Elo, in both games
};

struct Coverage {
  std::size_t covered = 0;
  std::size_t intervals = 0;

  [[nodiscard]] double share() const {
    return static_cast<double>(covered) / static_cast<double>(intervals);
  }
};

// Four players, everybody against everybody, `games` a pair (even), with an advantage of the break
// of 60 Elo.
[[nodiscard]] Coverage interval_coverage(Rack rack, std::size_t tournaments, std::size_t games,
                                         std::uint64_t seed);

struct SprtErrors {
  double wrong_h1 = 0;  // share of trials under H0
  double wrong_h0 = 0;  // share of trials under H1
  std::size_t undecided = 0;
  double mean_pairs = 0;
};

// `trials` with the true difference at each of the two hypotheses.
[[nodiscard]] SprtErrors sprt_errors(const ratings::SprtSettings& settings, std::size_t trials,
                                     std::uint64_t seed);

}  // namespace poolhall::test_support
