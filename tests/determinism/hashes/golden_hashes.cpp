// Prints the hash of every golden scene in this build, and fails if one is not as it should be.
// A small program of its own, so that any compiler and optimisation level can be asked for it.
#include <cinttypes>
#include <cstdio>

#include "tests/support/golden_scenes.hpp"

int main() {
  int wrong = 0;
  for (const auto& g : poolhall::test_support::golden_hashes()) {
    const bool same = g.found == g.expected;
    wrong += same ? 0 : 1;
    std::printf("0x%016" PRIx64 "  %s%s\n", g.found, g.name.c_str(), same ? "" : "  WRONG");
  }
  return wrong == 0 ? 0 : 1;
}
