// One-step methods for y' = f(y), explicit and implicit, for the step sweeps of `bench stability`.
//
//   for (const StiffMethod& m : stiff_methods()) y = m.step(f, y, h);
#pragma once

#include <functional>
#include <string_view>
#include <vector>

namespace poolhall::bench {

using StiffState = std::vector<double>;
using StiffRate = std::function<StiffState(const StiffState&)>;

// A system whose first `places` components are moved by the next `places`, which are velocities;
// 0 if it is not of this form.
struct StiffSystem {
  StiffRate rate;
  std::size_t places = 0;
};

struct StiffMethod {
  std::string_view name;
  bool is_implicit = false;
  bool needs_places = false;  // splits places from velocities
  StiffState (*step)(const StiffSystem& system, const StiffState& y, double h) = nullptr;
};

// Explicit Euler, semi-implicit Euler, velocity Verlet and RK4; implicit Euler, implicit midpoint
// and trapezoid by Newton's method with the Jacobian from differences. An implicit step whose
// iteration does not converge is no number.
[[nodiscard]] const std::vector<StiffMethod>& stiff_methods();

}  // namespace poolhall::bench
