// How far rounding has carried a ball from its true path: an estimate to first order, some ten
// operations an event. A shot of few collisions stays within some ulps; where balls meet often or
// graze, each impact multiplies what was there (a place wrong by e turns the line of centres by
// e / 2R), and the estimate says when double is not enough for this shot.
//
//   Drift<double> d;                          // given positions are exact
//   d = d.disturbed(4.0).after(0.3, 2.2);   // struck at 2 m/s, 0.3 s later
//
// Mean squares, so that errors of many roundings add as independent ones do.
#pragma once

#include <limits>

namespace poolhall::physics {

template <class Real>
struct Drift {
  Real place{};     // m^2
  Real velocity{};  // (m/s)^2

  // t seconds later, having passed through positions of about `extent` metres.
  [[nodiscard]] Drift after(const Real& t, const Real& extent) const {
    return {place + t * t * velocity + rounding(extent * extent), velocity};
  }

  // Given a velocity anew, whose square is `speed_squared`.
  [[nodiscard]] Drift disturbed(const Real& speed_squared) const {
    return {place, velocity + rounding(speed_squared)};
  }

  // After an impact whose instant is wrong by sqrt(place) / closing, where the velocity changes by
  // `change`.
  [[nodiscard]] Drift turned(const Real& closing_squared, const Real& change_squared) const {
    return {place + place * (change_squared / closing_squared), velocity};
  }

  // After an impact on something round, `reach` from centre to centre: the line of centres is wrong
  // by e (1 + w / g) / reach, where w is the relative speed and g the closing one.
  [[nodiscard]] Drift slanted(const Real& closing_squared, const Real& speed_squared,
                              const Real& reach_squared) const {
    const Real slant = Real(1) + speed_squared / closing_squared;
    return {place, velocity + place * (speed_squared / reach_squared) * slant};
  }

 private:
  // Some three roundings of half an ulp each.
  [[nodiscard]] static Real rounding(const Real& square) {
    constexpr Real ulp = std::numeric_limits<Real>::epsilon();
    return square * (ulp * ulp);
  }
};

}  // namespace poolhall::physics
