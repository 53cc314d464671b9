// Vectors of the table frame: x across the table, y along it, z up. Plain values, no units of
// their own.
#pragma once

#include <cmath>
#include <limits>

namespace poolhall::physics {

template <class Real>
struct Vec2 {
  Real x{};
  Real y{};

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

template <class Real>
struct Vec3 {
  Real x{};
  Real y{};
  Real z{};

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

template <class Real>
[[nodiscard]] constexpr Vec2<Real> operator+(const Vec2<Real>& p, const Vec2<Real>& q) {
  return {p.x + q.x, p.y + q.y};
}
template <class Real>
[[nodiscard]] constexpr Vec2<Real> operator-(const Vec2<Real>& p, const Vec2<Real>& q) {
  return {p.x - q.x, p.y - q.y};
}
template <class Real>
[[nodiscard]] constexpr Vec2<Real> operator*(const Real& k, const Vec2<Real>& p) {
  return {k * p.x, k * p.y};
}
template <class Real>
[[nodiscard]] constexpr Real dot(const Vec2<Real>& p, const Vec2<Real>& q) {
  return p.x * q.x + p.y * q.y;
}

template <class Real>
[[nodiscard]] constexpr Vec3<Real> operator+(const Vec3<Real>& p, const Vec3<Real>& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> operator-(const Vec3<Real>& p, const Vec3<Real>& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> operator*(const Real& k, const Vec3<Real>& p) {
  return {k * p.x, k * p.y, k * p.z};
}
template <class Real>
[[nodiscard]] constexpr Real dot(const Vec3<Real>& p, const Vec3<Real>& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> cross(const Vec3<Real>& p, const Vec3<Real>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

// |p|. Lengths whose square would underflow or overflow are scaled first.
template <class Real>
[[nodiscard]] Real length(const Vec2<Real>& p) {
  using std::abs;
  using std::sqrt;
  const Real square = dot(p, p);
  // The squares of doubles are far inside the range of an 80-bit number, and of wider ones.
  if constexpr (std::numeric_limits<Real>::min_exponent < -8 * 1024) {
    return sqrt(square);
  }
  if (square > std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon() &&
      square < std::numeric_limits<Real>::max()) {
    return sqrt(square);
  }
  const Real larger = abs(p.x) > abs(p.y) ? abs(p.x) : abs(p.y);
  if (!(larger > Real(0))) {
    return Real(0);
  }
  const Vec2<Real> scaled{p.x / larger, p.y / larger};
  return larger * sqrt(dot(scaled, scaled));
}
template <class Real>
[[nodiscard]] Real length(const Vec3<Real>& p) {
  return length(Vec2<Real>{length(Vec2<Real>{p.x, p.y}), p.z});
}

}  // namespace poolhall::physics
