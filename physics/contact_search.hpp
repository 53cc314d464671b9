// The first contact of two discs by the solver that was asked for.
#pragma once

#include "physics/detect_pair.hpp"
#include "physics/lean.hpp"
#include "physics/quartic_closed_form.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {

template <class Policy = Lean, class Real>
[[nodiscard]] std::optional<Real> first_contact(const PairMotion<Real>& p, const Real& T,
                                                RootSolver solver) {
  if (solver == RootSolver::bracketed) {
    if constexpr (Policy::omits(Omission::clear_pairs)) {
      return first_contact(p, T);
    }
    return search_contact(p, gap_polynomial(p), T);
  }
  return closed_form_contact(p, T, solver == RootSolver::closed_form ? Polish::no : Polish::yes);
}

}  // namespace poolhall::physics
