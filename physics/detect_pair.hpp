// When do two balls meet? The earliest time at which their discs touch and approach, found from
// above: a receding pair never meets at t ~ 0 (Bannerman, Strobl, Formella, Poeschel 2014).
// Finds, never changes anything.
//
//   PairMotion<double> pair = pair_motion(first, second, now, reach_squared);
//   std::optional<double> t = first_contact(pair, horizon);  // s after `now`
#pragma once

#include <limits>
#include <optional>

#include "physics/lean.hpp"
#include "physics/motion.hpp"
#include "physics/roots.hpp"

namespace poolhall::physics {

// The second ball as seen from the first: d(t) = distance + velocity t + acceleration t^2 / 2.
template <class Real>
struct PairMotion {
  Vec2<Real> distance{};
  Vec2<Real> velocity{};
  Vec2<Real> acceleration{};
  Real reach_squared{};  // (2R)^2

  [[nodiscard]] Vec2<Real> distance_at(const Real& t) const {
    const Real half = t / Real(2);
    return {distance.x + t * (velocity.x + half * acceleration.x),
            distance.y + t * (velocity.y + half * acceleration.y)};
  }
  // |d|^2 - (2R)^2 and half its derivative, from the vectors: the expanded quartic (19) would lose
  // what its large terms cancel.
  [[nodiscard]] Real gap(const Real& t) const {
    const Vec2<Real> d = distance_at(t);
    return dot(d, d) - reach_squared;
  }
  [[nodiscard]] Real half_slope(const Real& t) const {
    return dot(distance_at(t), velocity + t * acceleration);
  }
  [[nodiscard]] Real half_curvature(const Real& t) const {
    const Vec2<Real> v = velocity + t * acceleration;
    return dot(v, v) + dot(distance_at(t), acceleration);
  }
};

// (19) by powers of t: c0 + c1 t + ... + c4 t^4, and the sums of their absolute terms.
template <class Real>
struct GapPolynomial {
  Real c0{}, c1{}, c2{}, c3{}, c4{};
  Real size0{}, size1{}, size2{}, size3{};
};

template <class Real>
[[nodiscard]] GapPolynomial<Real> gap_polynomial(const PairMotion<Real>& p) {
  using std::abs;
  const Vec2<Real>& d = p.distance;
  const Vec2<Real>& v = p.velocity;
  const Vec2<Real>& a = p.acceleration;
  const Real dd = dot(d, d);
  const Real vv = dot(v, v);
  const Real aa = dot(a, a);
  const Real dx_vx = d.x * v.x, dy_vy = d.y * v.y;
  const Real dx_ax = d.x * a.x, dy_ay = d.y * a.y;
  const Real vx_ax = v.x * a.x, vy_ay = v.y * a.y;
  return {dd - p.reach_squared,
          Real(2) * (dx_vx + dy_vy),
          vv + (dx_ax + dy_ay),
          vx_ax + vy_ay,
          aa / Real(4),
          dd + p.reach_squared,
          Real(2) * (abs(dx_vx) + abs(dy_vy)),
          vv + (abs(dx_ax) + abs(dy_ay)),
          abs(vx_ax) + abs(vy_ay)};
}

// The Bernstein ordinates of a polynomial on [0, T] enclose its values there (Farouki 2012). Their
// rounding error is below 16 eps times the sum of absolute terms: each term passes at most five
// roundings as it is formed, four as it is scaled and five as it is summed. The positions
// themselves are rounded before; `margin` covers that with as much again.
template <class Real>
[[nodiscard]] constexpr Real bernstein_margin() {
  return Real(32) * std::numeric_limits<Real>::epsilon();
}

// True only if the discs stay apart during all of [0, T].
template <class Real>
[[nodiscard]] bool stays_apart(const GapPolynomial<Real>& c, const Real& T) {
  const Real s1 = c.c1 * T, s2 = c.c2 * T * T, s3 = c.c3 * T * T * T, s4 = c.c4 * T * T * T * T;
  const Real margin = bernstein_margin<Real>() *
                      (c.size0 + T * (c.size1 + T * (c.size2 + T * (c.size3 + T * c.c4))));
  const Real quarter = s1 / Real(4);
  const Real sixth = s2 / Real(6);
  const Real b1 = c.c0 + quarter;
  const Real b2 = b1 + quarter + sixth;
  const Real b3 = b2 + quarter + Real(2) * sixth + s3 / Real(4);
  const Real b4 = c.c0 + s1 + s2 + s3 + s4;
  return c.c0 > margin && b1 > margin && b2 > margin && b3 > margin && b4 > margin;
}

// True only if the balls approach at no time in [0, T].
template <class Real>
[[nodiscard]] bool never_approaches(const GapPolynomial<Real>& c, const Real& T) {
  const Real s2 = Real(2) * c.c2 * T, s3 = Real(3) * c.c3 * T * T, s4 = Real(4) * c.c4 * T * T * T;
  const Real margin =
      bernstein_margin<Real>() *
      (c.size1 + T * (Real(2) * c.size2 + T * (Real(3) * c.size3 + T * (Real(4) * c.c4))));
  const Real third = s2 / Real(3);
  const Real b1 = c.c1 + third;
  const Real b2 = b1 + third + s3 / Real(3);
  const Real b3 = c.c1 + s2 + s3 + s4;
  return c.c1 > margin && b1 > margin && b2 > margin && b3 > margin;
}

// Times in (0, T) at which the gap's slope changes its sign, ascending, with 0 and T around them.
template <class Real>
struct Monotone {
  std::array<Real, 8> at{};
  int count = 0;
  void add(const Real& t) { at[static_cast<std::size_t>(count++)] = t; }
};

template <class Real>
[[nodiscard]] Monotone<Real> monotone_pieces(const PairMotion<Real>& p,
                                             const GapPolynomial<Real>& c, const Real& T) {
  // Half the second derivative: c2 + 3 c3 t + 6 c4 t^2.
  const auto bends = quadratic_roots(c.c2, Real(Real(3) * c.c3), Real(Real(6) * c.c4));
  std::array<Real, 4> ends{Real(0), T, T, T};
  std::size_t last = 0;
  for (const Real& bend : {bends.first, bends.second}) {
    if (bends.count > 0 && bend > ends[last] && bend < T) {
      ends[++last] = bend;
    }
  }
  ends[++last] = T;
  const auto slope = [&p](const Real& t) { return p.half_slope(t); };
  const auto curvature = [&p](const Real& t) { return p.half_curvature(t); };
  Monotone<Real> pieces;
  pieces.add(Real(0));
  for (std::size_t i = 0; i < last; ++i) {
    const Real left = slope(ends[i]);
    const Real right = slope(ends[i + 1]);
    if (i > 0 && left == Real(0)) {
      pieces.add(ends[i]);
    }
    if ((left < Real(0) && right > Real(0)) || (left > Real(0) && right < Real(0))) {
      pieces.add(bracketed_root<Real>(slope, curvature, ends[i], ends[i + 1]));
    }
  }
  pieces.add(T);
  return pieces;
}

// The search itself: between two critical points the gap is monotone; the first piece that falls to
// zero or below holds the contact, at its start if the discs touch there.
template <class Real>
[[nodiscard]] std::optional<Real> search_contact(const PairMotion<Real>& p,
                                                 const GapPolynomial<Real>& c, const Real& T) {
  const auto gap = [&p](const Real& t) { return p.gap(t); };
  const auto slope = [&p](const Real& t) { return Real(2) * p.half_slope(t); };
  const Monotone<Real> pieces = monotone_pieces(p, c, T);
  for (int i = 0; i + 1 < pieces.count; ++i) {
    const Real from = pieces.at[static_cast<std::size_t>(i)];
    const Real to = pieces.at[static_cast<std::size_t>(i + 1)];
    const Real middle = from + (to - from) / Real(2);
    if (!(p.half_slope(middle) < Real(0))) {
      continue;
    }
    if (gap(from) <= Real(0)) {
      return from;
    }
    const Real end = gap(to);
    if (end < Real(0)) {
      return bracketed_root<Real>(gap, slope, from, to);
    }
    // A gap that closes exactly as the piece ends: looked for, it would be found too early by as
    // much as half the digits where the balls come to a halt as they touch.
    if (end == Real(0)) {
      return to;
    }
  }
  return std::nullopt;
}

// Whether the gap is convex on all of [0, T]: the Bernstein ordinates of half its second
// derivative.
template <class Real>
[[nodiscard]] bool is_convex(const GapPolynomial<Real>& c, const Real& T) {
  const Real linear = Real(3) * c.c3 * T;
  const Real margin =
      bernstein_margin<Real>() * (c.size2 + Real(3) * T * (c.size3 + Real(2) * T * c.c4));
  return c.c2 > margin && c.c2 + linear / Real(2) > margin &&
         c.c2 + linear + Real(6) * c.c4 * T * T > margin;
}

// Where the gap is convex and falls, Newton's steps from the left never pass the first root, and
// come to the minimum if there is none. Grazes, and what takes too long, are left to the search.
template <class Real>
[[nodiscard]] std::optional<Real> convex_contact(const PairMotion<Real>& p,
                                                 const GapPolynomial<Real>& c, const Real& T) {
  const Real graze = bernstein_margin<Real>() * c.size0;
  Real t(0);
  for (int i = 0; i < 24; ++i) {
    const Vec2<Real> d = p.distance_at(t);
    const Real gap = dot(d, d) - p.reach_squared;
    const Real slope = Real(2) * dot(d, p.velocity + t * p.acceleration);
    if (!(slope < Real(0))) {
      return gap > graze ? std::nullopt : search_contact(p, c, T);
    }
    const Real step = -gap / slope;
    if (step <= Real(2) * std::numeric_limits<Real>::epsilon() * t) {
      // What is left to fall until T may be rounding: then the gap there decides.
      return -slope * (T - t) > graze ? t : search_contact(p, c, T);
    }
    t += step;
    if (t > T) {
      return std::nullopt;
    }
  }
  return search_contact(p, c, T);
}

// Whether discs that touch approach so slowly that c1 has underflowed to nothing.
template <class Real>
[[nodiscard]] bool creeps_closer(const PairMotion<Real>& p) {
  using std::abs;
  const Real size = abs(p.velocity.x) > abs(p.velocity.y) ? abs(p.velocity.x) : abs(p.velocity.y);
  return size > Real(0) &&
         dot(p.distance, Vec2<Real>{p.velocity.x / size, p.velocity.y / size}) < Real(0);
}

// The first contact in [0, T].
template <class Policy = Lean, class Real>
[[nodiscard]] std::optional<Real> first_contact(const PairMotion<Real>& p, const Real& T) {
  constexpr bool rejects = Policy::omits(Omission::clear_pairs);
  const GapPolynomial<Real> c = gap_polynomial(p);
  if (!(c.c1 < Real(0))) {
    if (c.c1 == Real(0) && c.c0 <= Real(0) && creeps_closer(p)) {
      return Real(0);
    }
    return rejects && never_approaches(c, T) ? std::nullopt : search_contact(p, c, T);
  }
  if (c.c0 <= Real(0)) {
    // Now, however soon the approach ends: the search might not tell that time from 0.
    return Real(0);
  }
  if (rejects && stays_apart(c, T)) {
    return std::nullopt;
  }
  return is_convex(c, T) ? convex_contact(p, c, T) : search_contact(p, c, T);
}

template <class Real>
[[nodiscard]] PairMotion<Real> pair_motion(const Segment<Real>& first, const Segment<Real>& second,
                                           const Instant<Real>& now, const Real& reach_squared) {
  const Real t1 = now - first.start;
  const Real t2 = now - second.start;
  return {position_at(second, t2) - position_at(first, t1),
          velocity_at(second, t2) - velocity_at(first, t1),
          second.acceleration - first.acceleration, reach_squared};
}

template <class Real>
[[nodiscard]] PairMotion<Real> pair_motion(const Segment<Real>& first, const Segment<Real>& second,
                                           const Instant<Real>& now, const Coefficients<Real>& c) {
  return pair_motion(first, second, now, c.reach_squared);
}

}  // namespace poolhall::physics
