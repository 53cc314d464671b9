#include "tests/bench/dormand_prince.hpp"

#include <gtest/gtest.h>

#include "tests/bench/against_reference.hpp"
#include "tests/bench/event_runs.hpp"
#include "tests/bench/scene_classes.hpp"

namespace poolhall::bench {
namespace {

// Among them thin hits that begin and end within a step, and balls that go into side pockets.
TEST(DormandPrince, HasTheEventsOfTheReference) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto shot = shot_of({"", 2 + i % 7, 0}, 2'000'000 + i);
    const auto truth = reference_simulate(reference_scene(shot), {});
    const SteppedShot run = integrate_adaptively(test_support::scene_of(shot), 1e-10);
    std::size_t next = 0;
    for (const auto& event : truth.events) {
      if (event.type == physics::EventType::transition ||
          event.type == physics::EventType::cue_strike) {
        continue;
      }
      ASSERT_LT(next, run.events.size()) << i;
      EXPECT_EQ(run.events[next].type, event.type) << i;
      EXPECT_NEAR(run.events[next].t, timed_event(event).t, 1e-6) << i;
      ++next;
    }
    EXPECT_EQ(next, run.events.size()) << i;
  }
}

}  // namespace
}  // namespace poolhall::bench
