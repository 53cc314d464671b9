// A double that counts what is done with it, to count the operations of an algorithm that is a
// template on its number type. One count for the program: not for several threads.
//
//   const OperationCount before = Counted::count();
//   EventLoop<Counted> loop(table, materials); ...
//   (Counted::count() - before).total();
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace poolhall::bench {

struct OperationCount {
  std::uint64_t additions = 0;  // and subtractions
  std::uint64_t multiplications = 0;
  std::uint64_t divisions = 0;
  std::uint64_t roots = 0;
  std::uint64_t comparisons = 0;

  [[nodiscard]] std::uint64_t total() const {
    return additions + multiplications + divisions + roots + comparisons;
  }
  friend OperationCount operator-(const OperationCount& p, const OperationCount& q) {
    return {p.additions - q.additions, p.multiplications - q.multiplications,
            p.divisions - q.divisions, p.roots - q.roots, p.comparisons - q.comparisons};
  }
};

// Changes of sign and conversions are not counted.
class Counted {
 public:
  constexpr Counted() = default;
  constexpr Counted(double value) : value_(value) {}  // NOLINT: as numbers convert

  [[nodiscard]] static OperationCount count() { return counted; }

  explicit constexpr operator double() const { return value_; }
  explicit constexpr operator long double() const { return value_; }
  explicit constexpr operator int() const { return static_cast<int>(value_); }

  friend constexpr Counted operator+(const Counted& p, const Counted& q) {
    add(&OperationCount::additions);
    return p.value_ + q.value_;
  }
  friend constexpr Counted operator-(const Counted& p, const Counted& q) {
    add(&OperationCount::additions);
    return p.value_ - q.value_;
  }
  friend constexpr Counted operator*(const Counted& p, const Counted& q) {
    add(&OperationCount::multiplications);
    return p.value_ * q.value_;
  }
  friend constexpr Counted operator/(const Counted& p, const Counted& q) {
    add(&OperationCount::divisions);
    return p.value_ / q.value_;
  }
  friend constexpr Counted operator-(const Counted& p) { return -p.value_; }
  constexpr Counted& operator+=(const Counted& q) { return *this = *this + q; }
  constexpr Counted& operator-=(const Counted& q) { return *this = *this - q; }
  constexpr Counted& operator*=(const Counted& q) { return *this = *this * q; }
  constexpr Counted& operator/=(const Counted& q) { return *this = *this / q; }

  friend constexpr bool operator==(const Counted& p, const Counted& q) {
    add(&OperationCount::comparisons);
    return p.value_ == q.value_;
  }
  friend constexpr std::partial_ordering operator<=>(const Counted& p, const Counted& q) {
    add(&OperationCount::comparisons);
    return p.value_ <=> q.value_;
  }

  friend Counted sqrt(const Counted& p) {
    add(&OperationCount::roots);
    return std::sqrt(p.value_);
  }
  friend Counted abs(const Counted& p) { return std::abs(p.value_); }
  friend Counted copysign(const Counted& p, const Counted& q) {
    return std::copysign(p.value_, q.value_);
  }
  friend Counted frexp(const Counted& p, int* exponent) { return std::frexp(p.value_, exponent); }
  friend Counted ldexp(const Counted& p, int exponent) { return std::ldexp(p.value_, exponent); }

 private:
  // The compiler's own arithmetic is nobody's work.
  static constexpr void add(std::uint64_t OperationCount::*kind) {
    if (!std::is_constant_evaluated()) {
      ++(counted.*kind);
    }
  }

  double value_ = 0;
  static inline OperationCount counted{};
};

}  // namespace poolhall::bench

template <>
class std::numeric_limits<poolhall::bench::Counted> : public std::numeric_limits<double> {
  using Number = poolhall::bench::Counted;

 public:
  static constexpr Number min() { return std::numeric_limits<double>::min(); }
  static constexpr Number max() { return std::numeric_limits<double>::max(); }
  static constexpr Number lowest() { return std::numeric_limits<double>::lowest(); }
  static constexpr Number epsilon() { return std::numeric_limits<double>::epsilon(); }
  static constexpr Number infinity() { return std::numeric_limits<double>::infinity(); }
};
