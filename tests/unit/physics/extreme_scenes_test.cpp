#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace poolhall::test_support {
namespace {

TEST(ExtremeScenes, ComeOutAsExpected) {
  for (const NamedScene& s : extreme_scenes()) {
    EXPECT_EQ(s.judge(physics::simulate(s.scene, s.options)), "")
        << s.name << ": expected " << s.expected;
  }
}

TEST(ExtremeScenes, HoldTheirInvariantsInEveryContactModel) {
  for (const NamedScene& s : extreme_scenes()) {
    for (const auto contact : {physics::ContactModel::sequential, physics::ContactModel::hertz}) {
      auto options = s.options;
      options.contact = contact;
      const auto result = physics::simulate(s.scene, options);
      if (result) {
        EXPECT_EQ(broken_invariant(s.scene, *result), "") << s.name;
      }
    }
  }
}

}  // namespace
}  // namespace poolhall::test_support
