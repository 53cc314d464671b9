// What must be true of every answer, in a fuzzer: what is not true ends the program, and libFuzzer
// keeps the input.
//
//   demand(!error.reason.empty(), "an error has a reason");
#pragma once

#include <cstdio>
#include <cstdlib>

namespace poolhall::fuzz {

inline void demand(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
  }
}

}  // namespace poolhall::fuzz
