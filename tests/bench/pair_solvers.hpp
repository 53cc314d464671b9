// The ways to a first contact that are measured against each other on random pairs.
//
//   for (const PairSolver& solver : pair_solvers()) solver.answers(pairs);
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/pair_classes.hpp"

namespace poolhall::bench {

// A time in s for each pair; long double holds what every solver's number type can say.
struct PairAnswers {
  std::vector<std::optional<long double>> times;
  double nanoseconds = 0;  // a pair, from the two motions to the answer
};

enum class MustHold : std::uint8_t { no, yes };

struct PairSolver {
  std::string name;
  std::string precision;
  MustHold must_hold;  // yes: a wrong answer that is not marginal is a fault
  std::function<PairAnswers(const std::vector<DiscPair>&)> answers;
};

// The default search; the paper's closed form, polished and as it is, under the contact rule of
// physics/README.md; and the closed form under the paper's own rule, "the smallest positive real
// root". Each in double and long double.
[[nodiscard]] std::vector<PairSolver> pair_solvers();

}  // namespace poolhall::bench
