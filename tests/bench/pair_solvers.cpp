#include "tests/bench/pair_solvers.hpp"

#include "physics/contact_search.hpp"
#include "tests/bench/timing.hpp"

namespace poolhall::bench {

namespace {

using physics::PairMotion;
using physics::RootSolver;

template <class Real>
physics::Segment<Real> motion_of(const Disc& disc) {
  physics::Segment<Real> s;
  s.position = physics::converted<Real>(disc.position);
  s.velocity = physics::converted<Real>(disc.velocity);
  s.acceleration = physics::converted<Real>(disc.acceleration);
  return s;
}

// As the event loop asks.
template <class Real>
PairMotion<Real> seen_from_first(const DiscPair& pair) {
  const Real reach = Real(2) * static_cast<Real>(pair.radius);
  return physics::pair_motion(motion_of<Real>(pair.first), motion_of<Real>(pair.second),
                              physics::Instant<Real>{}, Real(reach * reach));
}

template <class Real>
struct ContactRule {
  RootSolver solver;
  std::optional<Real> operator()(const PairMotion<Real>& p, const Real& horizon) const {
    return physics::first_contact(p, horizon, solver);
  }
};

// Leckie and Greenspan, below (19).
template <class Real>
struct SmallestPositiveRoot {
  std::optional<Real> operator()(const PairMotion<Real>& p, const Real& horizon) const {
    const auto roots = physics::quartic_roots(physics::gap_polynomial(p));
    for (std::size_t i = 0; i < roots.count; ++i) {
      if (roots.at[i] > Real(0) && roots.at[i] <= horizon) {
        return roots.at[i];
      }
    }
    return std::nullopt;
  }
};

template <class Real, class Find>
PairAnswers all_answers(const std::vector<DiscPair>& pairs, const Find& find) {
  std::vector<std::optional<Real>> found(pairs.size());
  PairAnswers answers;
  const double took = least_microseconds(1, [&] {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      found[i] = find(seen_from_first<Real>(pairs[i]), static_cast<Real>(pairs[i].horizon));
    }
  });
  answers.nanoseconds = 1000 * took / static_cast<double>(pairs.size());
  answers.times.assign(found.begin(), found.end());
  return answers;
}

template <class Real>
void add_solvers(std::vector<PairSolver>& all, const std::string& precision) {
  const auto add = [&](const std::string& name, MustHold must_hold, const auto& find) {
    all.push_back({name, precision, must_hold, [find](const std::vector<DiscPair>& pairs) {
                     return all_answers<Real>(pairs, find);
                   }});
  };
  add("bracketed (default)", MustHold::yes, ContactRule<Real>{RootSolver::bracketed});
  add("closed form, polished", MustHold::no, ContactRule<Real>{RootSolver::closed_form_polished});
  add("closed form", MustHold::no, ContactRule<Real>{RootSolver::closed_form});
  add("smallest positive root", MustHold::no, SmallestPositiveRoot<Real>{});
}

}  // namespace

std::vector<PairSolver> pair_solvers() {
  std::vector<PairSolver> all;
  add_solvers<double>(all, "double");
  add_solvers<long double>(all, "long double");
  return all;
}

}  // namespace poolhall::bench
