// The scenes of the determinism contract (physics/README.md), each with the hash of its bits: the
// same from gcc and clang, at any optimisation level, on x86-64.
//
//   for (const GoldenHash& g : golden_hashes()) ok = ok && g.found == g.expected;
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace poolhall::test_support {

struct GoldenHash {
  std::string name;  // scene and who played it
  std::uint64_t expected = 0;
  std::uint64_t found = 0;
};

// Whole breaks under each contact model, solver and cushion, as `simulate` plays them, in plain
// double and in wider numbers; and what `evaluate` makes of a shot under noise.
[[nodiscard]] std::vector<GoldenHash> golden_hashes();

}  // namespace poolhall::test_support
