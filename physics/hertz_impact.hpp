// Many contacts over time instead of at one instant: each a Hertzian spring with Tsuji's damping
// (Tsuji, Tanaka, Ishida 1992, whose restitution does not depend on speed), integrated by velocity
// Verlet until nothing touches. Stiff and slow; the truth that generalized reflections are compared
// with. The impact's duration (about 0.3 ms a contact) is not added to the clock: only velocities
// change.
//
//   HertzImpact<double> impact(coefficients);
//   impact.integrate(graph, positions);  // changes the velocities in `graph`
//   impact.impulse(k);                   // at each contact, kg m/s with mass 1
#pragma once

#include "physics/contact_graph.hpp"
#include "physics/hertz.hpp"

namespace poolhall::physics {

template <class Real>
class HertzImpact {
 public:
  // `steps`: of the time that one contact lasts at the largest closing speed.
  explicit HertzImpact(const Coefficients<Real>& c, int steps = 200)
      : diameter_(c.diameter),
        stiffness_(hertz_stiffness(c) / c.mass),
        unit_compression_(hertz_compression_at_unit_speed(c)),
        damping_(tsuji_damping(c.restitution)),
        steps_(steps) {}

  void integrate(ContactGraph<Real>& graph, const std::array<Vec2<Real>, max_balls>& positions) {
    position_ = positions;
    Real fastest(0);
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      impulse_[k] = Real(0);
      fastest = std::max(fastest, Real(-graph.separating(k)));
    }
    if (!(fastest > Real(0))) {
      return;
    }
    const ContactGraph<Real> before = graph;
    compress_and_release(graph, fastest);
    shed_gain(graph, before);
  }

  [[nodiscard]] const Real& impulse(std::size_t k) const { return impulse_[k]; }

 private:
  using Accelerations = std::array<Vec2<Real>, max_balls>;
  // In contact times of the fastest contact; slow ones last longer, as v^(-1/5).
  static constexpr long bound = 500;

  void compress_and_release(ContactGraph<Real>& graph, const Real& fastest) {
    // A contact at speed v lasts 2.94 times its compression over v (Hertz).
    const Real compression = unit_compression_ * four_fifths_power(fastest);
    const Real dt = Real(2.94) * compression / fastest / Real(steps_);
    Accelerations pull = accelerations(graph);
    for (long i = 0; i < bound * steps_; ++i) {
      for (std::size_t b = 0; b < graph.balls(); ++b) {
        graph.set_velocity(b, graph.velocity(b) + (dt / Real(2)) * pull[b]);
        position_[b] = position_[b] + dt * graph.velocity(b);
      }
      pull = accelerations(graph);
      for (std::size_t b = 0; b < graph.balls(); ++b) {
        graph.set_velocity(b, graph.velocity(b) + (dt / Real(2)) * pull[b]);
      }
      for (std::size_t k = 0; k < graph.contacts(); ++k) {
        impulse_[k] += dt * force_[k];
      }
      if (is_over(graph, Real(8) * compression)) {
        return;
      }
    }
  }

  // The integration may end with a little more energy than there was: the motion about the common
  // centre of mass gives it back.
  static void shed_gain(ContactGraph<Real>& graph, const ContactGraph<Real>& before) {
    Vec2<Real> mean{};
    Real was(0), is(0);
    for (std::size_t b = 0; b < graph.balls(); ++b) {
      mean = mean + graph.velocity(b);
      was += dot(before.velocity(b), before.velocity(b));
      is += dot(graph.velocity(b), graph.velocity(b));
    }
    if (!(is > was)) {
      return;
    }
    mean = (Real(1) / Real(static_cast<double>(graph.balls()))) * mean;
    const Real common = Real(static_cast<double>(graph.balls())) * dot(mean, mean);
    const Real spare = was > common ? Real(was - common) : Real(0);
    const Real factor = is > common ? square_root(Real(spare / (is - common))) : Real(1);
    for (std::size_t b = 0; b < graph.balls(); ++b) {
      graph.set_velocity(b, mean + factor * (graph.velocity(b) - mean));
    }
  }

  // alpha = -sqrt(5) ln e / sqrt(ln^2 e + pi^2), the closed form of Tsuji's curve.
  [[nodiscard]] static Real tsuji_damping(const Real& restitution) {
    if (!(restitution < Real(1))) {
      return Real(0);
    }
    const Real least = restitution > Real(1e-6) ? restitution : Real(1e-6);
    const Real log = natural_logarithm(least);
    return -square_root(Real(5)) * log / square_root(Real(log * log + pi<Real>() * pi<Real>()));
  }

  [[nodiscard]] Real gap(const ContactGraph<Real>& graph, std::size_t k) const {
    const Contact<Real>& c = graph.contact(k);
    return length(position_[c.second] - position_[c.first]) - diameter_;
  }

  // Per mass 1; with m* = 1/2: F = k d^(3/2) + alpha sqrt(m* k) d^(1/4) d', never pulling.
  [[nodiscard]] Accelerations accelerations(const ContactGraph<Real>& graph) {
    Accelerations sum{};
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      const Contact<Real>& c = graph.contact(k);
      const Vec2<Real> d = position_[c.second] - position_[c.first];
      const Real distance = length(d);
      const Real compression = diameter_ - distance;
      force_[k] = Real(0);
      if (!(compression > Real(0))) {
        continue;
      }
      const Vec2<Real> n = (Real(1) / distance) * d;
      const Real closing = dot(graph.velocity(c.first) - graph.velocity(c.second), n);
      const Real root = square_root(compression);
      const Real damping = damping_ * square_root(Real(stiffness_ / Real(2) * root)) * closing;
      const Real force = stiffness_ * compression * root + damping;
      if (force > Real(0)) {
        force_[k] = force;
        sum[c.first] = sum[c.first] - force * n;
        sum[c.second] = sum[c.second] + force * n;
      }
    }
    return sum;
  }

  // Nothing touches, and nothing that is still close approaches.
  [[nodiscard]] bool is_over(const ContactGraph<Real>& graph, const Real& close) const {
    for (std::size_t k = 0; k < graph.contacts(); ++k) {
      const Real apart = gap(graph, k);
      if (apart < Real(0) || (apart < close && graph.separating(k) < Real(0))) {
        return false;
      }
    }
    return true;
  }

  Real diameter_{};
  Real stiffness_{};         // per mass
  Real unit_compression_{};  // m at 1 m/s
  Real damping_{};
  int steps_ = 200;
  std::array<Vec2<Real>, max_balls> position_{};
  std::array<Real, max_contacts> force_{};
  std::array<Real, max_contacts> impulse_{};
};

}  // namespace poolhall::physics
