#include "physics/reference/polynomial_roots.hpp"

#include <algorithm>
#include <limits>

namespace poolhall::physics::reference {

namespace {

int sign(const Number& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// The root of p in (low, high), where p is monotone and its signs at the ends differ. Newton's
// step where it stays inside the bracket, bisection where it does not.
Number root_between(const Polynomial& p, const Polynomial& slope, Number low, Number high) {
  const int sign_low = sign(value(p, low));
  Number t = (low + high) / 2;
  for (int i = 0; i < 2000; ++i) {
    const Number here = value(p, t);
    if (here == 0) {
      return t;
    }
    (sign(here) == sign_low ? low : high) = t;
    const Number tangent = value(slope, t);
    Number next = tangent == 0 ? low : Number(t - here / tangent);
    if (!(next > low && next < high)) {
      next = (low + high) / 2;
    }
    const Number step = abs(next - t);
    t = next;
    if (step <= abs(t) * std::numeric_limits<Number>::epsilon() || next == low || next == high) {
      return t;
    }
  }
  return t;
}

// Whether the first derivative that is not zero at 0 is negative.
bool falls_at_zero(const Polynomial& p) {
  for (Polynomial d = derivative(p); !d.empty(); d = derivative(d)) {
    if (d[0] != 0) {
      return d[0] < 0;
    }
  }
  return false;
}

}  // namespace

Number value(const Polynomial& p, const Number& t) {
  Number sum = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) {
    sum = sum * t + *c;
  }
  return sum;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial slope;
  for (std::size_t i = 1; i < p.size(); ++i) {
    slope.push_back(p[i] * static_cast<unsigned>(i));
  }
  return slope;
}

std::vector<Number> sign_changes(const Polynomial& p, const Number& end) {
  std::vector<Number> roots;
  if (p.size() < 2) {
    return roots;
  }
  const Polynomial slope = derivative(p);
  std::vector<Number> nodes = sign_changes(slope, end);
  nodes.insert(nodes.begin(), Number(0));
  nodes.push_back(end);
  int before = 0;  // sign on the last interval before the node
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int here = sign(value(p, nodes[i]));
    if (here == 0) {
      // The node is a root itself; whether the sign changes shows at the next node.
      continue;
    }
    if (before != 0 && here != before) {
      const bool previous_is_root = value(p, nodes[i - 1]) == 0;
      roots.push_back(previous_is_root ? nodes[i - 1]
                                       : root_between(p, slope, nodes[i - 1], nodes[i]));
    }
    before = here;
  }
  return roots;
}

std::vector<Number> falls(const Polynomial& p, const Number& end) {
  std::vector<Number> found;
  if (value(p, Number(0)) <= 0 && falls_at_zero(p)) {
    found.push_back(0);
  }
  const std::vector<Number> nodes = sign_changes(derivative(p), end);
  for (const Number& t : sign_changes(p, end)) {
    // p is monotone from t to the next critical point: a fall leads below zero.
    const auto next =
        std::find_if(nodes.begin(), nodes.end(), [&](const Number& node) { return node > t; });
    if (value(p, (t + (next == nodes.end() ? end : *next)) / 2) < 0) {
      found.push_back(t);
    }
  }
  return found;
}

}  // namespace poolhall::physics::reference
