// The fuzzers' inputs, all of them, in the normal tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/protocol/protocol_targets.hpp"

namespace poolhall::fuzz {
namespace {

TEST(FuzzCorpus, RunsThroughEveryTarget) {
  const std::filesystem::path corpus =
      std::filesystem::path(POOLHALL_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const Target& target : targets) {
    std::size_t inputs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus / target.name)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string input{std::istreambuf_iterator<char>(in), {}};
      SCOPED_TRACE(entry.path().string());
      target.run(input);  // aborts where something does not hold
      ++inputs;
    }
    EXPECT_GT(inputs, 10U) << target.name;
  }
}

}  // namespace
}  // namespace poolhall::fuzz
