// How one ball moves between two events: (8)-(17) of the paper in the table frame, with the
// errata of physics.md 2. Closed forms of the time since the ball's own last event.
//
//   Segment<double> s = segment(ball, now, c);
//   Ball<double> later = ball_at(s, ball.id, 0.1, c);   // 0.1 s after `now`
//   Ball<double> next = after_transition(s, ball.id, c);  // when s.duration is over
//
// Not for finding events: see detect_*.hpp.
#pragma once

#include <algorithm>

#include "physics/ball.hpp"
#include "physics/coefficients.hpp"
#include "physics/instant.hpp"

namespace poolhall::physics {

// u = v + R k x w, the velocity of the point that touches the cloth (6).
template <class Real>
[[nodiscard]] Vec2<Real> cloth_slip(const Vec2<Real>& v, const Vec3<Real>& w, const Real& radius) {
  return {v.x - radius * w.y, v.y + radius * w.x};
}

// A slip, or a speed left at the end of a slide, below this part of |v| + R |w_xy| is rounding.
template <class Real>
[[nodiscard]] constexpr Real negligible_slip() {
  return Real(1e-13);
}

template <class Real>
[[nodiscard]] bool is_negligible_slip(const Vec2<Real>& slip, const Vec2<Real>& v,
                                      const Vec3<Real>& w, const Real& radius) {
  const Vec2<Real> around{radius * w.x, radius * w.y};
  const Real bound = negligible_slip<Real>();
  // (p + q)^2 <= 2 (p^2 + q^2): most balls are settled without a square root.
  if (dot(slip, slip) > Real(2) * bound * bound * (dot(v, v) + dot(around, around))) {
    return false;
  }
  return length(slip) <= bound * (length(v) + length(around));
}

// The motion state that the velocities imply; never `pocketed`.
template <class Real>
[[nodiscard]] MotionState motion_state_of(const Vec2<Real>& v, const Vec3<Real>& w,
                                          const Real& radius) {
  if (!is_negligible_slip(cloth_slip(v, w, radius), v, w, radius)) {
    return MotionState::sliding;
  }
  if (v.x != Real(0) || v.y != Real(0)) {
    return MotionState::rolling;
  }
  return w.z != Real(0) ? MotionState::spinning : MotionState::stationary;
}

// w of a ball that rolls with velocity v and spins about the vertical with w_z.
template <class Real>
[[nodiscard]] Vec3<Real> rolling_spin(const Vec2<Real>& v, const Real& w_z, const Real& radius) {
  return {-v.y / radius, v.x / radius, w_z};
}
template <class Real>
[[nodiscard]] Vec3<Real> rolling_spin(const Vec2<Real>& v, const Real& w_z,
                                      const Coefficients<Real>& c) {
  return {-(v.y * c.inverse_radius), v.x * c.inverse_radius, w_z};
}

// Gives `ball` the state that its velocities imply, and w exact where it rolls.
template <class Real>
void settle(Ball<Real>& ball, const Real& radius) {
  ball.state = motion_state_of(ball.velocity, ball.angular_velocity, radius);
  if (ball.state == MotionState::rolling) {
    ball.angular_velocity = rolling_spin(ball.velocity, ball.angular_velocity.z, radius);
  }
}
template <class Real>
[[nodiscard]] Ball<Real> settled(Ball<Real> ball, const Real& radius) {
  settle(ball, radius);
  return ball;
}

template <class Real>
struct Segment {
  Instant<Real> start{};
  Vec2<Real> position{};          // m, at the start; so are the velocities
  Vec2<Real> velocity{};          // m/s
  Vec2<Real> acceleration{};      // m/s^2
  Vec3<Real> angular_velocity{};  // rad/s
  Vec2<Real> slip{};              // m/s, u0 of a sliding ball
  Real duration{};                // s until the ball's own transition, forever() if there is none
  MotionState state = MotionState::stationary;
};

template <class Real>
[[nodiscard]] Real at_most_forever(const Real& t) {
  return t < forever<Real>() ? t : forever<Real>();
}

// `size` against the direction of v, whose length is `speed`.
template <class Real>
[[nodiscard]] Vec2<Real> against(const Vec2<Real>& v, const Real& speed, const Real& size) {
  if (size < forever<Real>() * speed) {
    return (-size / speed) * v;
  }
  return {-size * (v.x / speed), -size * (v.y / speed)};
}

// Makes `s` the motion that begins with `ball` at `start`.
template <class Real>
void begin_segment(Segment<Real>& s, const Ball<Real>& ball, const Instant<Real>& start,
                   const Coefficients<Real>& c) {
  using std::abs;
  s.start = start;
  s.position = ball.position;
  s.velocity = ball.velocity;
  s.angular_velocity = ball.angular_velocity;
  s.state = ball.state;
  s.duration = forever<Real>();
  if (s.state == MotionState::sliding) {
    s.slip = cloth_slip(ball.velocity, ball.angular_velocity, c.radius);
    const Real speed = length(s.slip);
    s.acceleration = against(s.slip, speed, c.slide_acceleration);  // (8)
    s.duration = at_most_forever(Real(speed * c.slide_time));       // (13)
    return;
  }
  s.slip = {};
  s.acceleration = {};
  if (s.state == MotionState::rolling) {
    const Real speed = length(ball.velocity);
    s.acceleration = against(ball.velocity, speed, c.roll_acceleration);  // (15)
    s.duration = at_most_forever(Real(speed * c.roll_time));              // (17)
  } else if (s.state == MotionState::spinning) {
    const Real spin = abs(ball.angular_velocity.z);
    if (spin < forever<Real>() * c.spin_deceleration) {
      s.duration = spin / c.spin_deceleration;  // (10)
    }
  }
}
template <class Real>
[[nodiscard]] Segment<Real> segment(const Ball<Real>& ball, const Instant<Real>& start,
                                    const Coefficients<Real>& c) {
  Segment<Real> s;
  begin_segment(s, ball, start, c);
  return s;
}

template <class Real>
[[nodiscard]] Vec2<Real> position_at(const Segment<Real>& s, const Real& t) {
  const Real half = t / Real(2);
  return {s.position.x + t * (s.velocity.x + half * s.acceleration.x),
          s.position.y + t * (s.velocity.y + half * s.acceleration.y)};
}

template <class Real>
[[nodiscard]] Vec2<Real> velocity_at(const Segment<Real>& s, const Real& t) {
  return s.velocity + t * s.acceleration;
}

// (10): towards zero from either sign, and there it stays.
template <class Real>
[[nodiscard]] Real vertical_spin_at(const Segment<Real>& s, const Real& t,
                                    const Coefficients<Real>& c) {
  const Real w_z = s.angular_velocity.z;
  const Real lost = c.spin_deceleration * t;
  if (w_z > Real(0)) {
    return w_z > lost ? Real(w_z - lost) : Real(0);
  }
  return -w_z > lost ? Real(w_z + lost) : Real(0);
}

// (9) with its sign put right: w = w0 + (5 mu_s g / 2R) t (k x u0 / |u0|), and mu_s g u0 / |u0| is
// the acceleration backwards.
template <class Real>
[[nodiscard]] Vec3<Real> angular_velocity_at(const Segment<Real>& s, const Real& t,
                                             const Coefficients<Real>& c) {
  const Real w_z = vertical_spin_at(s, t, c);
  if (s.state == MotionState::rolling) {
    return rolling_spin(velocity_at(s, t), w_z, c);
  }
  if (s.state != MotionState::sliding) {
    return {Real(0), Real(0), w_z};
  }
  const Real turn = t * c.lever;
  return {s.angular_velocity.x + turn * s.acceleration.y,
          s.angular_velocity.y - turn * s.acceleration.x, w_z};
}

// The ball t seconds into its segment, 0 <= t < duration.
template <class Real>
[[nodiscard]] Ball<Real> ball_at(const Segment<Real>& s, BallId id, const Real& t,
                                 const Coefficients<Real>& c) {
  Ball<Real> ball;
  ball.id = id;
  ball.state = s.state;
  ball.position = position_at(s, t);
  ball.velocity = velocity_at(s, t);
  ball.angular_velocity = angular_velocity_at(s, t, c);
  return ball;
}

template <class Real>
[[nodiscard]] Ball<Real> resting(BallId id, const Vec2<Real>& position) {
  Ball<Real> ball;
  ball.id = id;
  ball.position = position;
  return ball;
}

// The ball when its segment's duration is over: v and w from the exact rolling condition when a
// slide ends, exact zeros at rest. The slide takes 2/7 of the slip from the velocity, (12) and (8).
template <class Real>
[[nodiscard]] Ball<Real> after_transition(const Segment<Real>& s, BallId id,
                                          const Coefficients<Real>& c) {
  Ball<Real> ball;
  ball.id = id;
  ball.position = position_at(s, s.duration);
  const Real w_z = s.state == MotionState::spinning ? Real(0) : vertical_spin_at(s, s.duration, c);
  ball.angular_velocity = {Real(0), Real(0), w_z};
  ball.state = w_z != Real(0) ? MotionState::spinning : MotionState::stationary;
  if (s.state == MotionState::sliding) {
    const Vec2<Real> left = s.velocity - (Real(2) / Real(7)) * s.slip;
    const Vec2<Real> around{c.radius * s.angular_velocity.x, c.radius * s.angular_velocity.y};
    const Real scale = length(s.velocity) + length(around);
    if (length(left) > negligible_slip<Real>() * scale) {
      ball.velocity = left;
      ball.angular_velocity = rolling_spin(left, w_z, c);
      ball.state = MotionState::rolling;
    }
  }
  return ball;
}

}  // namespace poolhall::physics
