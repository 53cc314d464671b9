// The paper's way to a contact: the quartic (19) in closed form, Ferrari's reduction with Cardano's
// cubic, as it is or with its roots polished by Newton's steps on the residual of the vectors. Kept
// to be measured against detect_pair.hpp, behind the same contact rule.
//
//   std::optional<double> t = closed_form_contact(pair, horizon, Polish::no);
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/detect_pair.hpp"

namespace poolhall::physics {

enum class Polish : std::uint8_t { no, yes };

// Real parts of the roots whose imaginary part is taken for rounding, ascending.
template <class Real>
struct RealRoots {
  std::array<Real, 4> at{};
  std::size_t count = 0;
  void add(const Real& t) {
    std::size_t i = count++;
    for (; i > 0 && at[i - 1] > t; --i) {
      at[i] = at[i - 1];
    }
    at[i] = t;
  }
};

// The paper's "simple thresholding" of imaginary parts, relative to the root's size.
template <class Real>
void add_quadratic(RealRoots<Real>& roots, const Real& p, const Real& q, const Real& shift) {
  // t^2 + p t + q
  using std::abs;
  using std::sqrt;
  const Real half = -p / Real(2);
  const Real discriminant = half * half - q;
  const Real size = half * half + abs(q) + shift * shift;
  if (discriminant >= Real(0)) {
    const Real root = sqrt(discriminant);
    const Real one = half < Real(0) ? Real(half - root) : Real(half + root);
    roots.add(one + shift);
    roots.add((one != Real(0) ? Real(q / one) : Real(0)) + shift);
  } else if (-discriminant <= Real(1e-14) * size) {
    roots.add(half + shift);
    roots.add(half + shift);
  }
}

// Cube root by Newton's steps from a power of two near it; sqrt and the four operations only.
template <class Real>
[[nodiscard]] Real cube_root(const Real& x) {
  using std::abs;
  using std::frexp;
  using std::ldexp;
  if (x == Real(0)) {
    return x;
  }
  int exponent = 0;
  Real mantissa = frexp(Real(abs(x)), &exponent);
  const int whole = exponent >= 0 ? (exponent + 2) / 3 : -((-exponent) / 3);
  mantissa = ldexp(mantissa, exponent - 3 * whole);  // in [1/8, 1)
  Real y = Real(0.35) + Real(0.67) * mantissa;
  const int steps = std::numeric_limits<Real>::digits > 64 ? 10 : 5;
  for (int i = 0; i < steps; ++i) {
    y = (y + y + mantissa / (y * y)) / Real(3);
  }
  const Real root = ldexp(y, whole);
  return x < Real(0) ? Real(-root) : root;
}

// The largest real root of y^3 + a y^2 + b y + c: Cardano where there is one, else the
// trigonometric form's largest root by Newton's steps from above, where the cubic is convex.
template <class Real>
[[nodiscard]] Real largest_cubic_root(const Real& a, const Real& b, const Real& c) {
  using std::abs;
  using std::sqrt;
  const Real third = a / Real(3);
  const Real p = b - a * third;
  const Real q = c + third * (Real(2) * third * third - b);
  const Real half = q / Real(2), part = p / Real(3);
  const Real discriminant = half * half + part * part * part;
  if (discriminant > Real(0)) {
    const Real root = sqrt(discriminant);
    const Real u = cube_root(half > Real(0) ? Real(-half - root) : Real(root - half));
    return (u != Real(0) ? Real(u - part / u) : Real(0)) - third;
  }
  // Three real roots: the largest lies in [r, 2 r], r = sqrt(-p / 3).
  const Real r = sqrt(part < Real(0) ? Real(-part) : Real(0));
  Real y = Real(2) * r;
  for (int i = 0; i < 60; ++i) {
    const Real slope = Real(3) * (y * y + part);
    if (!(slope > Real(0))) {
      break;
    }
    const Real next = y - ((y * y + p) * y + q) / slope;
    if (!(next < y) || next < r) {
      break;
    }
    y = next;
  }
  return y - third;
}

// Ferrari for t^4 + a t^3 + b t^2 + c t + d.
template <class Real>
[[nodiscard]] RealRoots<Real> monic_quartic_roots(const Real& a, const Real& b, const Real& c,
                                                  const Real& d) {
  using std::abs;
  using std::sqrt;
  const Real shift = -a / Real(4);
  const Real a2 = a * a;
  const Real p = b - Real(3) / Real(8) * a2;
  const Real q = c - a / Real(2) * (b - a2 / Real(4));
  const Real r = d + shift * (c + shift * (b + shift * Real(3) / Real(4) * a));
  RealRoots<Real> roots;
  // y^4 + p y^2 + q y + r = (y^2 + m)^2 - ... with the resolvent in 2 m - p.
  const Real z = largest_cubic_root(Real(Real(2) * p), Real(p * p - Real(4) * r), Real(-q * q));
  if (!(z > Real(0))) {
    const Real discriminant = p * p - Real(4) * r;
    if (discriminant >= Real(0)) {
      const Real root = sqrt(discriminant);
      for (const Real& square : {Real((-p + root) / Real(2)), Real((-p - root) / Real(2))}) {
        if (square >= Real(0)) {
          roots.add(shift + sqrt(square));
          roots.add(shift - sqrt(square));
        }
      }
    }
    return roots;
  }
  const Real s = sqrt(z);
  const Real sum = (p + z) / Real(2);
  // |q| / (2 s) = sqrt(sum^2 - r). Where the quartic is biquadratic, as for a straight roll at a
  // resting ball, q and z vanish together and only the root keeps its digits.
  const Real square = sum * sum - r;
  const bool is_stable = square + square >= sum * sum + Real(abs(r));
  const Real size = is_stable ? Real(sqrt(square)) : Real(abs(q) / (s + s));
  const Real difference = q < Real(0) ? Real(-size) : size;
  add_quadratic(roots, s, Real(sum - difference), shift);
  add_quadratic(roots, Real(-s), Real(sum + difference), shift);
  return roots;
}

template <class Real>
[[nodiscard]] RealRoots<Real> quartic_roots(const GapPolynomial<Real>& c) {
  if (c.c4 > Real(0)) {
    return monic_quartic_roots(Real(c.c3 / c.c4), Real(c.c2 / c.c4), Real(c.c1 / c.c4),
                               Real(c.c0 / c.c4));
  }
  RealRoots<Real> roots;
  // Equal accelerations leave a quadratic: c3 vanishes with c4.
  const auto two = quadratic_roots(c.c0, c.c1, c.c2);
  if (two.count > 0) {
    roots.add(two.first);
    roots.add(two.second);
  }
  return roots;
}

template <class Real>
[[nodiscard]] Real polished(const PairMotion<Real>& p, Real t) {
  for (int i = 0; i < 3; ++i) {
    const Real slope = Real(2) * p.half_slope(t);
    if (slope == Real(0)) {
      return t;
    }
    t -= p.gap(t) / slope;
  }
  return t;
}

// The first root from above in [0, T]; discs that touch and approach meet now.
template <class Real>
[[nodiscard]] std::optional<Real> closed_form_contact(const PairMotion<Real>& p, const Real& T,
                                                      Polish polish) {
  const GapPolynomial<Real> c = gap_polynomial(p);
  const bool approaching = c.c1 < Real(0) || (c.c1 == Real(0) && c.c2 < Real(0));
  if (c.c0 <= Real(0) && approaching) {
    return Real(0);
  }
  const RealRoots<Real> roots = quartic_roots(c);
  for (std::size_t i = 0; i < roots.count; ++i) {
    const Real t = polish == Polish::yes ? polished(p, roots.at[i]) : roots.at[i];
    if (t >= Real(0) && t <= T && p.half_slope(t) < Real(0)) {
      return t;
    }
  }
  return std::nullopt;
}

}  // namespace poolhall::physics
