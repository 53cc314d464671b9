#include "protocol/units.hpp"

#include <gtest/gtest.h>

namespace poolhall::protocol {
namespace {

physics::Table table() {
  return physics::preset_table("olympiad").value();
}
physics::Materials materials() {
  return physics::preset_materials("olympiad").value();
}

physics::BallSet<double> cue_ball_alone() {
  physics::BallSet<double> balls;
  balls.count = 1;
  balls[0].position = {0.5, 0.6};
  return balls;
}

constexpr physics::ShotDeviates deviates{1, -1, 2, -2, 0.5};

TEST(NoisePresets, AreTheOlympiadsInTheWiresUnits) {
  EXPECT_EQ(noise_preset("olympiad"), (NoiseParams{0.5, 0.5, 0.1, 0.125, 0.075}));
  EXPECT_EQ(noise_preset("none"), NoiseParams{});
  EXPECT_EQ(noise_preset("low"), scaled(*noise_preset("olympiad"), 0.5));
  EXPECT_EQ(noise_preset("high"), scaled(*noise_preset("olympiad"), 5));
  EXPECT_FALSE(noise_preset("loud"));
}

TEST(WithNoise, AddsEachDeviationOnceInTheWiresUnits) {
  const ShotParams noisy = with_noise({1, 2, 30, 45, 3}, {0.5, 0.25, 0.125, 2, 1}, deviates);
  EXPECT_EQ(noisy, (ShotParams{1.5, 1.75, 30.25, 41, 3.5}));
}

// 2^52 + 74 degrees is the heading 90 with a last place of one degree: noise would be rounded away.
TEST(WithNoise, IsNotLostInTurnsThatAreWhole) {
  const NoiseParams noise{0, 0, 0, 0.125, 0};
  for (const double phi : {4503599627370570.0, 90.0, 450.0}) {
    EXPECT_EQ(with_noise({0, 0, 5, phi, 3}, noise, deviates).phi, 90 + 0.125 * deviates[3]) << phi;
  }
  EXPECT_EQ(with_noise({0, 0, 5, -450, 3}, noise, deviates).phi, -90 + 0.125 * deviates[3]);
}

TEST(ExecutedShot, IsTheIntendedOneWithoutNoise) {
  const ShotParams intended{0.1, -0.2, 10, 123.456, 2.1};
  const ExecutedShot executed =
      executed_shot(intended, {}, deviates, cue_ball_alone(), table(), materials());
  EXPECT_EQ(executed.params, intended);
  EXPECT_FALSE(executed.moved);
}

TEST(ExecutedShot, MovesWhatNoiseMadeImpossibleToAShotThatCanBePlayed) {
  const ExecutedShot executed =
      executed_shot({0, 0, 5, 90, 9.9}, *noise_preset("high"), {0, 0, 0, 0, 3}, cue_ball_alone(),
                    table(), materials());
  EXPECT_TRUE(executed.moved);
  EXPECT_EQ(executed.params.v, materials().max_cue_speed);
  EXPECT_TRUE(
      physics::check_shot(to_physics(executed.params), cue_ball_alone(), table(), materials()));
}

TEST(ExecutedShot, PlaysTheSameBitsWhenItsParametersArePlayedAgain) {
  for (int i = 0; i < 200; ++i) {
    const double d = (i - 100) / 20.0;
    const ExecutedShot once =
        executed_shot({0.3, 9, 20, 77, 3}, *noise_preset("high"), {d, -d, d, d, -d},
                      cue_ball_alone(), table(), materials());
    const ExecutedShot again =
        executed_shot(once.params, {}, deviates, cue_ball_alone(), table(), materials());
    EXPECT_EQ(again.params, once.params);
    EXPECT_FALSE(again.moved);
  }
}

}  // namespace
}  // namespace poolhall::protocol
