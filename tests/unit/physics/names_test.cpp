#include <gtest/gtest.h>

#include "physics/event_log.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {
namespace {

TEST(Names, ComeBackAsTheirEnumerators) {
  for (int i = 0; i < 5; ++i) {
    const auto state = static_cast<MotionState>(i);
    EXPECT_EQ(motion_state(name(state)), state);
    const auto type = static_cast<EventType>(i);
    EXPECT_EQ(event_type(name(type)), type);
  }
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(pocket_id(name(static_cast<PocketId>(i))), static_cast<PocketId>(i));
    EXPECT_EQ(rail_id(name(static_cast<RailId>(i))), static_cast<RailId>(i));
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(contact_model(name(static_cast<ContactModel>(i))), static_cast<ContactModel>(i));
    EXPECT_EQ(root_solver(name(static_cast<RootSolver>(i))), static_cast<RootSolver>(i));
  }
}

TEST(Names, UnknownWordsHaveNoEnumerator) {
  EXPECT_FALSE(motion_state("flying"));
  EXPECT_FALSE(event_type(""));
  EXPECT_FALSE(pocket_id("side"));
  EXPECT_FALSE(rail_id("left"));
}

}  // namespace
}  // namespace poolhall::physics
