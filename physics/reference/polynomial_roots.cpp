#include "physics/reference/polynomial_roots.hpp"

#include <algorithm>
#include <limits>

namespace poolhall::physics::reference {

namespace {

int sign(const Number& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// The same in fewer digits, where it is a root of p in (low, high) at all: to begin with.
Number first_guess(const Polynomial& p, const Number& low, const Number& high) {
  std::vector<long double> c;
  for (const Number& coefficient : p) {
    c.push_back(coefficient.convert_to<long double>());
  }
  const auto at = [&c](long double t) {
    long double sum = 0;
    for (auto k = c.rbegin(); k != c.rend(); ++k) {
      sum = sum * t + *k;
    }
    return sum;
  };
  auto left = low.convert_to<long double>();
  auto right = high.convert_to<long double>();
  const bool rises = at(right) > 0;
  for (int i = 0; i < 200; ++i) {
    const long double middle = left + (right - left) / 2;
    if (!(middle > left && middle < right)) {
      break;
    }
    ((at(middle) > 0) == rises ? right : left) = middle;
  }
  const Number guess = left + (right - left) / 2;
  return guess > low && guess < high ? guess : Number((low + high) / 2);
}

// The root of p in (low, high), where p is monotone and its signs at the ends differ. Newton's
// step where it stays inside the bracket, bisection where it does not.
Number root_between(const Polynomial& p, const Polynomial& slope, Number low, Number high) {
  // After a step this small the next would be far below the last digit.
  static const Number settled("1e-90");
  const int sign_low = sign(value(p, low));
  Number t = first_guess(p, low, high);
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
    if (step <= abs(t) * settled || next == low || next == high) {
      return t;
    }
  }
  return t;
}

// Whether p falls on (from, until), where it is monotone.
bool falls_between(const Polynomial& slope, const Number& from, const Number& until) {
  const int here = sign(value(slope, (from + until) / 2));
  // A slope may touch zero in the very middle.
  return here != 0 ? here < 0 : value(slope, (from + from + until) / 3) < 0;
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
  bool previous_is_root = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int here = sign(value(p, nodes[i]));
    // Where the node is a root itself, whether the sign changes shows at the next node.
    if (here != 0) {
      if (before != 0 && here != before) {
        roots.push_back(previous_is_root ? nodes[i - 1]
                                         : root_between(p, slope, nodes[i - 1], nodes[i]));
      }
      before = here;
    }
    previous_is_root = here == 0;
  }
  return roots;
}

std::vector<Fall> falls(const Polynomial& p, const Number& end) {
  std::vector<Fall> found;
  if (p.size() < 2) {
    return found;
  }
  const Polynomial slope = derivative(p);
  std::vector<Number> nodes = sign_changes(slope, end);
  nodes.insert(nodes.begin(), Number(0));
  nodes.push_back(end);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Number& from = nodes[i];
    const Number& until = nodes[i + 1];
    if (!falls_between(slope, from, until)) {
      continue;
    }
    if (value(p, from) <= 0) {
      found.push_back({from, from, until});
    } else if (value(p, until) < 0) {
      found.push_back({root_between(p, slope, from, until), from, until});
    }
  }
  return found;
}

}  // namespace poolhall::physics::reference
