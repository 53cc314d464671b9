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
        cone_resolution_(square_root(precision_) / Real(64)),
        final_step_(square_root(precision_)) {
    // A rolling ball has no slip at the cloth, but for rounding (physics.md 7).
    end_slip_below(pressed::cloth_slip, Real(1e-13) * speed());
    end_slip_below(pressed::nose_slip, slip_floor_);
    choose_grips();
  }

  // False if the bound on the number of steps was met before the end, or if energy was gained, as
  // frictions beyond all experience can make a rigid ball do.
  [[nodiscard]] bool run() {
    const Real at_start = energy();
    return compress() && restitute() && energy() <= at_start * (Real(1) + Real(64) * precision_);
  }

  [[nodiscard]] const PressedState<Real>& state() const { return y_; }

 private:
  static constexpr int step_limit = 4000;
  static constexpr int attempt_limit = 500;
  static constexpr int settling_iterations = 500;
  static constexpr bool is_wide =
      !std::numeric_limits<Real>::is_specialized || std::numeric_limits<Real>::digits > 64;
  static constexpr std::size_t columns = is_wide ? 14 : 6;
  // Below this slip a beginning slip is taken to have its settled direction.
  static constexpr double creeping_slip = 1e-7;

  // Directions of slip, also of one that is about to begin.
  struct Onset {
    Vec2<Real> nose{};
    Vec2<Real> cloth{};
  };
  // Which of them are to be found.
  struct Moving {
    bool nose = false;
    bool cloth = false;
  };

  // The end of a phase: one number of the state falls to a value.
  struct Goal {
    std::size_t place;
    Real value;
    Real tolerance;
  };
  [[nodiscard]] static Real left_to(const Goal& goal, const PressedState<Real>& y) {
    return y[goal.place] - goal.value;
  }

  [[nodiscard]] bool compress() {
    const Goal stopped{pressed::vx, Real(0), precision_};
    while (left_to(stopped, y_) > stopped.tolerance && !is_stuck()) {
      if (!advance(stopped)) {
        return false;
      }
    }
    y_[pressed::vx] = Real(0);
    return true;
  }

  // Until e^2 of the work is given back, or the ball is wedged.
  [[nodiscard]] bool restitute() {
    const Real stored = y_[pressed::work];
    const Real kept = (Real(1) - restitution_ * restitution_) * stored;
    const Goal released{pressed::work, kept, Real(8) * precision_ * stored};
    while (left_to(released, y_) > released.tolerance && !is_wedged()) {
      if (!advance(released)) {
        return false;
      }
    }
    if (!is_wedged()) {
      // The rest, a few last places, in one straight step.
      const PressedState<Real> slope = rate_of(y_);
      // Nothing is given back without restitution: the ball does not move, and neither does the
      // work.
      if (slope[pressed::work] < Real(0))
        y_ = advanced(y_, Real(left_to(released, y_) / -slope[pressed::work]), slope);
    }
    if (y_[pressed::vx] > Real(0)) {
      y_[pressed::vx] = Real(0);
    }
    return true;
  }

  // Twice the kinetic energy over the mass; I = 2/5 m R^2.
  [[nodiscard]] Real energy() const {
    return y_[pressed::vx] * y_[pressed::vx] + y_[pressed::vy] * y_[pressed::vy] +
           Real(0.4) * (y_[pressed::spin_x] * y_[pressed::spin_x] +
                        y_[pressed::spin_y] * y_[pressed::spin_y] +
                        y_[pressed::spin_z] * y_[pressed::spin_z]);
  }

  // A few units in the last place; of the widest types 1e-38 is enough.
  [[nodiscard]] static Real few_last_places() {
    Real unit(1);
    while (Real(1) + unit / Real(2) != Real(1) && unit > Real(1e-38))
      unit = unit / Real(2);
    return Real(4) * unit;
  }

  // An impulse; the whole impact takes about 2. Error control soon finds a better one.
  [[nodiscard]] static Real first_step() { return Real(0.25); }

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

  // With both contacts stuck the ball stands still.
  [[nodiscard]] bool is_stuck() const {
    return grips_.nose == Grip::sticks && grips_.cloth == Grip::sticks;
  }

  // Nothing moves the ball back out although the nose presses.
  [[nodiscard]] bool is_wedged() const {
    return is_stuck() || (y_[pressed::vx] > -precision_ && rate_of(y_)[pressed::vx] > -precision_);
  }

  [[nodiscard]] PressedState<Real> rate_of(const PressedState<Real>& y) const {
    if (!creeps_.nose && !creeps_.cloth) {
      return contacts_.rate(y, grips_);
    }
    const Onset onset = settled(directions(y), grips_, creeps_);
    return contacts_.rate(contacts_.forces(onset.nose, onset.cloth, grips_), y, grips_);
  }

  // One accepted step, at most to the goal.
  [[nodiscard]] bool advance(const Goal& goal) {
    if (++steps_ > step_limit)
      return false;
    const auto rate = [this](const PressedState<Real>& y) { return rate_of(y); };
    const Real tolerance = Real(16) * precision_;
    const Real before = left_to(goal, y_);
    const PressedState<Real> slope = rate(y_);
    Real h = within_slip_scale(slope);
    // Newton's step to the goal: quadratic convergence, and the secant below if it is too long.
    if (slope[goal.place] * h < -before) {
      h = -before / slope[goal.place];
    }
    for (int i = 0; i < attempt_limit; ++i) {
      const auto step = extrapolated_step<columns>(rate, y_, h);
      const Real after = left_to(goal, step.end);
      if (!(step.error <= tolerance) && h > slip_floor_) {
        h = h / Real(2);
        control_ = h;
      } else if (after < -goal.tolerance) {
        const Real secant = h * before / (before - after);
        h = secant < h ? secant : Real(h / Real(2));
      } else if (h > cone_resolution_ && (!is_within_cones(step.end) || has_outgrown(step.end))) {
        h = h / Real(2);
      } else {
        const Real longer = Real(1.5) * h;
        if (step.error <= precision_ && longer > control_)
          control_ = longer;
        accept(step.end);
        return true;
      }
    }
    return false;
  }

  // The step that error control asks for, but no longer than a slip's own scale: direction and
  // friction turn within no time near the end of a slip, so that it is followed down to its last
  // places in a geometric row of steps.
  [[nodiscard]] Real within_slip_scale(const PressedState<Real>& slope) const {
    const Real at_nose = slip_scale(pressed::nose_slip, slope, creeps_.nose);
    const Real at_cloth = slip_scale(pressed::cloth_slip, slope, creeps_.cloth);
    const Real shorter = at_nose < at_cloth ? at_nose : at_cloth;
    return shorter < control_ ? shorter : control_;
  }

  [[nodiscard]] Real slip_scale(std::size_t contact, const PressedState<Real>& slope,
                                bool creeps) const {
    const Vec2<Real> slip = slip_at(y_, contact);
    const Real change = dot(slip, slip_at(slope, contact));
    if (change == Real(0) || (creeps && change > Real(0))) {
      return control_;
    }
    return (change < Real(0) ? Real(-0.9) : Real(4)) * dot(slip, slip) / change;
  }

  // Whether a creeping slip would go far beyond what counts as creeping.
  [[nodiscard]] bool has_outgrown(const PressedState<Real>& y) const {
    const Real limit = Real(8 * creeping_slip);
    const auto is_beyond = [&](std::size_t contact) {
      return dot(slip_at(y, contact), slip_at(y, contact)) > limit * limit;
    };
    return (creeps_.nose && is_beyond(pressed::nose_slip)) ||
           (creeps_.cloth && is_beyond(pressed::cloth_slip));
  }

  [[nodiscard]] bool creeps_on(std::size_t contact) const {
    const Vec2<Real> slip = slip_at(y_, contact);
    return dot(slip, slip) < Real(creeping_slip) * Real(creeping_slip);
  }

  [[nodiscard]] bool is_within_cones(const PressedState<Real>& y) const {
    return contacts_.is_within_cones(contacts_.forces(y, grips_), grips_);
  }

  void accept(const PressedState<Real>& end) {
    y_ = end;
    const bool nose_ended = grips_.nose == Grip::slips && ends_slip(pressed::nose_slip);
    const bool cloth_ended = grips_.cloth == Grip::slips && ends_slip(pressed::cloth_slip);
    creeps_.nose = creeps_.nose && !nose_ended && creeps_on(pressed::nose_slip);
    creeps_.cloth = creeps_.cloth && !cloth_ended && creeps_on(pressed::cloth_slip);
    if (!nose_ended && !cloth_ended && is_within_cones(y_)) {
      return;
    }
    choose_grips();
    control_ = first_step();
  }

  // Ends a slip that is nearly over. Its direction has settled then (and swings ever faster about
  // where it settles, so that steps would become ever smaller): what is left of it goes in one
  // straight step with the forces of the settled direction, wrong by the square of its length.
  [[nodiscard]] bool ends_slip(std::size_t contact) {
    const Vec2<Real> slip = slip_at(y_, contact);
    const Real size = square_root(Real(dot(slip, slip)));
    if (size > final_step_)
      return false;
    const bool is_nose = contact == pressed::nose_slip;
    const Onset end = settled(directions(y_), grips_, {is_nose, !is_nose});
    const Vec2<Real> direction = is_nose ? end.nose : end.cloth;
    const PressedState<Real> slope =
        contacts_.rate(contacts_.forces(end.nose, end.cloth, grips_), y_, grips_);
    const Real falling = -dot(direction, slip_at(slope, contact));
    if (!(falling > Real(0)) || size > final_step_ * falling)
      return false;
    const Vec2<Real> swing = direction - Real(Real(1) / size) * slip;
    const bool has_settled = size * square_root(Real(dot(swing, swing))) <= Real(8) * slip_floor_;
    if (!has_settled && size > slip_floor_)
      return false;
    y_ = advanced(y_, Real(size / falling), slope);
    set_slip(contact, {});
    return true;
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
      if (!nose_moves && grips.nose == Grip::slips) {
        set_slip(pressed::nose_slip, tiny * onset.nose);
        creeps_.nose = true;
      }
      if (!cloth_moves && grips.cloth == Grip::slips) {
        set_slip(pressed::cloth_slip, tiny * onset.cloth);
        creeps_.cloth = true;
      }
      return;
    }
  }

  [[nodiscard]] static Onset directions(const PressedState<Real>& y) {
    return {unit_or_zero(slip_at(y, pressed::nose_slip)),
            unit_or_zero(slip_at(y, pressed::cloth_slip))};
  }

  [[nodiscard]] Onset onset_of(const Grips& grips) const {
    const bool nose_begins = grips.nose == Grip::slips && !has_slip(pressed::nose_slip);
    const bool cloth_begins = grips.cloth == Grip::slips && !has_slip(pressed::cloth_slip);
    return settled(directions(y_), grips, {nose_begins, cloth_begins});
  }

  // The directions with which slips begin or end: driven along d against the friction along -d.
  // They are the fixed points of d <- unit(k d + rate(d)), which contracts for k of the size of
  // the friction.
  [[nodiscard]] Onset settled(Onset onset, const Grips& grips, const Moving& moving) const {
    if (!moving.nose && !moving.cloth) {
      return onset;
    }
    const auto moved = [](const Vec2<Real>& direction, const Vec2<Real>& rate,
                          const Real& friction) {
      const Real driven = dot(direction, rate);
      const Real k = Real(4) * friction - (driven < Real(0) ? Real(2) * driven : Real(0));
      return unit_or_zero(k * direction + rate);
    };
    for (int i = 0; i < settling_iterations; ++i) {
      const PressedForces<Real> f = contacts_.forces(onset.nose, onset.cloth, grips);
      const Onset last = onset;
      if (moving.nose) {
        onset.nose = moved(last.nose, contacts_.nose_slip_rate(f), contacts_.nose_friction());
      }
      if (moving.cloth) {
        const Real friction = contacts_.cloth_friction() * f.cloth_normal;
        onset.cloth = moved(last.cloth, contacts_.cloth_slip_rate(f), friction);
      }
      const Vec2<Real> nose_change = onset.nose - last.nose;
      const Vec2<Real> cloth_change = onset.cloth - last.cloth;
      const Real change = dot(nose_change, nose_change) + dot(cloth_change, cloth_change);
      if (change <= precision_ * precision_ / Real(16)) {
        break;
      }
    }
    return onset;
  }

  NoseAndCloth<Real> contacts_;
  PressedState<Real> y_;
  Real restitution_;
  Real precision_;
  Real slip_floor_;
  Real cone_resolution_;
  Real final_step_;  // impulse in which a slip may end in one straight step
  Real control_ = first_step();
  Grips grips_{};
  Moving creeps_{};  // slips that have just begun
  int steps_ = 0;
};

}  // namespace poolhall::physics
