// Balls that are hit together. A contact's neighbours take part if they are closer than 0.6 of the
// Hertzian compression at the largest closing speed in the cluster: real balls would still be
// touching when the push arrives.
//
//   ContactCluster<double> cluster(coefficients);
//   cluster.gather(balls, present, i, k, model);  // the balls as they are now; i and k have met
//   cluster.resolve(balls, friction, model);      // `balls` as they are afterwards
#pragma once

#include <algorithm>
#include <array>

#include "physics/ball_collision.hpp"
#include "physics/energy.hpp"
#include "physics/generalized_reflections.hpp"
#include "physics/hertz_impact.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {

// One contact of a cluster after the impact, balls by index, lower id first.
template <class Real>
struct ClusterHit {
  std::uint8_t first = 0;
  std::uint8_t second = 0;
  Real impulse{};  // per mass, m/s
};

template <class Real>
class ContactCluster {
 public:
  using Balls = std::array<Ball<Real>, max_balls>;
  using Indices = std::uint32_t;  // a set of ball indices, one bit each

  explicit ContactCluster(const Coefficients<Real>& c)
      : c_(c), unit_gap_(Real(0.6) * hertz_compression_at_unit_speed(c)), hertz_(c) {}

  // A cheap upper bound of the threshold at that closing speed: v^(4/5) <= 1 + v.
  [[nodiscard]] Real widest_gap(const Real& closing, ContactModel model) const {
    return widening(model) * unit_gap_ * (Real(1) + closing);
  }

  // Contact 0 is that of i and k. The threshold grows with the largest closing speed among the
  // contacts it lets in, until it lets in no more.
  void gather(const Balls& balls, Indices present, std::size_t i, std::size_t k,
              ContactModel model) {
    Real fastest = closing_speed(balls, i, k);
    for (;;) {
      collect(balls, present, i, k, widening(model) * unit_gap_ * four_fifths_power(fastest));
      Real found = fastest;
      for (std::size_t n = 0; n < graph_.contacts(); ++n) {
        found = std::max(found, Real(-graph_.separating(n)));
      }
      if (!(found > fastest)) {
        return;
      }
      fastest = found;
    }
  }

  [[nodiscard]] std::size_t contacts() const { return graph_.contacts(); }

  // The balls after the impact; those that took no impulse are left as they were.
  void resolve(Balls& balls, const BallFriction& friction, ContactModel model) {
    if (model == ContactModel::hertz) {
      integrate(balls);
    } else {
      reflections_.resolve(graph_, c_.restitution, c_.separation_speed);
    }
    const Balls before = balls;
    changed_ = 0;
    hit_count_ = 0;
    for (std::size_t n = 0; n < graph_.contacts(); ++n) {
      if (reflections_.took_impulse(n)) {
        const Contact<Real>& contact = graph_.contact(n);
        note_hit(before, member_[contact.first], member_[contact.second], n);
      }
    }
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      if (((changed_ >> member_[p]) & 1U) != 0) {
        balls[member_[p]].velocity = graph_.velocity(p);
      }
    }
    if (has_friction(friction)) {
      rub_all(before, balls, friction);
    }
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      if (((changed_ >> member_[p]) & 1U) != 0) {
        balls[member_[p]] = settled(balls[member_[p]], c_.radius);
      }
    }
    std::sort(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(hit_count_),
              [&before](const ClusterHit<Real>& p, const ClusterHit<Real>& q) {
                return std::pair(before[p.first].id, before[p.second].id) <
                       std::pair(before[q.first].id, before[q.second].id);
              });
  }

  [[nodiscard]] bool raised() const { return reflections_.raised(); }
  [[nodiscard]] Indices changed() const { return changed_; }
  [[nodiscard]] std::size_t hits() const { return hit_count_; }
  [[nodiscard]] const ClusterHit<Real>& hit(std::size_t n) const { return hits_[n]; }

 private:
  // While a spring is compressed the balls move: more of them take part.
  [[nodiscard]] static Real widening(ContactModel model) {
    return Real(model == ContactModel::hertz ? 10 : 1);
  }

  [[nodiscard]] static Real closing_speed(const Balls& balls, std::size_t i, std::size_t k) {
    const Vec2<Real> n = contact_normal(balls[i].position, balls[k].position);
    return dot(balls[i].velocity - balls[k].velocity, n);
  }

  void add_ball(const Balls& balls, std::size_t i) {
    place_[i] = graph_.balls();
    member_[graph_.balls()] = i;
    graph_.add_ball(balls[i].velocity);
    inside_ |= Indices{1} << i;
  }

  void add_contact(const Balls& balls, std::size_t i, std::size_t k) {
    graph_.add_contact(place_[i], place_[k], contact_normal(balls[i].position, balls[k].position));
  }

  void collect(const Balls& balls, Indices present, std::size_t i, std::size_t k, const Real& gap) {
    graph_.clear();
    inside_ = 0;
    add_ball(balls, i);
    add_ball(balls, k);
    add_contact(balls, i, k);
    const Real reach = c_.diameter + gap;
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      const std::size_t from = member_[p];
      for (std::size_t to = 0; to < max_balls; ++to) {
        if (to == from || ((present >> to) & 1U) == 0 || is_first_contact(from, to)) {
          continue;
        }
        // A contact between two members is added from the one that was expanded first.
        const bool known = ((inside_ >> to) & 1U) != 0;
        const Vec2<Real> d = balls[to].position - balls[from].position;
        if ((known && place_[to] < p) || dot(d, d) > reach * reach) {
          continue;
        }
        if (!known) {
          add_ball(balls, to);
        }
        add_contact(balls, from, to);
      }
    }
  }

  [[nodiscard]] bool is_first_contact(std::size_t i, std::size_t k) const {
    return (i == member_[0] && k == member_[1]) || (i == member_[1] && k == member_[0]);
  }

  void integrate(const Balls& balls) {
    const ContactGraph<Real> before = graph_;
    std::array<Vec2<Real>, max_balls> positions{};
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      positions[p] = balls[member_[p]].position;
    }
    hertz_.integrate(graph_, positions);
    reflections_.adopt(graph_, before, hertz_, c_.separation_speed);
  }

  void note_hit(const Balls& balls, std::size_t i, std::size_t k, std::size_t contact) {
    changed_ |= (Indices{1} << i) | (Indices{1} << k);
    const bool ordered = balls[i].id < balls[k].id;
    hits_[hit_count_++] = {static_cast<std::uint8_t>(ordered ? i : k),
                           static_cast<std::uint8_t>(ordered ? k : i),
                           reflections_.impulse(contact)};
  }

  // Pair by pair from the accumulated normal impulse and the slip before the impact. That is not
  // the slip on which the impulses then act: beyond the share of them that takes the most energy
  // they would drive the balls on, so that no more than that share acts, as sticking bounds the
  // friction of a pair. The share falls from 1 without a jump.
  void rub_all(const Balls& before, Balls& balls, const BallFriction& friction) const {
    const Balls smooth = balls;
    for (std::size_t n = 0; n < hit_count_; ++n) {
      const Ball<Real>& first = before[hits_[n].first];
      const Ball<Real>& second = before[hits_[n].second];
      const Vec2<Real> normal = contact_normal(first.position, second.position);
      const ContactSlip<Real> slip = contact_slip(first, second, normal, c_.radius);
      rub(balls[hits_[n].first], balls[hits_[n].second], normal, hits_[n].impulse, slip, c_,
          friction);
    }
    // What a share of the impulses wins: linear * share + square * share^2.
    Real linear(0), square(0), scale(0);
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      const Ball<Real>& with = balls[member_[p]];
      const Ball<Real>& without = smooth[member_[p]];
      Ball<Real> change;
      change.velocity = with.velocity - without.velocity;
      change.angular_velocity = with.angular_velocity - without.angular_velocity;
      linear += shared_energy(without, change, c_);
      square += kinetic_energy(change, c_);
      scale += kinetic_energy(without, c_);
    }
    if (square > Real(1e-26) * scale && -linear < square + square) {
      lessen(smooth, balls, linear < Real(0) ? Real(-linear / (square + square)) : Real(0));
    }
  }

  void lessen(const Balls& smooth, Balls& balls, const Real& share) const {
    for (std::size_t p = 0; p < graph_.balls(); ++p) {
      Ball<Real>& ball = balls[member_[p]];
      const Ball<Real>& without = smooth[member_[p]];
      ball.velocity = without.velocity + share * (ball.velocity - without.velocity);
      ball.angular_velocity =
          without.angular_velocity + share * (ball.angular_velocity - without.angular_velocity);
    }
  }

  Coefficients<Real> c_;
  Real unit_gap_{};  // m, threshold at a closing speed of 1 m/s
  ContactGraph<Real> graph_;
  GeneralizedReflections<Real> reflections_;
  HertzImpact<Real> hertz_;
  std::array<std::size_t, max_balls> member_{};  // ball index by place in the graph
  std::array<std::size_t, max_balls> place_{};
  std::array<ClusterHit<Real>, max_contacts> hits_{};
  std::size_t hit_count_ = 0;
  Indices inside_ = 0;
  Indices changed_ = 0;
};

}  // namespace poolhall::physics
