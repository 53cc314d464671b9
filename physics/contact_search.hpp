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
    return first_contact<Policy>(p, T);
  }
  return closed_form_contact(p, T, solver == RootSolver::closed_form ? Polish::no : Polish::yes);
}

}  // namespace poolhall::physics
