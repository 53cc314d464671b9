// The statistics on simulated tournaments; `poolhall bench ratings` runs longer ones.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/simulated_ratings.hpp"

namespace poolhall::ratings {
namespace {

using test_support::Coverage;
using test_support::interval_coverage;
using test_support::Rack;
using test_support::sprt_errors;
using test_support::SprtErrors;

// 200 tournaments of four players: three standard errors of a share of 95 % in 800 are 2.3 %.
TEST(IntervalCoverage, HoldsForIndependentGamesAndForPairsThatShareTheirRack) {
  for (const Rack rack : {Rack::independent, Rack::favours_the_breaker}) {
    const Coverage coverage = interval_coverage(rack, 200, 100, 7);
    std::printf("covered: %.2f %% of %zu\n", 100 * coverage.share(), coverage.intervals);
    EXPECT_GT(coverage.share(), 0.927);
    EXPECT_LT(coverage.share(), 0.973);
  }
}

TEST(Sprt, ItsErrorsStayWithinAlphaAndBeta) {
  const SprtSettings settings{.elo0 = 0, .elo1 = 60, .alpha = 0.05, .beta = 0.1};
  const SprtErrors errors = sprt_errors(settings, 200, 3);
  std::printf("wrongly H1: %.3f, wrongly H0: %.3f, undecided: %zu, pairs on average: %.0f\n",
              errors.wrong_h1, errors.wrong_h0, errors.undecided, errors.mean_pairs);
  // Three standard errors of the share in 200 trials above the bound.
  EXPECT_LT(errors.wrong_h1, settings.alpha + 3 * 0.0154);
  EXPECT_LT(errors.wrong_h0, settings.beta + 3 * 0.0212);
  EXPECT_EQ(errors.undecided, 0U);
}

}  // namespace
}  // namespace poolhall::ratings
