// The determinism contract (physics/README.md) in this build; `./pool determinism` asks the same of
// gcc and clang at -O0 and -O3.
#include <gtest/gtest.h>

#include <ios>

#include "tests/support/golden_scenes.hpp"

namespace poolhall::test_support {
namespace {

TEST(GoldenScenes, GiveTheSameBitsInEveryBuild) {
  for (const GoldenHash& g : golden_hashes()) {
    EXPECT_EQ(g.found, g.expected) << g.name << std::hex << ": found 0x" << g.found;
  }
}

}  // namespace
}  // namespace poolhall::test_support
