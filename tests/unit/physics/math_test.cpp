#include "physics/math.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace poolhall::physics {
namespace {

namespace mp = boost::multiprecision;
using Digits60 = mp::number<mp::cpp_bin_float<60>, mp::et_off>;

// Distance of `value` from the exact result in units of the exact result's last place.
double ulps(double value, const Digits60& exact) {
  const double rounded = static_cast<double>(exact);
  const double next = std::nextafter(std::abs(rounded), std::numeric_limits<double>::infinity());
  const Digits60 last_place = Digits60(next) - Digits60(std::abs(rounded));
  return static_cast<double>(abs(Digits60(value) - exact) / last_place);
}

Digits60 radians(double degrees) {
  return Digits60(degrees) * boost::math::constants::pi<Digits60>() / 180;
}

TEST(DirectionOfDegrees, IsWithinOneUlpOfSineAndCosine) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-720, 720);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double degrees = i % 2 == 0 ? angle(random) : std::ldexp(angle(random), -i % 40);
    const Direction<double> d = direction_of_degrees(degrees);
    worst = std::max(
        {worst, ulps(d.cosine, cos(radians(degrees))), ulps(d.sine, sin(radians(degrees)))});
  }
  EXPECT_LT(worst, 1.0);
}

TEST(DirectionOfDegrees, IsExactAtMultiplesOfNinety) {
  for (int turns = -3; turns <= 3; ++turns) {
    const double start = 360.0 * turns;
    EXPECT_EQ(direction_of_degrees(start).cosine, 1);
    EXPECT_EQ(direction_of_degrees(start).sine, 0);
    EXPECT_EQ(direction_of_degrees(start + 90).cosine, 0);
    EXPECT_EQ(direction_of_degrees(start + 90).sine, 1);
    EXPECT_EQ(direction_of_degrees(start + 180).cosine, -1);
    EXPECT_EQ(direction_of_degrees(start + 180).sine, 0);
    EXPECT_EQ(direction_of_degrees(start + 270).cosine, 0);
    EXPECT_EQ(direction_of_degrees(start + 270).sine, -1);
  }
  EXPECT_EQ(direction_of_degrees(30.0).sine, 0.5);
}

TEST(DirectionOfDegrees, HasNoNegativeZeros) {
  for (const double degrees : {-270.0, -180.0, -90.0, 0.0, -0.0, 90.0, 180.0, 270.0}) {
    const Direction<double> d = direction_of_degrees(degrees);
    EXPECT_FALSE(d.cosine == 0 && std::signbit(d.cosine)) << degrees;
    EXPECT_FALSE(d.sine == 0 && std::signbit(d.sine)) << degrees;
  }
}

TEST(DirectionOfDegrees, OfMirrorImagesAreMirrorImages) {
  for (int i = 0; i <= 90 * 64; ++i) {
    const double degrees = i / 64.0;  // exact, and so are its mirror images
    const Direction<double> d = direction_of_degrees(degrees);
    const Direction<double> across = direction_of_degrees(90 - degrees);
    const Direction<double> left = direction_of_degrees(180 - degrees);
    const Direction<double> down = direction_of_degrees(-degrees);
    const Direction<double> back = direction_of_degrees(180 + degrees);
    ASSERT_EQ(across.cosine, d.sine) << degrees;
    ASSERT_EQ(across.sine, d.cosine) << degrees;
    ASSERT_EQ(left.cosine, -d.cosine) << degrees;
    ASSERT_EQ(left.sine, d.sine) << degrees;
    ASSERT_EQ(down.cosine, d.cosine) << degrees;
    ASSERT_EQ(down.sine, -d.sine) << degrees;
    ASSERT_EQ(back.cosine, -d.cosine) << degrees;
    ASSERT_EQ(back.sine, -d.sine) << degrees;
  }
}

TEST(DirectionOfDegrees, ReducesHugeAnglesWithoutError) {
  // 2^60 mod 360 = 136 (2^60 = 1152921504606846976).
  EXPECT_EQ(direction_of_degrees(0x1p60).cosine, direction_of_degrees(136.0).cosine);
  EXPECT_EQ(direction_of_degrees(0x1p60).sine, direction_of_degrees(136.0).sine);
  EXPECT_EQ(direction_of_degrees(-0x1p60).sine, direction_of_degrees(-136.0).sine);
  const Direction<double> d = direction_of_degrees(std::numeric_limits<double>::max());
  EXPECT_NEAR(d.cosine * d.cosine + d.sine * d.sine, 1, 1e-15);
}

TEST(DirectionOfDegrees, IsNotANumberForWhatIsNotFinite) {
  EXPECT_TRUE(std::isnan(direction_of_degrees(std::numeric_limits<double>::infinity()).sine));
  EXPECT_TRUE(std::isnan(direction_of_degrees(std::numeric_limits<double>::quiet_NaN()).cosine));
}

TEST(DirectionOfDegrees, IsAsPreciseAsWiderTypes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(-360, 360);
  for (int i = 0; i < 500; ++i) {
    const double degrees = angle(random);
    const Digits60 exact = sin(radians(degrees));
    const auto of_long = direction_of_degrees(static_cast<long double>(degrees));
    const auto of_quad = direction_of_degrees(static_cast<Float128>(degrees));
    const auto of_wide = direction_of_degrees(Digits60(degrees));
    EXPECT_LT(abs(Digits60(of_long.sine) - exact), 4e-19);
    const Digits60 quad =
        Digits60(static_cast<double>(of_quad.sine)) +
        Digits60(static_cast<double>(of_quad.sine - static_cast<double>(of_quad.sine)));
    EXPECT_LT(abs(quad - exact), 1e-32);
    EXPECT_LT(abs(of_wide.sine - exact), Digits60("1e-58"));
  }
}

TEST(Exponential, IsWithinOneUlp) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> whole(-708, 709);
  std::uniform_real_distribution<double> usual(-12, 12);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? whole(random) : usual(random);
    worst = std::max(worst, ulps(exponential(x), exp(Digits60(x))));
  }
  EXPECT_LT(worst, 1.0);
}

TEST(Exponential, LeavesTheRangeGracefully) {
  EXPECT_EQ(exponential(0.0), 1);
  EXPECT_EQ(exponential(-1e300), 0);
  EXPECT_EQ(exponential(1e300), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(exponential(-740.0) / std::exp(-740.0), 1, 1e-2);  // subnormal
  EXPECT_TRUE(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
}

TEST(NaturalLogarithm, IsWithinOneUlp) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> exponent(-1073, 1023);
  std::uniform_real_distribution<double> near_one(0.5, 2);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? std::exp2(exponent(random)) : near_one(random);
    worst = std::max(worst, ulps(natural_logarithm(x), log(Digits60(x))));
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(natural_logarithm(1.0), 0);
}

TEST(ArcSine, IsWithinOneUlp) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> sine(-1, 1);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = sine(random);
    worst = std::max(worst, ulps(arc_sine(x), asin(Digits60(x))));
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(arc_sine(0.0), 0);
  EXPECT_LT(ulps(arc_sine(1.0), boost::math::constants::half_pi<Digits60>()), 0.5);
}

TEST(Elementary, WideTypesAgreeWithTheirLibrary) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> x(-0.99, 0.99);
  for (int i = 0; i < 200; ++i) {
    const Digits60 w(x(random));
    EXPECT_LT(abs(exponential(w) - exp(w)), Digits60("1e-57"));
    EXPECT_LT(abs(natural_logarithm(Digits60(w + 1)) - log(Digits60(w + 1))), Digits60("1e-57"));
    EXPECT_LT(abs(arc_sine(w) - asin(w)), Digits60("1e-57"));
  }
  EXPECT_LT(abs(pi<Digits60>() - boost::math::constants::pi<Digits60>()), Digits60("1e-58"));
}

}  // namespace
}  // namespace poolhall::physics
