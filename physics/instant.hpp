// A point in time as an unevaluated sum of two numbers, so that a shot that lasts hours is timed
// as finely as one that lasts a second: an ulp of 1e4 s alone would be 2e-12 s.
//
//   Instant<double> hit = later(now, 0.25);
//   double waited = hit - now;  // exactly 0.25 however late `now` is
#pragma once

#include <limits>

namespace poolhall::physics {

// Beyond this many seconds nothing happens any more. The fourth power must not overflow.
template <class Real>
[[nodiscard]] constexpr Real forever() {
  return std::numeric_limits<Real>::max_exponent > 200 ? Real(1e60) : Real(1e8);
}

template <class Real>
struct Instant {
  Real high{};  // s, rounded
  Real low{};   // s, what the rounding left over

  friend constexpr bool operator==(const Instant&, const Instant&) = default;
  friend constexpr bool operator<(const Instant& p, const Instant& q) {
    return p.high < q.high || (p.high == q.high && p.low < q.low);
  }
  friend constexpr bool operator<=(const Instant& p, const Instant& q) { return !(q < p); }
  friend constexpr Real operator-(const Instant& p, const Instant& q) {
    return (p.high - q.high) + (p.low - q.low);
  }
};

template <class Real>
[[nodiscard]] constexpr Instant<Real> never() {
  return {forever<Real>(), Real(0)};
}

// Knuth's two-sum keeps what the rounding of `high` loses (TAOCP 2, 4.2.2, theorem B).
template <class Real>
[[nodiscard]] constexpr Instant<Real> later(const Instant<Real>& from, const Real& by) {
  const Real sum = from.high + by;
  const Real virtual_by = sum - from.high;
  const Real lost = (from.high - (sum - virtual_by)) + (by - virtual_by) + from.low;
  const Real high = sum + lost;
  return {high, lost - (high - sum)};
}

// The same by a wider number: what `Real` cannot hold of it goes to `low`.
template <class Real, class Wider>
[[nodiscard]] constexpr Instant<Real> later(const Instant<Real>& from, const Wider& by) {
  const Real rounded = static_cast<Real>(by);
  Instant<Real> sum = later(from, rounded);
  sum.low += static_cast<Real>(by - Wider(rounded));
  return later(Instant<Real>{sum.high, Real(0)}, sum.low);
}

}  // namespace poolhall::physics
