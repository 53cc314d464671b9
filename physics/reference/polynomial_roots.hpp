// When a polynomial of time first falls through zero. Every root is isolated between the critical
// points, found in turn from the derivative's; nothing is pruned.
//
//   Polynomial gap{c0, c1, c2, c3, c4};                    // c0 + c1 t + ...
//   std::vector<Number> t = falls(gap, end);                // in [0, end]
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

// Every t in [0, end] at which p passes from above zero to below it, ascending; 0 is one of them if
// p(0) <= 0 and p falls there. Touching zero from above without passing is no fall.
[[nodiscard]] std::vector<Number> falls(const Polynomial& p, const Number& end);

}  // namespace poolhall::physics::reference
