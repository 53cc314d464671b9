#include "tests/bench/stiff_methods.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace poolhall::bench {

namespace {

// p + k q
StiffState moved(StiffState p, double k, const StiffState& q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] += k * q[i];
  }
  return p;
}

StiffState explicit_euler(const StiffSystem& system, const StiffState& y, double h) {
  return moved(y, h, system.rate(y));
}

// Velocities first, places with the new ones.
StiffState semi_implicit_euler(const StiffSystem& system, const StiffState& y, double h) {
  const StiffState slope = system.rate(y);
  StiffState next = y;
  for (std::size_t i = 0; i < system.places; ++i) {
    next[system.places + i] += h * slope[system.places + i];
    next[i] += h * next[system.places + i];
  }
  return next;
}

StiffState velocity_verlet(const StiffSystem& system, const StiffState& y, double h) {
  const StiffState slope = system.rate(y);
  StiffState next = y;
  for (std::size_t i = 0; i < system.places; ++i) {
    next[system.places + i] += h / 2 * slope[system.places + i];
    next[i] += h * next[system.places + i];
  }
  const StiffState there = system.rate(next);
  for (std::size_t i = system.places; i < y.size(); ++i) {
    next[i] += h / 2 * there[i];
  }
  return next;
}

StiffState runge_kutta_4(const StiffSystem& system, const StiffState& y, double h) {
  const StiffState k1 = system.rate(y);
  const StiffState k2 = system.rate(moved(y, h / 2, k1));
  const StiffState k3 = system.rate(moved(y, h / 2, k2));
  const StiffState k4 = system.rate(moved(y, h, k3));
  StiffState next = moved(y, h / 6, k1);
  next = moved(std::move(next), h / 3, k2);
  next = moved(std::move(next), h / 3, k3);
  return moved(std::move(next), h / 6, k4);
}

// d residual / dz by central differences.
Eigen::MatrixXd jacobian(const StiffRate& residual, const StiffState& z) {
  const auto n = static_cast<Eigen::Index>(z.size());
  Eigen::MatrixXd out(n, n);
  StiffState shifted = z;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double shift = 1e-7 * (std::abs(z[k]) + 1e-3);
    shifted[k] = z[k] + shift;
    const StiffState above = residual(shifted);
    shifted[k] = z[k] - shift;
    const StiffState below = residual(shifted);
    shifted[k] = z[k];
    for (std::size_t i = 0; i < z.size(); ++i) {
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (above[i] - below[i]) / (2 * shift);
    }
  }
  return out;
}

double size_of(const StiffState& z) {
  double sum = 0;
  for (const double x : z) {
    sum += x * x;
  }
  return std::sqrt(sum);
}

// A root of `residual` by Newton's method, each step halved until the residual falls.
StiffState newton_root(const StiffRate& residual, StiffState z) {
  StiffState r = residual(z);
  for (int i = 0; i < 50; ++i) {
    const double before = size_of(r);
    if (!(before > 1e-13 * (1 + size_of(z)))) {
      return z;
    }
    const Eigen::VectorXd change = jacobian(residual, z)
                                       .partialPivLu()
                                       .solve(Eigen::Map<const Eigen::VectorXd>(
                                           r.data(), static_cast<Eigen::Index>(r.size())));
    const StiffState direction(change.data(), change.data() + change.size());
    double share = 1;
    StiffState next = moved(z, -share, direction);
    StiffState left = residual(next);
    while (!(size_of(left) < before) && share > 1e-4) {
      share /= 2;
      next = moved(z, -share, direction);
      left = residual(next);
    }
    if (!(size_of(left) < before)) {
      break;
    }
    z = std::move(next);
    r = std::move(left);
  }
  // Rounding of a stiff rate leaves a residual that no step lessens.
  if (size_of(r) <= 1e-9 * (1 + size_of(z))) {
    return z;
  }
  return StiffState(z.size(), std::numeric_limits<double>::quiet_NaN());
}

StiffState implicit_euler(const StiffSystem& system, const StiffState& y, double h) {
  const auto residual = [&](const StiffState& z) {
    return moved(moved(z, -1, y), -h, system.rate(z));
  };
  return newton_root(residual, y);
}

StiffState implicit_midpoint(const StiffSystem& system, const StiffState& y, double h) {
  const auto residual = [&](const StiffState& z) {
    StiffState middle = moved(y, 1, z);
    for (double& x : middle) {
      x /= 2;
    }
    return moved(moved(z, -1, y), -h, system.rate(middle));
  };
  return newton_root(residual, y);
}

StiffState trapezoid(const StiffSystem& system, const StiffState& y, double h) {
  const StiffState half = moved(y, h / 2, system.rate(y));
  const auto residual = [&](const StiffState& z) {
    return moved(moved(z, -1, half), -h / 2, system.rate(z));
  };
  return newton_root(residual, y);
}

}  // namespace

const std::vector<StiffMethod>& stiff_methods() {
  static const std::vector<StiffMethod> methods{
      {"explicit Euler", false, false, explicit_euler},
      {"semi-implicit Euler", false, true, semi_implicit_euler},
      {"velocity Verlet", false, true, velocity_verlet},
      {"RK4", false, false, runge_kutta_4},
      {"implicit Euler", true, false, implicit_euler},
      {"implicit midpoint", true, false, implicit_midpoint},
      {"trapezoid", true, false, trapezoid}};
  return methods;
}

}  // namespace poolhall::bench
