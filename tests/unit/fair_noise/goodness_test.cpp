#include "server/match/goodness.hpp"

#include <gtest/gtest.h>

#include "server/match/fair_noise.hpp"
#include "server/match/fairness.hpp"

namespace poolhall::match {
namespace {

std::vector<physics::ShotDeviates> deviates_of(std::uint8_t first_byte, std::uint32_t shots) {
  GameKey key{};
  key[0] = first_byte;
  std::vector<physics::ShotDeviates> all;
  for (std::uint32_t shot = 1; shot <= shots; ++shot)
    all.push_back(shot_deviates(key, {protocol::GameId{1}, rules::Seat::second, shot}));
  return all;
}

double least_p(const std::vector<NoiseTest>& tests) {
  double least = 1;
  for (const NoiseTest& test : tests)
    least = std::min(least, test.p);
  return least;
}

// Smirnov's table: sqrt(n) D exceeds 1.3581 with probability 0.05, 1.6276 with 0.01.
TEST(Goodness, HasKolmogorovsDistribution) {
  EXPECT_NEAR(kolmogorov_p(1.3581 / 1000, 1'000'000), 0.05, 1e-4);
  EXPECT_NEAR(kolmogorov_p(1.6276 / 1000, 1'000'000), 0.01, 3e-5);
  EXPECT_NEAR(kolmogorov_p(0.40925, 10), 0.05, 2e-3);  // Miller's table for samples of 10
  EXPECT_EQ(kolmogorov_p(0, 10), 1);
}

// Tables of chi-square: 18.307 and 293.248 are exceeded with probability 0.05 and 0.05.
TEST(Goodness, HasTheChiSquareDistribution) {
  EXPECT_NEAR(chi_square_p(18.307, 10), 0.05, 5e-4);
  EXPECT_NEAR(chi_square_p(293.248, 255), 0.05, 2e-4);
  EXPECT_NEAR(two_sided(1.959963984540054), 0.05, 1e-12);
}

TEST(Goodness, FindsTheDeviatesOfAKeyNormalAndIndependent) {
  const auto tests = test_deviates(deviates_of(7, 20'000));
  EXPECT_EQ(tests.size(), 10U);
  EXPECT_TRUE(fit_together(tests)) << least_p(tests);
}

TEST(Goodness, FindsWrongSpreadCorrelationAndRepetition) {
  auto wide = deviates_of(7, 20'000);
  auto tied = wide;
  auto repeated = wide;
  auto restless = wide;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    wide[i][3] *= 1.1;
    tied[i][4] = 0.1 * tied[i][0] + std::sqrt(0.99) * tied[i][4];
    if (i >= 3)
      repeated[i][1] = 0.1 * repeated[i - 3][2] + std::sqrt(0.99) * repeated[i][1];
    for (double& deviate : restless[i])
      deviate *= i / 50 % 2 == 0 ? 0.8 : std::sqrt(2 - 0.64);
  }
  for (const auto& shots : {wide, tied, repeated, restless})
    EXPECT_FALSE(fit_together(test_deviates(shots)));
}

// p is uniform where all is as it should be: about 5 of 100 below 0.05.
TEST(Goodness, GivesEveryPWithItsProbability) {
  std::vector<int> below(10);
  for (std::uint8_t key = 0; key < 100; ++key) {
    const auto tests = test_deviates(deviates_of(key, 900));
    for (std::size_t i = 0; i < tests.size(); ++i)
      below[i] += tests[i].p < 0.05 ? 1 : 0;
  }
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_LE(below[i], 14) << i;  // more by chance once in 10,000
}

TEST(Correlations, HaveFishersInterval) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 30; ++i) {
    x.push_back(i % 5);
    y.push_back(i % 3 == 0 ? i % 5 : 2);
  }
  const Correlation found = correlation_of(x, y);
  ASSERT_TRUE(found.value);
  // By hand: covariance 2/3 of 2 a third of the time, deviations sqrt 2 and sqrt(2/3).
  EXPECT_NEAR(*found.value, 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(found.low, std::tanh(std::atanh(1 / std::sqrt(3.0)) - 1.959963985 / std::sqrt(27.0)),
              1e-9);
  EXPECT_FALSE(correlation_of({1, 2, 3}, {1, 2, 3}).value);
  EXPECT_FALSE(correlation_of({1, 1, 1, 1}, {1, 2, 3, 4}).value);
}

}  // namespace
}  // namespace poolhall::match
