#include "physics/batch.hpp"

#include <gtest/gtest.h>

#include "physics/samples.hpp"

namespace poolhall::physics {
namespace {

Scene<double> easy_pot() {
  Scene<double> scene;
  scene.table = *preset_table("olympiad");
  scene.materials = *preset_materials("olympiad");
  scene.balls.count = 2;
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {0.5, 1.0};
  scene.balls[1].id = BallId{1};
  scene.balls[1].position = {0.3, 0.6};
  scene.shot = cue_shot_from_degrees(0.0, 0.0, 10.0, 243.0, 2.0);
  return scene;
}

TEST(Evaluate, IsTheSameForAnyNumberOfThreads) {
  EvaluationOptions options{.samples = 500, .threads = 1, .seed = 7};
  const auto one = evaluate(easy_pot(), *preset_noise("olympiad"), options);
  ASSERT_TRUE(one);
  for (const unsigned threads : {2U, 3U, 8U}) {
    options.threads = threads;
    EXPECT_EQ(*evaluate(easy_pot(), *preset_noise("olympiad"), options), *one);
  }
}

TEST(Evaluate, CountsEverySampleOnce) {
  const auto outcomes = evaluate(easy_pot(), *preset_noise("olympiad"), {.samples = 333});
  ASSERT_TRUE(outcomes);
  EXPECT_EQ(outcomes->samples, 333U);
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_EQ(outcomes->pocketed[n].total() + outcomes->resting[n].count, 333U);
  }
  EXPECT_EQ(outcomes->first_contact[1] + outcomes->no_contact, 333U);
}

TEST(Evaluate, WithoutNoiseEverySampleIsTheShotItself) {
  const auto outcomes = evaluate(easy_pot(), NoiseLevel{}, {.samples = 40});
  const auto shot = simulate(easy_pot(), {});
  ASSERT_TRUE(outcomes && shot);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& ball = shot->balls[i];
    EXPECT_EQ(outcomes->pocketed[i].total(), ball.pocket ? 40U : 0U);
    if (!ball.pocket) {
      EXPECT_NEAR(outcomes->resting[i].mean().x, ball.position.x, 1e-14);
    }
  }
}

TEST(Evaluate, RefusesASceneWithoutAShot) {
  Scene<double> scene = easy_pot();
  scene.shot.reset();
  const auto outcomes = evaluate(scene, NoiseLevel{}, {});
  ASSERT_FALSE(outcomes);
  EXPECT_EQ(outcomes.error().field, "/shot");
}

TEST(Samples, ArePhiloxWordsByNumber) {
  // Known answer of Random123's kat_vectors: philox4x32-10, counter 0, key 0.
  const RandomWords words = random_words(0, 0, 0);
  EXPECT_EQ(words.first, 0xe169c58d6627e8d5U);
  EXPECT_EQ(words.second, 0x9b00dbd8bc57ac4cU);
}

}  // namespace
}  // namespace poolhall::physics
