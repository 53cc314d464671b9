// Many contacts at one instant: generalized reflections of Smith, Kaufman, Vouga, Tamstorf and
// Grinspun 2012, "Reflections on Simultaneous Impact". All contacts that approach are reflected
// together, again and again until none approaches: momentum, energy and symmetry are kept, and
// momentum travels through a row of balls (Newton's cradle). Restitution as in their section 6:
// e times the reflection plus (1 - e) times the inelastic answer.
//
//   GeneralizedReflections<double> reflections;
//   reflections.resolve(graph, restitution, separation_speed);
//   reflections.impulse(k);  // at each contact, kg m/s with mass 1
#pragma once

#include <bit>

#include "physics/inelastic_projection.hpp"

namespace poolhall::physics {

template <class Real>
class GeneralizedReflections {
 public:
  // Changes the velocities in `graph`. Contacts that took an impulse, and contact 0, whose balls
  // met now, part at the separation speed at least.
  void resolve(ContactGraph<Real>& graph, const Real& restitution, const Real& separation_speed) {
    const ContactGraph<Real> before = graph;
    start(graph, separation_speed);
    reflect(graph);
    if (restitution != Real(1)) {
      blend(graph, before, restitution);
    }
    separate(graph, separation_speed);
  }

  // For impulses that another model found: `graph` has the velocities after them.
  template <class Model>
  void adopt(ContactGraph<Real>& graph, const ContactGraph<Real>& before, const Model& model,
             const Real& separation_speed) {
    start(before, separation_speed);
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      impulse_[k] = model.impulse(k);
    }
    separate(graph, separation_speed);
  }

  [[nodiscard]] const Real& impulse(std::size_t k) const { return impulse_[k]; }
  [[nodiscard]] bool took_impulse(std::size_t k) const { return ((takers_ >> k) & 1U) != 0; }
  [[nodiscard]] bool raised() const { return raised_; }

 private:
  using Members = typename InelasticProjection<Real>::Members;
  using Impulses = typename InelasticProjection<Real>::Impulses;
  // A rack needs about twenty rounds. If they did not end, the last one is inelastic.
  static constexpr int bound = 2000;

  [[nodiscard]] static Members all(const ContactGraph<Real>& graph) {
    return graph.contacts() == 64 ? ~Members{0} : (Members{1} << graph.contacts()) - 1;
  }

  void start(const ContactGraph<Real>& graph, const Real& separation_speed) {
    takers_ = 1;
    raised_ = false;
    tolerance_ = Real(0);
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      impulse_[k] = Real(0);
      wanted_[k] = Real(0);
      const Real closing = -graph.separating(k);
      tolerance_ = closing > tolerance_ ? closing : tolerance_;
    }
    tolerance_ = Real(1e-12) * (tolerance_ + separation_speed);
  }

  [[nodiscard]] Members approaching(const ContactGraph<Real>& graph) const {
    Members set = 0;
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      if (graph.separating(k) < -tolerance_) {
        set |= Members{1} << k;
      }
    }
    return set;
  }

  void apply(ContactGraph<Real>& graph, const Impulses& impulses, const Real& times) {
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      if (impulses[k] > Real(0)) {
        graph.push(k, Real(times * impulses[k]));
        impulse_[k] += times * impulses[k];
      }
    }
  }

  void reflect(ContactGraph<Real>& graph) {
    for (int i = 0; i < bound; ++i) {
      const Members set = approaching(graph);
      if (set == 0) {
        return;
      }
      apply(graph, projection_.solve(graph, set, wanted_), Real(2));
    }
    apply(graph, projection_.solve(graph, all(graph), wanted_), Real(1));
  }

  void blend(ContactGraph<Real>& graph, const ContactGraph<Real>& before, const Real& restitution) {
    const Impulses& inelastic = projection_.solve(before, all(before), wanted_);
    ContactGraph<Real> result = before;
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      impulse_[k] = restitution * impulse_[k] + (Real(1) - restitution) * inelastic[k];
      if (impulse_[k] > Real(0)) {
        result.push(k, impulse_[k]);
      }
    }
    graph = result;
  }

  void separate(ContactGraph<Real>& graph, const Real& speed) {
    for (std::size_t i = 0; i <= graph.contacts(); ++i) {
      find_takers(graph);
      bool short_of_it = false;
      for (std::size_t k = 0; k < graph.contacts(); ++k) {
        wanted_[k] = took_impulse(k) ? speed : Real(0);
        short_of_it = short_of_it || graph.separating(k) < wanted_[k] - tolerance_;
      }
      if (!short_of_it) {
        return;
      }
      raised_ = true;
      apply(graph, projection_.solve(graph, all(graph), wanted_), Real(1));
    }
  }

  void find_takers(const ContactGraph<Real>& graph) {
    Real most(0);
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      most = impulse_[k] > most ? impulse_[k] : most;
    }
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      if (impulse_[k] > Real(1e-12) * most) {
        takers_ |= Members{1} << k;
      }
    }
  }

  InelasticProjection<Real> projection_;
  Impulses impulse_{};
  Impulses wanted_{};
  Members takers_ = 0;
  Real tolerance_{};
  bool raised_ = false;
};

}  // namespace poolhall::physics
