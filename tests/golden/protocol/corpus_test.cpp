// The fuzzers' inputs, all of them, in the normal tests.
#include <gtest/gtest.h>

#include "tests/fuzz/protocol/corpus.hpp"
#include "tests/fuzz/protocol/protocol_targets.hpp"

namespace poolhall::fuzz {
namespace {

TEST(FuzzCorpus, RunsThroughEveryTarget) {
  for (const Target& target : targets) {
    EXPECT_GT(run_corpus(POOLHALL_SOURCE_DIR, target.name, target.run), 10U) << target.name;
  }
}

}  // namespace
}  // namespace poolhall::fuzz
