// A ball pressed between a cushion's nose and the cloth: Coulomb friction at both contacts, each
// of which slips or sticks (Mathavan, Jackson, Parkin 2010, equations 11-14, in vectors instead
// of angles, and with the branch in which a contact sticks).
//
// Everything is per unit of the nose's normal impulse divided by the mass, in the cushion's frame.
// The slip at the nose has the tangents (sin, 0, -cos) and y, that at the cloth x and y.
#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/cushion_contact.hpp"
#include "physics/extrapolation.hpp"

namespace poolhall::physics {

enum class Grip : std::uint8_t { slips, sticks };
struct Grips {
  Grip nose = Grip::slips;
  Grip cloth = Grip::slips;
};

// Places in the state: both slips, the velocity, R times the angular velocity, and the work that
// the normal impulse has done against the ball.
namespace pressed {
enum Place : std::size_t {
  nose_slip = 0,
  cloth_slip = 2,
  vx = 4,
  vy,
  spin_x,
  spin_y,
  spin_z,
  work,
  size
};
}
template <class Real>
using PressedState = StateVector<Real, pressed::size>;

template <class Real>
[[nodiscard]] Vec2<Real> slip_at(const PressedState<Real>& y, std::size_t contact) {
  return {y[contact], y[contact + 1]};
}

template <class Real>
[[nodiscard]] Vec2<Real> unit_or_zero(const Vec2<Real>& p) {
  const Real size = square_root(Real(dot(p, p)));
  return size > Real(0) ? Vec2<Real>{p.x / size, p.y / size} : Vec2<Real>{};
}

// Friction impulses at the nose (in its tangents) and at the cloth, and the cloth's normal one.
template <class Real>
struct PressedForces {
  Vec2<Real> nose{};
  Vec2<Real> cloth{};
  Real cloth_normal{};
};

template <class Real>
class NoseAndCloth {
 public:
  NoseAndCloth(const NoseAngle<Real>& nose, const Real& nose_friction, const Real& cloth_friction)
      : sine_(nose.sine),
        cosine_(nose.cosine),
        nose_friction_(nose_friction),
        cloth_friction_(cloth_friction),
        stiff_nose_(sine_ * sine_ + Real(2.5)),
        cross_x_(sine_ - Real(2.5)),
        cross_y_(Real(1) - Real(2.5) * sine_) {}

  // Forces for given directions of slip (unit vectors; ignored where a contact sticks).
  [[nodiscard]] PressedForces<Real> forces(const Vec2<Real>& nose_direction,
                                           const Vec2<Real>& cloth_direction,
                                           const Grips& grips) const {
    if (grips.nose == Grip::slips) {
      const Vec2<Real> nose = Real(-nose_friction_) * nose_direction;
      const Real normal = cloth_normal(nose.x);
      if (grips.cloth == Grip::slips) {
        return {nose, Real(-cloth_friction_ * normal) * cloth_direction, normal};
      }
      return {nose,
              {(cosine_ - cross_x_ * nose.x) / Real(3.5), -cross_y_ * nose.y / Real(3.5)},
              normal};
    }
    return grips.cloth == Grip::slips ? nose_sticks(cloth_direction) : both_stick();
  }

  [[nodiscard]] PressedForces<Real> forces(const PressedState<Real>& y, const Grips& grips) const {
    return forces(unit_or_zero(slip_at(y, pressed::nose_slip)),
                  unit_or_zero(slip_at(y, pressed::cloth_slip)), grips);
  }

  // Whether every contact that sticks does so within its cone of friction.
  [[nodiscard]] bool is_within_cones(const PressedForces<Real>& f, const Grips& grips) const {
    const Real nose_limit = nose_friction_;
    const Real cloth_limit = cloth_friction_ * f.cloth_normal;
    return (grips.nose == Grip::slips || dot(f.nose, f.nose) <= nose_limit * nose_limit) &&
           (grips.cloth == Grip::slips || dot(f.cloth, f.cloth) <= cloth_limit * cloth_limit);
  }

  [[nodiscard]] Vec2<Real> nose_slip_rate(const PressedForces<Real>& f) const {
    return {-sine_ * cosine_ + stiff_nose_ * f.nose.x + cross_x_ * f.cloth.x,
            Real(3.5) * f.nose.y + cross_y_ * f.cloth.y};
  }
  [[nodiscard]] Vec2<Real> cloth_slip_rate(const PressedForces<Real>& f) const {
    return {-cosine_ + cross_x_ * f.nose.x + Real(3.5) * f.cloth.x,
            cross_y_ * f.nose.y + Real(3.5) * f.cloth.y};
  }

  [[nodiscard]] PressedState<Real> rate(const PressedState<Real>& y, const Grips& grips) const {
    return rate(forces(y, grips), y, grips);
  }

  [[nodiscard]] PressedState<Real> rate(const PressedForces<Real>& f, const PressedState<Real>& y,
                                        const Grips& grips) const {
    // A slip that is stuck stays zero to the last bit.
    const Vec2<Real> nose = grips.nose == Grip::slips ? nose_slip_rate(f) : Vec2<Real>{};
    const Vec2<Real> cloth = grips.cloth == Grip::slips ? cloth_slip_rate(f) : Vec2<Real>{};
    return {nose.x,
            nose.y,
            cloth.x,
            cloth.y,
            -cosine_ + sine_ * f.nose.x + f.cloth.x,
            f.nose.y + f.cloth.y,
            Real(2.5) * (f.cloth.y - sine_ * f.nose.y),
            Real(2.5) * (f.nose.x - f.cloth.x),
            Real(2.5) * cosine_ * f.nose.y,
            cosine_ * y[pressed::vx]};
  }

  [[nodiscard]] PressedState<Real> state_of(const Vec2<Real>& v, const Vec3<Real>& spin) const {
    return {v.x * sine_ + spin.y,
            v.y + spin.z * cosine_ - spin.x * sine_,
            v.x - spin.y,
            v.y + spin.x,
            v.x,
            v.y,
            spin.x,
            spin.y,
            spin.z,
            Real(0)};
  }

  [[nodiscard]] const Real& nose_friction() const { return nose_friction_; }
  [[nodiscard]] const Real& cloth_friction() const { return cloth_friction_; }

 private:
  // Balance of the vertical forces; where friction lifts the ball the cloth lets go.
  [[nodiscard]] Real cloth_normal(const Real& nose_friction_up) const {
    const Real normal = sine_ + cosine_ * nose_friction_up;
    return normal > Real(0) ? normal : Real(0);
  }

  // The nose's slip stays zero while the cloth slips along `direction`.
  [[nodiscard]] PressedForces<Real> nose_sticks(const Vec2<Real>& direction) const {
    const Real drag = cross_x_ * cloth_friction_ * direction.x;
    const Real resistance = stiff_nose_ - drag * cosine_;
    if (!(resistance > Real(0))) {
      // Friction at the cloth would drive the slip on however hard the nose holds: no such balance.
      return {{Real(4) * nose_friction_ + Real(1), Real(0)}, {}, Real(0)};
    }
    Vec2<Real> nose{(sine_ * cosine_ + drag * sine_) / resistance, Real(0)};
    Real normal = sine_ + cosine_ * nose.x;
    if (!(normal > Real(0))) {
      normal = Real(0);
      nose.x = sine_ * cosine_ / stiff_nose_;
    }
    const Vec2<Real> cloth = Real(-cloth_friction_ * normal) * direction;
    nose.y = -cross_y_ * cloth.y / Real(3.5);
    return {nose, cloth, normal};
  }

  [[nodiscard]] PressedForces<Real> both_stick() const {
    const Real determinant = Real(2.5) * (Real(1) + sine_) * (Real(1) + sine_);
    const Real nose = (Real(3.5) * sine_ - cross_x_) * cosine_ / determinant;
    const Real cloth = (stiff_nose_ - cross_x_ * sine_) * cosine_ / determinant;
    return {{nose, Real(0)}, {cloth, Real(0)}, cloth_normal(nose)};
  }

  Real sine_;
  Real cosine_;
  Real nose_friction_;
  Real cloth_friction_;
  // Of the slips against the friction impulses, times m: at the nose along the first tangent
  // (3.5 along the second, and at the cloth along both), and between the contacts.
  Real stiff_nose_;
  Real cross_x_;
  Real cross_y_;
};

}  // namespace poolhall::physics
