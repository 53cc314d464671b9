#include "clients/bots/noise_guess.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "clients/bots/dice.hpp"

namespace poolhall::bots {
namespace {

std::vector<client::SeenShot> shots_under(const protocol::NoiseParams& noise, std::size_t count) {
  Dice dice(Dice::key(1, "guess"), 0);
  std::vector<client::SeenShot> shots;
  for (std::size_t i = 0; i < count; ++i) {
    const protocol::ShotParams intended{.a = 1, .b = -2, .theta = 5, .phi = 123, .v = 3};
    shots.push_back({intended, protocol::with_noise(intended, noise, dice.deviates()), false});
  }
  return shots;
}

TEST(NoiseGuess, IsTheOlympiadsBeforeAnyShot) {
  EXPECT_EQ(guessed_noise({}), protocol::noise_preset("olympiad").value());
}

TEST(NoiseGuess, FindsTheFactorFromAFewShots) {
  const auto unit = protocol::noise_preset("olympiad").value();
  for (const double factor : {0.5, 1.0, 2.0, 5.0}) {
    const auto guess = guessed_noise(shots_under(protocol::scaled(unit, factor), 8));
    EXPECT_NEAR(guess.phi / unit.phi, factor, 0.3 * factor);
  }
}

TEST(NoiseGuess, NoErrorIsNoNoise) {
  EXPECT_EQ(guessed_noise(shots_under({}, 3)).phi, 0);
}

TEST(NoiseGuess, ShotsThatWereMovedSayNothing) {
  auto shots = shots_under({}, 1);
  shots[0].executed.theta = 60;
  shots[0].moved = true;
  EXPECT_EQ(guessed_noise(shots), protocol::noise_preset("olympiad").value());
}

}  // namespace
}  // namespace poolhall::bots
