// Whether deviates look like what they should be: standard normal and independent of each other.
//
//   std::vector<physics::ShotDeviates> shots = ...;      // in the order in which they were drawn
//   for (const NoiseTest& test : test_deviates(shots)) print(test.name, test.statistic, test.p);
//   bool fits = fit_together(tests);
//
// p is the probability of a statistic at least as far out if the deviates are as they should be.
#pragma once

#include <string>
#include <vector>

#include "physics/noise.hpp"

namespace poolhall::match {

struct NoiseTest {
  std::string name;
  std::size_t count = 0;  // values that went in
  double statistic = 0;
  double p = 1;
};

// Kolmogorov-Smirnov for each parameter and all together; chi-square of neighbours; correlations
// within a shot, from shot to shot, and of the squares. Tests that need more shots are left out.
[[nodiscard]] std::vector<NoiseTest> test_deviates(const std::vector<physics::ShotDeviates>& shots);

// The least p, corrected for the number of tests (Bonferroni), is not below 0.001: by chance one
// family of tests in a thousand fails.
[[nodiscard]] bool fit_together(const std::vector<NoiseTest>& tests);

// Probability that a standard normal deviate is farther from zero than z.
[[nodiscard]] double two_sided(double z);
// Kolmogorov's distribution: of sqrt(n) D or more, for a sample of n from a known distribution.
[[nodiscard]] double kolmogorov_p(double d, std::size_t n);
// Of at least this chi-square with so many degrees of freedom (10 or more).
[[nodiscard]] double chi_square_p(double chi_square, double degrees);

// Of two series of the same length; 0 where one of them is constant.
[[nodiscard]] double correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace poolhall::match
