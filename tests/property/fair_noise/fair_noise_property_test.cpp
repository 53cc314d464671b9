#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "server/match/fair_noise.hpp"

namespace poolhall::match {
namespace {

GameKey pinned_key() {
  GameKey key{};
  key[0] = 42;
  return key;
}

std::vector<double> deviates(std::size_t shots) {
  std::vector<double> all;
  for (std::uint32_t shot = 1; shot <= shots; ++shot)
    for (const double deviate :
         shot_deviates(pinned_key(), {protocol::GameId{1}, rules::Seat::first, shot}))
      all.push_back(deviate);
  return all;
}

// Kolmogorov-Smirnov: sqrt(n) D exceeds 1.95 with probability 0.001.
TEST(FairNoise, is_normally_distributed) {
  std::vector<double> sample = deviates(40'000);
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = std::erfc(-sample[i] / std::sqrt(2.0)) / 2;
    largest = std::max({largest, std::abs(p - static_cast<double>(i) / n),
                        std::abs(p - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(std::sqrt(n) * largest, 1.95);
}

// The correlation of independent pairs is within 3.3 / sqrt(n) with probability 0.999.
TEST(FairNoise, does_not_tell_one_deviate_by_another) {
  const std::vector<double> sample = deviates(40'000);
  for (const std::size_t distance : {1, 2, 3, 4, 5, 10}) {
    double sum = 0;
    for (std::size_t i = 0; i + distance < sample.size(); ++i)
      sum += sample[i] * sample[i + distance];
    const auto n = static_cast<double>(sample.size() - distance);
    EXPECT_LT(std::abs(sum / n), 3.3 / std::sqrt(n)) << distance;
  }
}

}  // namespace
}  // namespace poolhall::match
