// Runs every fuzzer's kept inputs and nothing else, for tests/fuzz/coverage.
//
//   fuzz_corpus SOURCES
#include <cstdio>
#include <filesystem>

#include "tests/fuzz/protocol/corpus.hpp"
#include "tests/fuzz/protocol/protocol_targets.hpp"
#include "tests/fuzz/settings/settings_target.hpp"

int main(int argc, char** argv) {
  using namespace poolhall::fuzz;
  if (argc != 2) {
    return 2;
  }
  const std::filesystem::path sources = argv[1];
  for (const Target& target : targets) {
    std::printf("%s: %zu inputs\n", target.name.data(),
                run_corpus(sources, target.name, target.run));
  }
  std::printf("settings: %zu inputs\n", run_corpus(sources, "settings", settings));
  return 0;
}
