// Elastic contact of two equal balls (Hertz): how far they compress, and how stiff they are.
// Phenolic resin: Young's modulus 5.84 GPa, Poisson's ratio 0.34.
#pragma once

#include "physics/coefficients.hpp"
#include "physics/math.hpp"

namespace poolhall::physics {

// k in F = k d^(3/2), N / m^(3/2): 4/3 E* sqrt(R*), E* = E / (2 (1 - nu^2)), R* = R / 2.
template <class Real>
[[nodiscard]] Real hertz_stiffness(const Coefficients<Real>& c) {
  const Real poisson = Real(34) / Real(100);
  const Real modulus = Real(5.84e9) / (Real(2) * (Real(1) - poisson * poisson));
  return Real(4) / Real(3) * modulus * square_root(Real(c.radius / Real(2)));
}

// Greatest compression at a closing speed of 1 m/s, m: (5 m* / (4 k))^(2/5) with m* = m / 2. At
// speed v it is v^(4/5) times that.
template <class Real>
[[nodiscard]] Real hertz_compression_at_unit_speed(const Coefficients<Real>& c) {
  const Real ratio = Real(5) * c.mass / (Real(8) * hertz_stiffness(c));
  return exponential(Real(Real(2) / Real(5) * natural_logarithm(ratio)));
}

// v^(4/5), 0 for v <= 0.
template <class Real>
[[nodiscard]] Real four_fifths_power(const Real& v) {
  return v > Real(0) ? exponential(Real(Real(4) / Real(5) * natural_logarithm(v))) : Real(0);
}

}  // namespace poolhall::physics
