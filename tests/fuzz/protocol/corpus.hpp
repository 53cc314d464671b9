// Runs a fuzzer's kept inputs through what it does with them.
//
//   EXPECT_GT(run_corpus(POOLHALL_SOURCE_DIR, "request", fuzz::request), 10U);
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace poolhall::fuzz {

// The number of inputs. A target aborts where something does not hold.
inline std::size_t run_corpus(const std::filesystem::path& sources, std::string_view target,
                              void (*run)(std::string_view)) {
  std::size_t inputs = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(sources / "tests/fuzz/corpus" / target)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(in), {}};
    run(input);
    ++inputs;
  }
  return inputs;
}

}  // namespace poolhall::fuzz
