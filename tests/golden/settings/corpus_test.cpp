// The inputs of the settings' fuzzer, all of them, in the normal tests.
#include <gtest/gtest.h>

#include "tests/fuzz/protocol/corpus.hpp"
#include "tests/fuzz/settings/settings_target.hpp"

namespace poolhall::fuzz {
namespace {

TEST(SettingsFuzzCorpus, RunsThroughItsTarget) {
  EXPECT_GT(run_corpus(POOLHALL_SOURCE_DIR, "settings", settings), 10U);
}

}  // namespace
}  // namespace poolhall::fuzz
