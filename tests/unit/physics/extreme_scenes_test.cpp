#include <gtest/gtest.h>

#include <set>

#include "physics/event_loop.hpp"
#include "tests/support/scenes.hpp"

namespace poolhall::test_support {
namespace {

TEST(ExtremeScenes, ComeOutAsExpected) {
  for (const NamedScene& s : extreme_scenes()) {
    const Finding finding = s.judge(physics::simulate(s.scene, s.options));
    EXPECT_TRUE(finding.as_expected)
        << s.name << ": expected " << s.expected << ", found " << finding.found;
  }
}

TEST(ExtremeScenes, HoldTheirInvariantsInEveryContactModel) {
  for (const NamedScene& s : extreme_scenes()) {
    auto options = s.options;
    // The longest runs have one ball: there is nothing to choose.
    options.event_limit = std::min(options.event_limit, 20'000U);
    for (const auto contact : {physics::ContactModel::sequential, physics::ContactModel::hertz}) {
      options.contact = contact;
      const auto result = physics::simulate(s.scene, options);
      if (result) {
        EXPECT_EQ(broken_invariant(s.scene, *result), "") << s.name << ", " << name(contact);
      }
    }
  }
}

// What `evaluate` plays.
TEST(ExtremeScenes, HoldTheirInvariantsInPlainDouble) {
  for (const NamedScene& s : extreme_scenes()) {
    const auto played = physics::simulate(s.scene, s.options);
    if (!played) {
      continue;
    }
    physics::EventLoop<double> loop(s.scene.table, s.scene.materials);
    physics::Recorder<double> recorder;
    physics::Simulation<double> plain;
    plain.ending = loop.run(s.scene.balls, s.scene.shot, s.options, recorder);
    plain.events = recorder.take();
    plain.balls = loop.balls();
    plain.energy = loop.energy();
    EXPECT_EQ(broken_invariant(s.scene, plain), "") << s.name;
    EXPECT_EQ(plain.ending, played->ending) << s.name;
  }
}

TEST(ExtremeScenes, HaveNamesOfTheirOwn) {
  std::multiset<std::string> names;
  for (const NamedScene& s : extreme_scenes()) {
    names.insert(s.name + s.expected);
    EXPECT_LE(names.count(s.name + s.expected), 1U) << s.name;
  }
}

}  // namespace
}  // namespace poolhall::test_support
