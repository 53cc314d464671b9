#include "physics/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace poolhall::physics {
namespace {

constexpr double radian_per_degree = std::numbers::pi / 180;

// Wichura 1988, table of the paper's check values for PPND16.
TEST(NormalQuantile, GivesWichurasPublishedValues) {
  EXPECT_NEAR(normal_quantile(0.25), -0.6744897501960817, 1e-16);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167814, 1e-15);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 4e-15);
}

TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (const double z : {-8.0, -5.0, -3.0, -1.5, -1.0, -0.3, 0.0, 0.7, 2.0, 4.0}) {
    EXPECT_NEAR(normal_quantile(0.5 * std::erfc(-z / std::numbers::sqrt2)), z, 2e-11) << z;
  }
}

TEST(NormalQuantile, IsAntisymmetric) {
  for (const double p : {0x1p-20, 0x1p-4, 0.0625, 0.25, 0.375, 0.4375}) {
    EXPECT_EQ(normal_quantile(1 - p), -normal_quantile(p)) << p;
  }
  EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(UniformDeviate, StaysInsideTheOpenInterval) {
  EXPECT_EQ(uniform_deviate(0), 0x1p-54);
  EXPECT_LT(uniform_deviate(~std::uint64_t{0}), 1);
  EXPECT_TRUE(std::isfinite(normal_quantile(uniform_deviate(0))));
  EXPECT_TRUE(std::isfinite(normal_quantile(uniform_deviate(~std::uint64_t{0}))));
}

TEST(PresetNoise, OlympiadHasTheOlympiadsDeviations) {
  const NoiseLevel level = preset_noise("olympiad").value();
  EXPECT_DOUBLE_EQ(level.a, 0.0005);
  EXPECT_DOUBLE_EQ(level.b, 0.0005);
  EXPECT_DOUBLE_EQ(level.theta, 0.1 * radian_per_degree);
  EXPECT_DOUBLE_EQ(level.phi, 0.125 * radian_per_degree);
  EXPECT_DOUBLE_EQ(level.speed, 0.075);
}

TEST(PresetNoise, LowIsHalfAndHighIsFiveTimesOlympiad) {
  const NoiseLevel olympiad = preset_noise("olympiad").value();
  for (const auto& [name, factor] : {std::pair{"low", 0.5}, std::pair{"high", 5.0}}) {
    const NoiseLevel level = preset_noise(name).value();
    const NoiseLevel expected = scaled(olympiad, factor);
    EXPECT_DOUBLE_EQ(level.a, expected.a) << name;
    EXPECT_DOUBLE_EQ(level.b, expected.b) << name;
    EXPECT_DOUBLE_EQ(level.theta, expected.theta) << name;
    EXPECT_DOUBLE_EQ(level.phi, expected.phi) << name;
    EXPECT_DOUBLE_EQ(level.speed, expected.speed) << name;
  }
  EXPECT_FALSE(preset_noise("variable").has_value());
}

TEST(WithNoise, NoneLeavesTheShotToTheLastBit) {
  const CueShot<double> intended = cue_shot_from_degrees(1.1, -2.3, 7.7, 123.456, 3.21);
  const CueShot<double> executed =
      with_noise(intended, preset_noise("none").value(), {1.5, -2, 0.3, 4, -1});
  EXPECT_EQ(executed.given, intended.given);
  EXPECT_EQ(executed.heading.cosine, intended.heading.cosine);
}

TEST(WithNoise, AddsTheDeviatesInTheirUnits) {
  const CueShot<double> intended = cue_shot_from_degrees(1.0, -2.0, 10.0, 90.0, 3.0);
  const CueShot<double> executed =
      with_noise(intended, preset_noise("olympiad").value(), {1, 2, -1, -2, 3});
  EXPECT_DOUBLE_EQ(executed.given.a, 1.5);
  EXPECT_DOUBLE_EQ(executed.given.b, -1.0);
  EXPECT_DOUBLE_EQ(executed.given.theta, 9.9);
  EXPECT_DOUBLE_EQ(executed.given.phi, 89.75);
  EXPECT_DOUBLE_EQ(executed.given.v, 3.225);
  EXPECT_EQ(executed.a, executed.given.a / 1000);
}

TEST(WithNoise, IsNotLostInTurnsThatAreWhole) {
  const CueShot<double> intended = cue_shot_from_degrees(0.0, 0.0, 10.0, 4503599627370570.0, 3.0);
  const CueShot<double> executed =
      with_noise(intended, preset_noise("olympiad").value(), {1, 2, -1, -2, 3});
  EXPECT_DOUBLE_EQ(executed.given.phi, 89.75);
}

}  // namespace
}  // namespace poolhall::physics
