// What `simulate` plays is as good as balls kept in wider numbers, in a time nearer to double's.
#include "physics/adaptive_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/watch.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::physics {
namespace {

struct Setting {
  const char* table;
  const char* materials;
};

Scene<double> shot_number(const Setting& setting, std::size_t i) {
  return test_support::scene_of(
      test_support::random_shot({.seed = 7'000'000 + i,
                                 .balls = 2 + i % 15,
                                 .table = *preset_table(setting.table),
                                 .materials = *preset_materials(setting.materials)}));
}

double largest_distance(const BallSet<double>& these, const BallSet<double>& those) {
  double largest = 0;
  for (std::size_t i = 0; i < these.count; ++i) {
    EXPECT_EQ(these[i].pocket, those[i].pocket);
    largest = std::max(largest, length(these[i].position - those[i].position));
  }
  return largest;
}

class AdaptiveLoopOn : public testing::TestWithParam<Setting> {};

TEST_P(AdaptiveLoopOn, StaysWithinAPicometreOfWiderNumbers) {
  double worst = 0;
  std::size_t careful = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const Scene<double> scene = shot_number(GetParam(), i);
    AdaptiveLoop<double> adaptive(scene.table, scene.materials);
    EventLoop<double, Precise> wide(scene.table, scene.materials);
    Unwatched none;
    ASSERT_EQ(adaptive.run(scene.balls, scene.shot, {}, none), Ending::at_rest) << i;
    ASSERT_EQ(wide.run(scene.balls, scene.shot, {}, none), Ending::at_rest) << i;
    EXPECT_EQ(adaptive.events(), wide.events()) << i;
    worst = std::max(worst, largest_distance(adaptive.balls(), wide.balls()));
    careful += adaptive.was_careful() ? 1 : 0;
  }
  EXPECT_LT(worst, 1e-11);
  // Neither always nor never.
  EXPECT_GT(careful, 20U);
  EXPECT_LT(careful, 1500U);
}

INSTANTIATE_TEST_SUITE_P(Settings, AdaptiveLoopOn,
                         testing::Values(Setting{"olympiad", "olympiad"},
                                         Setting{"bar7", "modern"}),
                         [](const auto& given) { return std::string(given.param.table); });

// Counts what it is told.
struct Counter {
  static constexpr bool records = false;
  std::uint32_t seen = 0;
  [[nodiscard]] Go see(const Sighting&) {
    ++seen;
    return Go::on;
  }
};

TEST(AdaptiveLoop, TellsItsWatchOnlyOfTheRunThatCounts) {
  std::size_t careful = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    const Scene<double> scene = shot_number({"olympiad", "olympiad"}, i);
    AdaptiveLoop<double> loop(scene.table, scene.materials);
    Counter counter;
    static_cast<void>(loop.run(scene.balls, scene.shot, {}, counter));
    EXPECT_EQ(counter.seen, loop.events()) << i;
    careful += loop.was_careful() ? 1 : 0;
  }
  EXPECT_GT(careful, 0U);
}

TEST(AdaptiveLoop, StopsWhenItsWatchHasSeenEnough) {
  const Scene<double> scene = shot_number({"olympiad", "olympiad"}, 6);
  AdaptiveLoop<double> loop(scene.table, scene.materials);
  FirstContact contact{cue_ball};
  const Ending ending = loop.run(scene.balls, scene.shot, {}, contact);
  EXPECT_EQ(ending, contact.touched ? Ending::stopped : Ending::at_rest);
}

TEST(AdaptiveLoop, TakesWiderNumbersForABreakOfAFrozenRack) {
  const auto table = *preset_table("olympiad");
  const auto materials = *preset_materials("olympiad");
  const Scene<double> scene = test_support::scene_of(
      test_support::random_break({.seed = 1, .gap = 0, .table = table, .materials = materials}));
  AdaptiveLoop<double> loop(table, materials);
  Unwatched none;
  static_cast<void>(loop.run(scene.balls, scene.shot, {}, none));
  EXPECT_TRUE(loop.was_careful());
}

}  // namespace
}  // namespace poolhall::physics
