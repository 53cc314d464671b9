// The course of one impact of a ball between nose and cloth, over the normal impulse: adaptive
// steps, and exact ends of compression, restitution, slipping and sticking.
//
//   PressedImpact<double> impact(contacts, velocity, spin, restitution);
//   if (impact.run()) use(impact.state());
#pragma once

#include <cstddef>
#include <limits>

#include "physics/nose_and_cloth.hpp"

namespace poolhall::physics {

// Units: the speed into the cushion is 1 at the start, the mass 1; `spin` is R w.
template <class Real>
class PressedImpact {
 public:
  PressedImpact(const NoseAndCloth<Real>& contacts, const Vec2<Real>& velocity,
                const Vec3<Real>& spin, const Real& restitution)
      : contacts_(contacts),
        y_(contacts.state_of(velocity, spin)),
        restitution_(restitution),
        precision_(few_last_places()),
        slip_floor_(precision_ * speed()),
        cone_resolution_(square_root(precision_) / Real(64)) {
    // A rolling ball has no slip at the cloth, but for rounding (physics.md 7).
    end_slip_below(pressed::cloth_slip, Real(1e-13) * speed());
    end_slip_below(pressed::nose_slip, slip_floor_);
    choose_grips();
  }

  // False if the bound on the number of steps was met before the end.
  [[nodiscard]] bool run() {
    const auto speed_left = [this] { return y_[pressed::vx]; };
    while (speed_left() > precision_) {
      if (!advance([](const PressedState<Real>& y) { return y[pressed::vx]; }, precision_)) {
        return false;
      }
    }
    const Real stored = y_[pressed::work];
    const Real kept = (Real(1) - restitution_ * restitution_) * stored;
    const Real enough = precision_ * stored;
    const auto work_left = [&kept](const PressedState<Real>& y) {
      return Real(y[pressed::work] - kept);
    };
    y_[pressed::vx] = Real(0);
    while (work_left(y_) > enough && !is_wedged()) {
      if (!advance(work_left, enough))
        return false;
    }
    return true;
  }

  [[nodiscard]] const PressedState<Real>& state() const { return y_; }

 private:
  static constexpr int step_limit = 20000;
  static constexpr int attempt_limit = 500;
  static constexpr int onset_iterations = 500;
  static constexpr bool is_wide =
      !std::numeric_limits<Real>::is_specialized || std::numeric_limits<Real>::digits > 64;
  static constexpr std::size_t columns = is_wide ? 14 : 6;

  // A few units in the last place; of the widest types 1e-38 is enough.
  [[nodiscard]] static Real few_last_places() {
    Real unit(1);
    while (Real(1) + unit / Real(2) != Real(1) && unit > Real(1e-38))
      unit = unit / Real(2);
    return Real(4) * unit;
  }

  [[nodiscard]] Real speed() const {
    Real sum(0);
    for (std::size_t i = pressed::vx; i < pressed::work; ++i)
      sum = sum + absolute(y_[i]);
    return sum;
  }

  void set_slip(std::size_t contact, const Vec2<Real>& slip) {
    y_[contact] = slip.x;
    y_[contact + 1] = slip.y;
  }

  [[nodiscard]] bool has_slip(std::size_t contact) const {
    return y_[contact] != Real(0) || y_[contact + 1] != Real(0);
  }

  void end_slip_below(std::size_t contact, const Real& bound) {
    const Vec2<Real> slip = slip_at(y_, contact);
    if (dot(slip, slip) <= bound * bound)
      set_slip(contact, {});
  }

  // Nothing moves the ball back out although the nose presses.
  [[nodiscard]] bool is_wedged() const {
    return y_[pressed::vx] > -precision_ && contacts_.rate(y_, grips_)[pressed::vx] > -precision_;
  }

  // One accepted step, at most to where `left` falls to `enough`.
  template <class Left>
  [[nodiscard]] bool advance(const Left& left, const Real& enough) {
    if (++steps_ > step_limit)
      return false;
    const auto rate = [this](const PressedState<Real>& y) { return contacts_.rate(y, grips_); };
    const Real tolerance = Real(16) * precision_;
    const Real before = left(y_);
    Real h = before_slip_ends(rate(y_));
    for (int i = 0; i < attempt_limit; ++i) {
      const auto step = extrapolated_step<columns>(rate, y_, h);
      const Real after = left(step.end);
      if (!(step.error <= tolerance) && h > slip_floor_) {
        h = h / Real(2);
        control_ = h;
      } else if (after < -enough) {
        const Real secant = h * before / (before - after);
        h = secant < h ? secant : Real(h / Real(2));
      } else if (h > cone_resolution_ && !is_within_cones(step.end)) {
        h = h / Real(2);
      } else {
        const Real doubled = h + h;
        if (step.error <= tolerance / Real(4096) && doubled > control_)
          control_ = doubled;
        accept(step.end);
        return true;
      }
    }
    return false;
  }

  // The step that error control asks for, but nine tenths of the way to the end of a slip:
  // friction turns there within no time, so that a slip is followed down to its last places.
  [[nodiscard]] Real before_slip_ends(const PressedState<Real>& slope) const {
    Real h = control_;
    for (const std::size_t contact :
         {std::size_t{pressed::nose_slip}, std::size_t{pressed::cloth_slip}}) {
      const Vec2<Real> slip = slip_at(y_, contact);
      const Real falling = -dot(slip, slip_at(slope, contact));
      if (!(falling > Real(0)))
        continue;
      const Real bound = Real(0.9) * dot(slip, slip) / falling;
      if (bound < h)
        h = bound;
    }
    return h;
  }

  [[nodiscard]] bool is_within_cones(const PressedState<Real>& y) const {
    return contacts_.is_within_cones(contacts_.forces(y, grips_), grips_);
  }

  void accept(const PressedState<Real>& end) {
    const Grips grips = grips_;
    const PressedState<Real> slope = contacts_.rate(end, grips);
    y_ = end;
    const bool nose_ended = grips.nose == Grip::slips && has_ended(pressed::nose_slip, slope);
    const bool cloth_ended = grips.cloth == Grip::slips && has_ended(pressed::cloth_slip, slope);
    if (nose_ended)
      set_slip(pressed::nose_slip, {});
    if (cloth_ended)
      set_slip(pressed::cloth_slip, {});
    if (nose_ended || cloth_ended || !is_within_cones(y_))
      choose_grips();
  }

  [[nodiscard]] bool has_ended(std::size_t contact, const PressedState<Real>& slope) const {
    const Vec2<Real> slip = slip_at(y_, contact);
    return dot(slip, slip) <= slip_floor_ * slip_floor_ &&
           dot(slip, slip_at(slope, contact)) <= Real(0);
  }

  // A contact without slip sticks if the friction that this needs lies in its cone; the first
  // combination that holds together is taken, sticking first.
  void choose_grips() {
    const bool nose_moves = has_slip(pressed::nose_slip);
    const bool cloth_moves = has_slip(pressed::cloth_slip);
    for (const Grips& grips : {Grips{Grip::sticks, Grip::sticks}, Grips{Grip::sticks, Grip::slips},
                               Grips{Grip::slips, Grip::sticks}, Grips{Grip::slips, Grip::slips}}) {
      if (nose_moves && grips.nose == Grip::sticks)
        continue;
      if (cloth_moves && grips.cloth == Grip::sticks)
        continue;
      const Onset onset = onset_of(grips);
      if (!contacts_.is_within_cones(contacts_.forces(onset.nose, onset.cloth, grips), grips)) {
        continue;
      }
      grips_ = grips;
      const Real tiny = slip_floor_ / Real(64);
      if (!nose_moves && grips.nose == Grip::slips)
        set_slip(pressed::nose_slip, tiny * onset.nose);
      if (!cloth_moves && grips.cloth == Grip::slips) {
        set_slip(pressed::cloth_slip, tiny * onset.cloth);
      }
      return;
    }
  }

  // Directions of slip, also of one that is about to begin.
  struct Onset {
    Vec2<Real> nose{};
    Vec2<Real> cloth{};
  };

  // A slip begins in the direction d in which it is driven against the friction along -d: the
  // fixed point of d <- unit(k d + rate(d)), which contracts for k of the size of the friction.
  [[nodiscard]] Onset onset_of(const Grips& grips) const {
    Onset onset{unit_or_zero(slip_at(y_, pressed::nose_slip)),
                unit_or_zero(slip_at(y_, pressed::cloth_slip))};
    const bool nose_begins = grips.nose == Grip::slips && !has_slip(pressed::nose_slip);
    const bool cloth_begins = grips.cloth == Grip::slips && !has_slip(pressed::cloth_slip);
    if (!nose_begins && !cloth_begins)
      return onset;
    for (int i = 0; i < onset_iterations; ++i) {
      const PressedForces<Real> f = contacts_.forces(onset.nose, onset.cloth, grips);
      const Onset last = onset;
      if (nose_begins) {
        const Real k = Real(4) * contacts_.nose_friction();
        onset.nose = unit_or_zero(k * last.nose + contacts_.nose_slip_rate(f));
      }
      if (cloth_begins) {
        const Real k = Real(4) * contacts_.cloth_friction() * f.cloth_normal;
        onset.cloth = unit_or_zero(k * last.cloth + contacts_.cloth_slip_rate(f));
      }
      if (onset.nose == last.nose && onset.cloth == last.cloth)
        break;
    }
    return onset;
  }

  NoseAndCloth<Real> contacts_;
  PressedState<Real> y_;
  Real restitution_;
  Real precision_;
  Real slip_floor_;
  Real cone_resolution_;
  Real control_{0.25};
  Grips grips_{};
  int steps_ = 0;
};

}  // namespace poolhall::physics
