// Balls that touch, or nearly touch, at one instant, and the contacts between them. Velocities are
// changed by impulses along the contacts' normals; all balls have mass 1.
//
//   ContactGraph<double> graph;
//   graph.add_ball(v0); graph.add_ball(v1);
//   graph.add_contact(0, 1, normal);
//   graph.separating(0);        // m/s along the normal, negative while the balls approach
//   graph.push(0, 0.5);         // impulse of 0.5 kg m/s, apart
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "physics/ball.hpp"
#include "physics/vector.hpp"

namespace poolhall::physics {

// Discs of one size that touch make a planar graph: at most 3 n - 6 contacts. Those within the
// cluster threshold do too; some room is left for the overlap that check_scene lets pass.
inline constexpr std::size_t max_contacts = 3 * max_balls;

template <class Real>
struct Contact {
  std::uint8_t first = 0;  // places in the graph
  std::uint8_t second = 0;
  Vec2<Real> normal{};  // unit vector from `first` to `second`
};

template <class Real>
class ContactGraph {
 public:
  void clear() { balls_ = contacts_ = 0; }
  void add_ball(const Vec2<Real>& velocity) { velocity_[balls_++] = velocity; }
  void add_contact(std::size_t first, std::size_t second, const Vec2<Real>& normal) {
    if (contacts_ < max_contacts) {
      contact_[contacts_++] = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second),
                               normal};
    }
  }

  [[nodiscard]] std::size_t balls() const { return balls_; }
  [[nodiscard]] std::size_t contacts() const { return contacts_; }
  [[nodiscard]] const Contact<Real>& contact(std::size_t k) const { return contact_[k]; }
  [[nodiscard]] const Vec2<Real>& velocity(std::size_t ball) const { return velocity_[ball]; }
  void set_velocity(std::size_t ball, const Vec2<Real>& v) { velocity_[ball] = v; }

  [[nodiscard]] Real separating(std::size_t k) const {
    const Contact<Real>& c = contact_[k];
    return dot(velocity_[c.second] - velocity_[c.first], c.normal);
  }

  void push(std::size_t k, const Real& impulse) {
    const Contact<Real>& c = contact_[k];
    velocity_[c.first] = velocity_[c.first] - impulse * c.normal;
    velocity_[c.second] = velocity_[c.second] + impulse * c.normal;
  }

  // By how much an impulse of 1 at contact k changes the separating speed at contact l.
  [[nodiscard]] Real influence(std::size_t k, std::size_t l) const {
    const Contact<Real>& p = contact_[k];
    const Contact<Real>& q = contact_[l];
    if (k == l) {
      return Real(2);
    }
    const Real along = dot(p.normal, q.normal);
    Real sum(0);
    if (p.first == q.first || p.second == q.second) {
      sum += along;
    }
    if (p.first == q.second || p.second == q.first) {
      sum -= along;
    }
    return sum;
  }

 private:
  std::array<Vec2<Real>, max_balls> velocity_{};
  std::array<Contact<Real>, max_contacts> contact_{};
  std::size_t balls_ = 0;
  std::size_t contacts_ = 0;
};

}  // namespace poolhall::physics
