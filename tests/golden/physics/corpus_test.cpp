// The simulator's fuzzers' inputs, all of them, in the normal tests.
#include <gtest/gtest.h>

#include "tests/fuzz/protocol/corpus.hpp"
#include "tests/fuzz/simulate/simulate_targets.hpp"

namespace poolhall::fuzz {
namespace {

TEST(FuzzCorpus, RunsThroughTheSimulator) {
  EXPECT_GT(run_corpus(POOLHALL_SOURCE_DIR, "simulate", simulate), 10U);
  EXPECT_GT(run_corpus(POOLHALL_SOURCE_DIR, "balls", balls), 10U);
}

}  // namespace
}  // namespace poolhall::fuzz
