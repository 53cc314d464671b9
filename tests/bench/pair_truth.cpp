#include "tests/bench/pair_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/reference/polynomial_roots.hpp"

namespace poolhall::bench {

namespace {

using physics::Vec2;
using physics::reference::Number;

template <class Real>
struct Relative {
  Vec2<Real> d, v, a;
};

template <class Real>
Vec2<Real> difference(const Vec2<double>& to, const Vec2<double>& from) {
  return {Real(to.x) - Real(from.x), Real(to.y) - Real(from.y)};
}

template <class Real>
Relative<Real> relative(const DiscPair& p) {
  return {difference<Real>(p.second.position, p.first.position),
          difference<Real>(p.second.velocity, p.first.velocity),
          difference<Real>(p.second.acceleration, p.first.acceleration)};
}

// |d + v t + a t^2 / 2|^2 - (2R)^2 by powers of t, and the sums of absolute terms.
template <class Real>
struct Gap {
  std::array<Real, 5> c{};
  std::array<Real, 5> size{};
};

template <class Real>
Gap<Real> expanded_gap(const DiscPair& pair) {
  using std::abs;
  const auto [d, v, a] = relative<Real>(pair);
  const Real reach = 2 * Real(pair.radius);
  const auto sum = [](const Vec2<Real>& p, const Vec2<Real>& q) {
    return Real(abs(Real(p.x * q.x)) + abs(Real(p.y * q.y)));
  };
  return {
      {dot(d, d) - reach * reach, 2 * dot(d, v), dot(v, v) + dot(d, a), dot(v, a), dot(a, a) / 4},
      {dot(d, d) + reach * reach, 2 * sum(d, v), dot(v, v) + sum(d, a), sum(v, a), dot(a, a) / 4}};
}

// The gap's derivatives, each isolated between the roots of the next. A sign that rounding could
// have made leaves the pair undecided.
template <class Real>
class Isolation {
 public:
  explicit Isolation(const DiscPair& pair) : end_(pair.horizon) {
    derivatives_[0] = expanded_gap<Real>(pair);
    for (std::size_t k = 1; k < derivatives_.size(); ++k) {
      for (std::size_t i = 0; i + k < 5; ++i) {
        const Real factor(static_cast<int>(i + 1));
        derivatives_[k].c[i] = derivatives_[k - 1].c[i + 1] * factor;
        derivatives_[k].size[i] = derivatives_[k - 1].size[i + 1] * factor;
      }
    }
  }

  [[nodiscard]] std::optional<PairTruth> contact() {
    std::vector<Real> nodes = roots(1);
    nodes.insert(nodes.begin(), Real(0));
    nodes.push_back(end_);
    PairTruth found;
    for (std::size_t i = 0; decided_ && i + 1 < nodes.size(); ++i) {
      const Real &from = nodes[i], &until = nodes[i + 1];
      if (is_zero(1) || sign(1, from + (until - from) / 2) >= 0) {
        continue;
      }
      const int at_from = sign(0, from);
      if (at_from > 0 && sign(0, until) > 0) {
        continue;
      }
      const Real t = at_from < 0 ? from : root(0, from, until);
      found = {true, Quad(t), static_cast<long double>(from), static_cast<long double>(until)};
      break;
    }
    return decided_ ? std::optional(found) : std::nullopt;
  }

 private:
  [[nodiscard]] Real value(std::size_t k, const Real& t) const {
    Real sum(0);
    for (std::size_t i = 5 - k; i-- > 0;) {
      sum = sum * t + derivatives_[k].c[i];
    }
    return sum;
  }

  // What rounding may have made of it: each term passes fewer than 32 roundings, as in the
  // coefficients' forming, scaling and summing; the roots that are put in move it by as much again.
  [[nodiscard]] Real doubt(std::size_t k, const Real& t) const {
    Real sum(0);
    for (std::size_t i = 5 - k; i-- > 0;) {
      sum = sum * t + derivatives_[k].size[i];
    }
    return 64 * std::numeric_limits<Real>::epsilon() * sum;
  }

  // All its terms are exact zeros.
  [[nodiscard]] bool is_zero(std::size_t k) const {
    return std::all_of(derivatives_[k].size.begin(), derivatives_[k].size.end(),
                       [](const Real& size) { return size == 0; });
  }

  // At 0 the sign just after it, where leading terms are exact zeros.
  [[nodiscard]] int sign(std::size_t k, const Real& t) {
    if (t == 0) {
      while (k < 4 && derivatives_[k].size[0] == 0) {
        ++k;
      }
    }
    const Real here = value(k, t), margin = doubt(k, t);
    if (here > margin) {
      return 1;
    }
    if (here < -margin) {
      return -1;
    }
    decided_ = false;
    return 0;
  }

  [[nodiscard]] std::vector<Real> roots(std::size_t k) {
    std::vector<Real> found;
    if (k > 3 || is_zero(k)) {
      return found;
    }
    std::vector<Real> nodes = roots(k + 1);
    nodes.push_back(end_);
    Real from(0);
    int before = sign(k, from);
    for (const Real& node : nodes) {
      const int here = sign(k, node);
      if (!decided_) {
        return found;
      }
      if (here != before) {
        found.push_back(root(k, from, node));
      }
      from = node;
      before = here;
    }
    return found;
  }

  // The root of a monotone stretch, by Newton's steps inside a bracket that halves where they fail.
  [[nodiscard]] Real root(std::size_t k, Real low, Real high) const {
    using std::abs;
    const bool rises = value(k, high) > 0;
    Real t = low + (high - low) / 2;
    for (int i = 0; i < 2000; ++i) {
      const Real here = value(k, t);
      ((here > 0) == rises ? high : low) = t;
      const Real slope = value(k + 1, t);
      Real next = slope == 0 ? low : Real(t - here / slope);
      if (!(next > low && next < high)) {
        next = low + (high - low) / 2;
      }
      const Real step = abs(Real(next - t));
      t = next;
      if (step <= 2 * std::numeric_limits<Real>::epsilon() * t || next <= low || next >= high) {
        break;
      }
    }
    return t;
  }

  Real end_;
  std::array<Gap<Real>, 5> derivatives_;
  bool decided_ = true;
};

PairTruth reference_contact(const DiscPair& pair) {
  const Gap<Number> gap = expanded_gap<Number>(pair);
  const std::vector<physics::reference::Fall> falls =
      physics::reference::falls({gap.c.begin(), gap.c.end()}, Number(pair.horizon));
  PairTruth truth;
  truth.decided_by = DecidedBy::bits_332;
  if (!falls.empty()) {
    truth.contact = true;
    truth.t = falls.front().t.convert_to<Quad>();
    truth.from = falls.front().from.convert_to<long double>();
    truth.until = falls.front().until.convert_to<long double>();
  }
  return truth;
}

// Newton's steps from a root of 64 bits to one of 113, of the gap or, where it is a maximum below
// zero, of its slope; none where they do not settle.
std::optional<Quad> refined(const DiscPair& pair, const PairTruth& rough) {
  if (rough.t == 0) {
    return rough.t;
  }
  const Relative<Quad> r = relative<Quad>(pair);
  const Quad reach = 2 * Quad(pair.radius);
  const bool at_maximum = rough.t == Quad(rough.from);
  Quad t = rough.t;
  for (int i = 0; i < 5; ++i) {
    const Vec2<Quad> v = r.v + t * r.a;
    const Vec2<Quad> d = r.d + Quad(t / 2) * (r.v + v);
    const Quad half_slope = dot(d, v);
    const Quad step = at_maximum ? Quad(half_slope / (dot(v, v) + dot(d, r.a)))
                                 : Quad((dot(d, d) - reach * reach) / (2 * half_slope));
    t -= step;
    if (abs(step) <= abs(t) * Quad("1e-24")) {
      return t;
    }
  }
  return std::nullopt;
}

double moved(double x, double towards, int ulps) {
  for (int i = 0; i < ulps && towards != 0; ++i) {
    x = std::nextafter(x, towards > 0 ? INFINITY : -INFINITY);
  }
  return x;
}

// Both ends of a difference, each a little, so that the difference grows along `towards`.
void spread(Vec2<double>& first, Vec2<double>& second, const Vec2<long double>& towards, int ulps) {
  const auto x = static_cast<double>(towards.x), y = static_cast<double>(towards.y);
  first = {moved(first.x, -x, ulps), moved(first.y, -y, ulps)};
  second = {moved(second.x, x, ulps), moved(second.y, y, ulps)};
}

}  // namespace

PairTruth true_contact(const DiscPair& pair) {
  if (std::optional<PairTruth> truth = Isolation<long double>(pair).contact()) {
    if (!truth->contact) {
      return *truth;
    }
    if (const std::optional<Quad> t = refined(pair, *truth)) {
      truth->t = *t;
      return *truth;
    }
  }
  if (std::optional<PairTruth> truth = Isolation<Quad>(pair).contact()) {
    truth->decided_by = DecidedBy::bits_113;
    return *truth;
  }
  return reference_contact(pair);
}

bool agrees(const PairTruth& truth, const std::optional<long double>& answer) {
  if (truth.contact != answer.has_value()) {
    return false;
  }
  constexpr long double slack = 1e-12L;  // s
  return !answer || (*answer >= truth.from - slack && *answer <= truth.until + slack);
}

long double gap_in_metres(const DiscPair& pair, long double t) {
  const auto [d, v, a] = relative<long double>(pair);
  return length(d + t * (v + (t / 2) * a)) - 2 * static_cast<long double>(pair.radius);
}

bool is_marginal(const DiscPair& pair, const std::optional<long double>& answer, int ulps) {
  const long double t = answer ? *answer : true_contact(pair).t.convert_to<long double>();
  const auto [d, v, a] = relative<long double>(pair);
  const Vec2<long double> velocity = v + t * a;
  const Vec2<long double> distance = d + t * (v + (t / 2) * a);
  // What helps most comes first: together where a contact was answered, else apart. Places turned
  // by the velocity tip over what is nearly at a right angle to it.
  const long double likely = answer ? -1 : 1;
  for (const Vec2<long double>& place : {distance, velocity}) {
    for (const long double way : {likely, -likely}) {
      for (const long double speed_way : {likely, -likely}) {
        for (const double time_way : {1.0, -1.0}) {
          DiscPair near = pair;
          spread(near.first.position, near.second.position, way * place, ulps);
          spread(near.first.velocity, near.second.velocity, speed_way * distance, ulps);
          spread(near.first.acceleration, near.second.acceleration, speed_way * distance, ulps);
          near.horizon = moved(near.horizon, time_way, ulps);
          if (agrees(true_contact(near), answer)) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

}  // namespace poolhall::bench
