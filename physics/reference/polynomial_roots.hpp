// When a polynomial of time first falls through zero. Every root is isolated between the critical
// points, found in turn from the derivative's; nothing is pruned.
//
//   Polynomial gap{c0, c1, c2, c3, c4};                    // c0 + c1 t + ...
//   for (const Fall& fall : falls(gap, end)) fall.t;        // in [0, end]
#pragma once

#include <vector>

#include "physics/reference/reference_number.hpp"

namespace poolhall::physics::reference {

// Coefficients in ascending powers.
using Polynomial = std::vector<Number>;

[[nodiscard]] Number value(const Polynomial& p, const Number& t);
[[nodiscard]] Polynomial derivative(const Polynomial& p);

// All roots in (0, end) at which the sign changes, ascending.
[[nodiscard]] std::vector<Number> sign_changes(const Polynomial& p, const Number& end);

struct Fall {
  Number t;
  Number from;   // p falls all the way from here, where it has a maximum or time begins,
  Number until;  // to here
};

// Every t in [0, end] at which p is zero or below and falls on: where it passes from above zero to
// below it, or begins to fall when it is not above it. Ascending. Touching zero from above without
// passing is no fall.
[[nodiscard]] std::vector<Fall> falls(const Polynomial& p, const Number& end);

}  // namespace poolhall::physics::reference
