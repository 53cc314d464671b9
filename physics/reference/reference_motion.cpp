#include "physics/reference/reference_motion.hpp"

namespace poolhall::physics::reference {

namespace {

Number length(const Vec2<Number>& p) {
  return sqrt(dot(p, p));
}

// (10), from either sign, stopping at zero.
Number decayed_spin(const Number& spin, const Number& t, const MotionConstants& constants) {
  const Number loss = constants.spin_deceleration * t;
  if (abs(spin) <= loss) {
    return 0;
  }
  return spin > 0 ? Number(spin - loss) : Number(spin + loss);
}

Ball<Number> rolling(Ball<Number> ball, const MotionConstants& constants) {
  ball.state = MotionState::rolling;
  ball.angular_velocity.x = -ball.velocity.y / constants.radius;
  ball.angular_velocity.y = ball.velocity.x / constants.radius;
  return ball;
}

Ball<Number> at_rest_or_spinning(Ball<Number> ball) {
  ball.velocity = {};
  ball.angular_velocity.x = 0;
  ball.angular_velocity.y = 0;
  ball.state = ball.angular_velocity.z == 0 ? MotionState::stationary : MotionState::spinning;
  return ball;
}

}  // namespace

MotionConstants motion_constants(const Materials& m) {
  MotionConstants c{m.gravity, m.ball_radius, m.ball_mass, m.mu_slide, m.mu_roll, 0};
  c.spin_deceleration =
      m.spin_deceleration ? Number(*m.spin_deceleration)
                          : Number(5 * Number(m.mu_spin.value_or(0)) * c.gravity / (2 * c.radius));
  return c;
}

Vec2<Number> slip(const Ball<Number>& ball, const Number& radius) {
  return {ball.velocity.x - radius * ball.angular_velocity.y,
          ball.velocity.y + radius * ball.angular_velocity.x};
}

Ball<Number> classified(Ball<Number> ball, const MotionConstants& constants) {
  const Vec2<Number> w_xy{ball.angular_velocity.x, ball.angular_velocity.y};
  const Number scale = length(ball.velocity) + constants.radius * length(w_xy);
  if (scale == 0) {
    return at_rest_or_spinning(ball);
  }
  if (length(slip(ball, constants.radius)) < Number("1e-13") * scale) {
    return rolling(ball, constants);
  }
  ball.state = MotionState::sliding;
  return ball;
}

Vec2<Number> acceleration(const Ball<Number>& ball, const MotionConstants& constants) {
  if (ball.state == MotionState::sliding) {
    const Vec2<Number> u = slip(ball, constants.radius);
    return Number(-constants.mu_slide * constants.gravity / length(u)) * u;
  }
  if (ball.state == MotionState::rolling) {
    return Number(-constants.mu_roll * constants.gravity / length(ball.velocity)) * ball.velocity;
  }
  return {0, 0};
}

std::optional<Number> time_to_transition(const Ball<Number>& ball,
                                         const MotionConstants& constants) {
  switch (ball.state) {
    case MotionState::sliding:
      if (constants.mu_slide == 0 || constants.gravity == 0) {
        return std::nullopt;
      }
      return 2 * length(slip(ball, constants.radius)) /
             (7 * constants.mu_slide * constants.gravity);  // (13)
    case MotionState::rolling:
      if (constants.mu_roll == 0 || constants.gravity == 0) {
        return std::nullopt;
      }
      return length(ball.velocity) / (constants.mu_roll * constants.gravity);  // (17)
    case MotionState::spinning:
      if (constants.spin_deceleration == 0) {
        return std::nullopt;
      }
      return abs(ball.angular_velocity.z) / constants.spin_deceleration;
    case MotionState::stationary:
    case MotionState::pocketed:
      break;
  }
  return std::nullopt;
}

Ball<Number> advanced(const Ball<Number>& ball, const Number& t, const MotionConstants& constants) {
  Ball<Number> later = ball;
  const Vec2<Number> a = acceleration(ball, constants);
  later.position = ball.position + t * ball.velocity + Number(t * t / 2) * a;
  later.velocity = ball.velocity + t * a;
  if (ball.state == MotionState::sliding) {
    // (9) with the sign of physics.md: w' = (5 mu g / 2R) k x u^ and a = -mu g u^.
    later.angular_velocity.x += 5 * a.y * t / (2 * constants.radius);
    later.angular_velocity.y -= 5 * a.x * t / (2 * constants.radius);
  } else if (ball.state == MotionState::rolling) {
    later = rolling(later, constants);
  }
  later.angular_velocity.z = decayed_spin(ball.angular_velocity.z, t, constants);
  return later;
}

Ball<Number> after_transition(const Ball<Number>& ball, const MotionConstants& constants) {
  const Number duration = *time_to_transition(ball, constants);
  Ball<Number> later = advanced(ball, duration, constants);
  if (ball.state == MotionState::spinning) {
    later.angular_velocity.z = 0;
    return at_rest_or_spinning(later);
  }
  if (ball.state == MotionState::rolling) {
    return at_rest_or_spinning(later);
  }
  // Sliding ends with v = v0 - (2/7) u0; below 1e-13 of what it came from it is no roll.
  const Number before = length(ball.velocity) + length(slip(ball, constants.radius));
  if (length(later.velocity) < Number("1e-13") * before) {
    return at_rest_or_spinning(later);
  }
  return rolling(later, constants);
}

}  // namespace poolhall::physics::reference
