#include "tests/bench/stiff_problems.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "physics/cushion.hpp"
#include "physics/hertz.hpp"

namespace poolhall::bench {

namespace {

using namespace physics;

Materials olympiad() {
  return *preset_materials("olympiad");
}

// Steps until `event` has fallen to zero, the last one shortened by bisection so that it just has.
// After `bound` steps what there is.
StiffState until(const StiffMethod& method, const StiffSystem& system, StiffState y, double h,
                 const std::function<double(const StiffState&)>& event) {
  constexpr int bound = 1'000'000;
  for (int i = 0; i < bound; ++i) {
    StiffState next = method.step(system, y, h);
    const double value = event(next);
    if (value > 0) {
      y = std::move(next);
      continue;
    }
    if (!(value <= 0)) {
      return next;  // no number
    }
    double low = 0, high = h;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (event(method.step(system, y, middle)) > 0 ? low : high) = middle;
    }
    return method.step(system, y, high);
  }
  return y;
}

// Hertz.

constexpr std::size_t chain = 5;
constexpr double contact_times = 6;  // in which the push has left the last ball

// Places in units of the greatest compression, speeds of the first ball's: F = k d^(3/2) with the
// stiffness that gives one ball on another that compression and a contact of 2.94 units of time.
// Energy: v^2 / 2 for each ball, so that 2/5 k d^(5/2) of a contact is its mass' 1/4.
StiffState chain_rate(const StiffState& y) {
  constexpr double stiffness = 5.0 / 8;
  StiffState slope(2 * chain);
  for (std::size_t i = 0; i < chain; ++i) {
    slope[i] = y[chain + i];
  }
  for (std::size_t i = 0; i + 1 < chain; ++i) {
    const double compression = y[i] - y[i + 1];
    if (compression > 0) {
      const double force = stiffness * compression * std::sqrt(compression);
      slope[chain + i] -= force;
      slope[chain + i + 1] += force;
    }
  }
  return slope;
}

double chain_energy(const StiffState& y) {
  double sum = 0;
  for (std::size_t i = 0; i < chain; ++i) {
    sum += y[chain + i] * y[chain + i] / 2;
  }
  for (std::size_t i = 0; i + 1 < chain; ++i) {
    const double compression = std::max(0.0, y[i] - y[i + 1]);
    sum += 0.4 * 5.0 / 8 * compression * compression * std::sqrt(compression);
  }
  return sum;
}

StiffState chain_after(const StiffMethod& method, double step) {
  const StiffSystem system{chain_rate, chain};
  StiffState y(2 * chain);
  y[chain] = 1;
  const double duration = 2.94 * contact_times;
  const auto steps = static_cast<int>(std::ceil(contact_times / step));
  for (int i = 0; i < steps; ++i) {
    y = method.step(system, y, duration / steps);
  }
  return y;
}

StiffProblem hertz_chain() {
  // RK4 far below the smallest step of the sweep; the force has no third derivative at d = 0.
  const auto& methods = stiff_methods();
  const StiffState truth = chain_after(methods[3], 1.0 / 65536);
  const auto solve = [truth](const StiffMethod& method, double step) -> StiffResult {
    const StiffState y = chain_after(method, step);
    double sum = 0;
    for (std::size_t i = chain; i < 2 * chain; ++i) {
      sum += (y[i] - truth[i]) * (y[i] - truth[i]);
    }
    return {std::sqrt(sum), (chain_energy(y) - 0.5) / 0.5};
  };
  return {"hertz", "contact times", true, solve};
}

// Spring.

StiffProblem cushion_spring() {
  const auto solve = [](const StiffMethod& method, double step) -> StiffResult {
    const SpringCushion cushion;
    const double z = cushion.damping_ratio;
    const auto exact = spring_release<double>(cushion, olympiad().ball_mass);
    const double w = std::sqrt(cushion.stiffness / olympiad().ball_mass);
    // Time in 1 / w, the speed into the cushion 1.
    const auto push = [z](const StiffState& y) { return y[0] + 2 * z * y[1]; };
    const StiffSystem system{[push](const StiffState& y) { return StiffState{y[1], -push(y)}; }, 1};
    // The force is not zero at first touch, when the damper pushes: released once it is again.
    const StiffState y = until(method, system, {0, 1}, step * exact.contact_time * w, push);
    const double e = exact.restitution;
    return {std::abs(-y[1] - e), y[1] * y[1] - e * e};
  };
  return {"spring", "contact times", true, solve};
}

// Mathavan.

struct Impact {
  Vec2<double> velocity;
  Vec3<double> spin;  // R w
};

std::array<Impact, 6> impacts() {
  std::array<Impact, 6> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t direction = i / 2;
    const double angle = static_cast<double>(direction) * std::numbers::pi / 6;
    out[i].velocity = {std::cos(angle), std::sin(angle)};
    if (i % 2 == 1) {
      out[i].spin = {-out[i].velocity.y, out[i].velocity.x, 0};
    }
  }
  return out;
}

// The direction of a slip, smoothed where it is below a ten-thousandth of the speed: one-step
// methods know no sticking. This is what they solve; the library's answer sticks.
Vec2<double> smoothed(const Vec2<double>& slip) {
  constexpr double least = 1e-4;
  return (1 / std::sqrt(dot(slip, slip) + least * least)) * slip;
}

double energy_of(const Vec2<double>& v, const Vec3<double>& spin) {
  return dot(v, v) / 2 + dot(spin, spin) / 5;
}

PressedState<double> pressed_state(const StiffState& y) {
  PressedState<double> out{};
  std::copy(y.begin(), y.end(), out.begin());
  return out;
}

Impact impact_after(const Impact& before, const StiffMethod& method, double step) {
  const Mathavan2010Cushion cushion;
  const NoseAngle<double> nose{0.28, std::sqrt(1 - 0.28 * 0.28)};
  const NoseAndCloth<double> contacts(nose, cushion.friction, olympiad().mu_slide);
  const StiffSystem system{[&contacts](const StiffState& state) {
                             const PressedState<double> y = pressed_state(state);
                             const auto forces =
                                 contacts.forces(smoothed(slip_at(y, pressed::nose_slip)),
                                                 smoothed(slip_at(y, pressed::cloth_slip)), {});
                             const auto rate = contacts.rate(forces, y, {});
                             return StiffState(rate.begin(), rate.end());
                           },
                           0};
  const auto start = contacts.state_of(before.velocity, before.spin);
  StiffState y(start.begin(), start.end());
  const double h = step * before.velocity.x / nose.cosine;
  y = until(method, system, std::move(y), h, [](const StiffState& s) { return s[pressed::vx]; });
  const double kept = (1 - cushion.restitution * cushion.restitution) * y[pressed::work];
  y = until(method, system, std::move(y), h,
            [kept](const StiffState& s) { return s[pressed::work] - kept; });
  return {{y[pressed::vx], y[pressed::vy]},
          {y[pressed::spin_x], y[pressed::spin_y], y[pressed::spin_z]}};
}

Impact impact_by_library(const Impact& before) {
  Materials materials = olympiad();
  materials.ball_radius = 1;
  materials.cushion = Mathavan2010Cushion{};
  const NoseAngle<double> nose{0.28, std::sqrt(1 - 0.28 * 0.28)};
  const CushionContact<double> after = cushion_response(
      CushionContact<double>{before.velocity, before.spin}, Mathavan2010Cushion{}, materials, nose);
  return {after.velocity, after.angular_velocity};
}

StiffProblem pressed_impacts() {
  const auto solve = [](const StiffMethod& method, double step) -> StiffResult {
    double sum = 0, drift = 0;
    for (const Impact& before : impacts()) {
      const Impact found = impact_after(before, method, step);
      const Impact truth = impact_by_library(before);
      const Vec2<double> v = found.velocity - truth.velocity;
      const Vec3<double> w = found.spin - truth.spin;
      sum += (dot(v, v) + dot(w, w)) / 6;
      const double off =
          (energy_of(found.velocity, found.spin) - energy_of(truth.velocity, truth.spin)) /
          energy_of(before.velocity, before.spin);
      drift = std::abs(off) > std::abs(drift) || !(off == off) ? off : drift;
    }
    return {std::sqrt(sum), drift};
  };
  return {"mathavan2010", "stopping impulses", false, solve};
}

}  // namespace

std::vector<StiffProblem> stiff_problems() {
  return {hertz_chain(), cushion_spring(), pressed_impacts()};
}

}  // namespace poolhall::bench
