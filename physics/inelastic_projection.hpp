// The least impulses that stop a set of contacts from approaching: the linear complementarity
// problem 0 <= impulse, 0 <= separating speed - wanted, one of them 0 at each contact. The balls'
// velocities that come out are unique; where contacts are redundant (a rack has 30 for 30
// velocities) so many impulses give them that those of least norm are taken: they keep symmetry.
//
//   InelasticProjection<double> projection;
//   const auto& impulses = projection.solve(graph, contacts_wanted);
//
// Method: block principal pivoting (Judice, Pires 1994) on the Gram matrix of the contacts plus
// 1e-8 on its diagonal; refinement takes the 1e-8 out of the answer again, and what it left along
// the redundant directions too. A redundancy that holds to about 1e-4 counts as one.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "physics/contact_graph.hpp"

namespace poolhall::physics {

template <class Real>
class InelasticProjection {
 public:
  using Impulses = std::array<Real, max_contacts>;
  using Members = std::uint64_t;  // a set of contacts, one bit each
  static_assert(max_contacts <= 64);

  // `wanted`: separating speed that each contact must at least have afterwards.
  [[nodiscard]] const Impulses& solve(const ContactGraph<Real>& graph, Members among,
                                      const Impulses& wanted) {
    prepare(graph, among, wanted);
    Members pushing = among;
    int patience = 3;
    int fewest = 65;
    for (int i = 0; i < bound; ++i) {
      impulses_of(pushing);
      const Members wrong = infeasible(pushing);
      if (wrong == 0) {
        break;
      }
      const int count = std::popcount(wrong);
      const bool all = count < fewest || patience-- > 0;
      if (count < fewest) {
        fewest = count;
        patience = 3;
      }
      // One at a time ends for certain (Murty); many at a time is faster.
      pushing ^= all ? wrong : std::bit_floor(wrong);
    }
    for (std::size_t a = 0; a < size_; ++a) {
      if (!has(pushing, a) || impulse_[index_[a]] < Real(0)) {
        impulse_[index_[a]] = Real(0);
      }
    }
    return impulse_;
  }

 private:
  static constexpr int bound = 400;
  static constexpr double softness = 1e-8;
  // Each refinement gains about seven digits.
  static constexpr int refinements = 2 + std::numeric_limits<Real>::digits10 / 7;

  [[nodiscard]] bool has(Members set, std::size_t a) const {
    return ((set >> index_[a]) & 1U) != 0;
  }

  void prepare(const ContactGraph<Real>& graph, Members among, const Impulses& wanted) {
    size_ = 0;
    scale_ = Real(0);
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      impulse_[k] = Real(0);
      if (((among >> k) & 1U) != 0) {
        index_[size_] = k;
        missing_[size_] = wanted[k] - graph.separating(k);
        const Real size = missing_[size_] < Real(0) ? Real(-missing_[size_]) : missing_[size_];
        scale_ = size > scale_ ? size : scale_;
        ++size_;
      }
    }
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b < size_; ++b) {
        gram_[a][b] = graph.influence(index_[a], index_[b]);
      }
    }
  }

  // Solves the active contacts' equations, refined, without redundant parts.
  void impulses_of(Members pushing) {
    active_ = 0;
    for (std::size_t a = 0; a < size_; ++a) {
      impulse_[index_[a]] = Real(0);
      if (has(pushing, a)) {
        row_[active_++] = a;
      }
    }
    factorise();
    std::array<Real, max_contacts> x{}, r{};
    for (int i = 0; i < refinements; ++i) {
      for (std::size_t p = 0; p < active_; ++p) {
        r[p] = missing_[row_[p]];
        for (std::size_t q = 0; q < active_; ++q) {
          r[p] -= gram_[row_[p]][row_[q]] * x[q];
        }
      }
      substitute(r);
      for (std::size_t p = 0; p < active_; ++p) {
        x[p] += r[p];
      }
    }
    r = x;
    for (int i = 0; i < refinements; ++i) {
      substitute(r);
      for (std::size_t p = 0; p < active_; ++p) {
        r[p] *= Real(softness);
      }
    }
    for (std::size_t p = 0; p < active_; ++p) {
      impulse_[index_[row_[p]]] = x[p] - r[p];
    }
  }

  // Cholesky of the active part of the Gram matrix, softened.
  void factorise() {
    using std::sqrt;
    for (std::size_t p = 0; p < active_; ++p) {
      for (std::size_t q = 0; q <= p; ++q) {
        Real sum = gram_[row_[p]][row_[q]] + (p == q ? Real(softness) : Real(0));
        for (std::size_t s = 0; s < q; ++s) {
          sum -= lower_[p][s] * lower_[q][s];
        }
        if (p == q) {
          lower_[p][p] =
              sqrt(sum > Real(softness) / Real(4) ? sum : Real(Real(softness) / Real(4)));
        } else {
          lower_[p][q] = sum / lower_[q][q];
        }
      }
    }
  }

  void substitute(std::array<Real, max_contacts>& r) const {
    for (std::size_t p = 0; p < active_; ++p) {
      for (std::size_t s = 0; s < p; ++s) {
        r[p] -= lower_[p][s] * r[s];
      }
      r[p] /= lower_[p][p];
    }
    for (std::size_t p = active_; p-- > 0;) {
      for (std::size_t s = p + 1; s < active_; ++s) {
        r[p] -= lower_[s][p] * r[s];
      }
      r[p] /= lower_[p][p];
    }
  }

  // Contacts that pull, and contacts left out that still approach.
  [[nodiscard]] Members infeasible(Members pushing) const {
    const Real tolerance = Real(1e-12) * scale_;
    Members wrong = 0;
    for (std::size_t a = 0; a < size_; ++a) {
      Real value = impulse_[index_[a]];
      if (!has(pushing, a)) {
        value = -missing_[a];
        for (std::size_t p = 0; p < active_; ++p) {
          value += gram_[a][row_[p]] * impulse_[index_[row_[p]]];
        }
      }
      if (value < -tolerance) {
        wrong |= Members{1} << index_[a];
      }
    }
    return wrong;
  }

  std::array<std::size_t, max_contacts> index_{};
  std::array<std::size_t, max_contacts> row_{};
  std::array<Real, max_contacts> missing_{};
  Impulses impulse_{};
  std::array<std::array<Real, max_contacts>, max_contacts> gram_{};
  std::array<std::array<Real, max_contacts>, max_contacts> lower_{};
  std::size_t size_ = 0;
  std::size_t active_ = 0;
  Real scale_{};
};

}  // namespace poolhall::physics
