#include "tests/bench/time_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/ball_collision.hpp"
#include "physics/coefficients.hpp"
#include "physics/cue_strike.hpp"
#include "physics/cushion.hpp"
#include "physics/motion.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::bench {

namespace {

using physics::Ball;
using physics::EventType;
using physics::MotionState;
using physics::Vec2;
using physics::Vec3;

// Rates of a ball's state.
struct Rates {
  Vec2<double> position;
  Vec2<double> velocity;
  Vec3<double> spin;
};

class Stepping {
 public:
  Stepping(const physics::Scene<double>& scene, Stepper stepper, double step)
      : scene_(scene),
        stepper_(stepper),
        step_(step),
        c_(physics::coefficients<double>(scene.materials)),
        geometry_(physics::table_geometry<double>(scene.table, scene.materials.ball_radius)),
        nose_(physics::nose_angle<double>(scene.table, scene.materials)) {
    out_.balls = balls_after_strike(scene);
  }

  SteppedShot run(double longest) {
    double t = 0;
    while (moving()) {
      if (t >= longest) {
        out_.ended = false;
        break;
      }
      stepper_ == Stepper::paper_discrete ? step_backing_up(t) : step_and_resolve(t);
      t += step_;
      ++out_.steps;
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] static bool is_moving(const Ball<double>& ball) {
    return ball.state == MotionState::sliding || ball.state == MotionState::rolling;
  }

  [[nodiscard]] bool moving() const {
    return std::any_of(out_.balls.begin(), out_.balls.end(), is_moving);
  }

  // The paper's count: 3 a moving ball, 12 for its rails and pockets, 1 a pair.
  void count_operations() {
    const auto n =
        static_cast<std::size_t>(std::count_if(out_.balls.begin(), out_.balls.end(), is_moving));
    out_.operations += n * (61 - n) / 2;
  }

  // Ends the slide or the roll that friction would reverse within one step of `dt`.
  void settle_states(double dt) {
    for (Ball<double>& ball : out_.balls) {
      if (ball.state == MotionState::sliding) {
        const Vec2<double> slip =
            physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
        if (length(slip) <= 3.5 * c_.slide_acceleration * dt) {
          ball.velocity = ball.velocity - (2.0 / 7.0) * slip;
          ball.angular_velocity =
              physics::rolling_spin(ball.velocity, ball.angular_velocity.z, c_.radius);
          ball.state = MotionState::rolling;
        }
      }
      if (ball.state == MotionState::rolling &&
          length(ball.velocity) <= c_.roll_acceleration * dt) {
        ball.velocity = {};
        ball.angular_velocity.x = ball.angular_velocity.y = 0;
        ball.state = MotionState::spinning;
      }
      const double lost = c_.spin_deceleration * dt;
      const double spin = ball.angular_velocity.z;
      ball.angular_velocity.z = std::abs(spin) <= lost ? 0 : spin - std::copysign(lost, spin);
    }
  }

  [[nodiscard]] Rates rates(const Ball<double>& ball) const {
    Rates r{ball.velocity, {}, {}};
    if (ball.state == MotionState::sliding) {
      const Vec2<double> slip =
          physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
      r.velocity = (-c_.slide_acceleration / length(slip)) * slip;
      r.spin = {2.5 * r.velocity.y / c_.radius, -2.5 * r.velocity.x / c_.radius, 0};
    } else if (ball.state == MotionState::rolling && length(ball.velocity) > 0) {
      r.velocity = (-c_.roll_acceleration / length(ball.velocity)) * ball.velocity;
      r.spin = {-r.velocity.y / c_.radius, r.velocity.x / c_.radius, 0};
    }
    return r;
  }

  [[nodiscard]] static Ball<double> moved(Ball<double> ball, const Rates& r, double dt) {
    ball.position = ball.position + dt * r.position;
    ball.velocity = ball.velocity + dt * r.velocity;
    ball.angular_velocity = ball.angular_velocity + dt * r.spin;
    return ball;
  }

  [[nodiscard]] Ball<double> stepped(const Ball<double>& ball, double dt) const {
    const Rates now = rates(ball);
    switch (stepper_) {
      case Stepper::paper_discrete:
        return moved(ball, now, dt);
      case Stepper::semi_implicit_euler: {
        Ball<double> later = moved(ball, {{}, now.velocity, now.spin}, dt);
        later.position = ball.position + dt * later.velocity;
        return later;
      }
      case Stepper::verlet: {
        Ball<double> later = moved(ball, now, dt);
        later.position = later.position + (dt * dt / 2) * now.velocity;
        const Rates next = rates(later);
        later.velocity = ball.velocity + (dt / 2) * (now.velocity + next.velocity);
        later.angular_velocity = ball.angular_velocity + (dt / 2) * (now.spin + next.spin);
        return later;
      }
      case Stepper::runge_kutta_4: {
        const Rates k2 = rates(moved(ball, now, dt / 2));
        const Rates k3 = rates(moved(ball, k2, dt / 2));
        const Rates k4 = rates(moved(ball, k3, dt));
        Ball<double> later = moved(ball, now, dt / 6);
        later = moved(later, k2, dt / 3);
        later = moved(later, k3, dt / 3);
        return moved(later, k4, dt / 6);
      }
    }
    return ball;
  }

  void advance_all(double dt) {
    for (Ball<double>& ball : out_.balls) {
      if (is_moving(ball)) {
        ball = stepped(ball, dt);
      }
    }
  }

  void step_and_resolve(double t) {
    settle_states(step_);
    count_operations();
    advance_all(step_);
    for (std::size_t i = 0; i < out_.balls.count; ++i) {
      resolve_table(i, t + step_);
      for (std::size_t k = i + 1; k < out_.balls.count; ++k) {
        resolve_pair(i, k, t + step_);
      }
    }
  }

  // Steps to the first contact within the step, at constant velocity, resolves it and goes on
  // with what is left of the step.
  void step_backing_up(double t) {
    settle_states(step_);
    double left = step_;
    for (int i = 0; i < 1000 && left > 0; ++i) {
      count_operations();
      const double dt = time_to_first_contact(left);
      advance_all(dt);
      left -= dt;
      if (left > 0) {
        for (std::size_t k = 0; k < out_.balls.count; ++k) {
          resolve_table(k, t + step_ - left);
          for (std::size_t m = k + 1; m < out_.balls.count; ++m) {
            resolve_pair(k, m, t + step_ - left);
          }
        }
      }
    }
  }

  [[nodiscard]] double time_to_first_contact(double longest) const {
    double first = longest;
    for (std::size_t i = 0; i < out_.balls.count; ++i) {
      const Ball<double>& ball = out_.balls[i];
      if (is_moving(ball)) {
        first = std::min(first, time_to_table(ball));
      }
      for (std::size_t k = i + 1; k < out_.balls.count; ++k) {
        first = std::min(first, time_to_pair(ball, out_.balls[k]));
      }
    }
    return first;
  }

  [[nodiscard]] double time_to_table(const Ball<double>& ball) const {
    double first = INFINITY;
    for (const auto& rail : geometry_.rails) {
      const double speed = dot(ball.velocity, rail.into);
      const double gap = rail_gap(ball, rail);
      if (speed > 0 && gap > -step_ * speed) {
        first = std::min(first, std::max(0.0, gap / speed));
      }
    }
    for (const auto& mouth : geometry_.mouths) {
      const double speed = dot(ball.velocity, mouth.outward);
      if (speed > 0) {
        first = std::min(first,
                         std::max(0.0, (mouth.offset - dot(ball.position, mouth.outward)) / speed));
      }
    }
    return first;
  }

  [[nodiscard]] double time_to_pair(const Ball<double>& p, const Ball<double>& q) const {
    if (p.state == MotionState::pocketed || q.state == MotionState::pocketed ||
        (!is_moving(p) && !is_moving(q))) {
      return INFINITY;
    }
    const Vec2<double> d = q.position - p.position;
    const Vec2<double> v = q.velocity - p.velocity;
    const double closing = dot(d, v);
    const double excess = dot(d, d) - c_.reach_squared;
    const double discriminant = closing * closing - dot(v, v) * excess;
    if (closing >= 0 || discriminant < 0) {
      return INFINITY;
    }
    return std::max(0.0, excess / (-closing + std::sqrt(discriminant)));
  }

  [[nodiscard]] double rail_gap(const Ball<double>& ball,
                                const physics::StraightRail<double>& rail) const {
    const double at = rail.axis == physics::Axis::x ? ball.position.x : ball.position.y;
    return rail.side * (rail.centre_line - at);
  }

  void resolve_table(std::size_t i, double t) {
    Ball<double>& ball = out_.balls[i];
    if (!is_moving(ball)) {
      return;
    }
    const double slack = 1e-12;  // of the backed-up contact's rounding
    for (const auto& mouth : geometry_.mouths) {
      const bool beyond = dot(ball.position, mouth.outward) >= mouth.offset - slack;
      const Vec2<double> along = mouth.to - mouth.from;
      const double foot = dot(ball.position - mouth.from, along);
      if (beyond && dot(ball.velocity, mouth.outward) > 0 && foot >= 0 &&
          foot <= dot(along, along)) {
        pocket(ball, mouth.pocket, t);
        return;
      }
    }
    for (const auto& rail : geometry_.rails) {
      if (rail_gap(ball, rail) <= slack && dot(ball.velocity, rail.into) > 0) {
        ball = physics::settled(physics::after_cushion(ball, rail.into, scene_.materials, nose_),
                                c_.radius);
        const double speed = dot(ball.velocity, rail.into);
        if (speed > -c_.separation_speed) {
          ball.velocity = ball.velocity - (speed + c_.separation_speed) * rail.into;
        }
        out_.events.push_back({t, EventType::rail_collision, ball.id, {}});
      }
    }
  }

  void pocket(Ball<double>& ball, physics::PocketId where, double t) {
    ball.state = MotionState::pocketed;
    ball.pocket = where;
    ball.velocity = {};
    ball.angular_velocity = {};
    out_.events.push_back({t, EventType::pocketed, ball.id, {}});
  }

  void resolve_pair(std::size_t i, std::size_t k, double t) {
    Ball<double>& p = out_.balls[i];
    Ball<double>& q = out_.balls[k];
    if (p.state == MotionState::pocketed || q.state == MotionState::pocketed ||
        (!is_moving(p) && !is_moving(q))) {
      return;
    }
    const Vec2<double> d = q.position - p.position;
    const double slack = 1e-12;
    if (dot(d, d) > c_.reach_squared + slack || dot(d, q.velocity - p.velocity) >= 0) {
      return;
    }
    const auto after = physics::collide(p, q, c_, scene_.materials.ball_friction);
    p = after.first;
    q = after.second;
    out_.events.push_back({t, EventType::ball_collision, p.id, q.id});
  }

  const physics::Scene<double>& scene_;
  Stepper stepper_;
  double step_;
  physics::Coefficients<double> c_;
  physics::TableGeometry<double> geometry_;
  physics::NoseAngle<double> nose_;
  SteppedShot out_;
};

}  // namespace

const char* name(Stepper stepper) {
  switch (stepper) {
    case Stepper::paper_discrete:
      return "paper's discrete scheme";
    case Stepper::semi_implicit_euler:
      return "semi-implicit Euler";
    case Stepper::verlet:
      return "Verlet";
    case Stepper::runge_kutta_4:
      return "Runge-Kutta 4";
  }
  return "";
}

physics::BallSet<double> balls_after_strike(const physics::Scene<double>& scene) {
  physics::BallSet<double> balls = scene.balls;
  for (Ball<double>& ball : balls) {
    if (scene.shot && ball.id == physics::cue_ball) {
      ball = physics::strike(ball, *scene.shot, scene.materials);
    }
    if (ball.state != MotionState::pocketed) {
      ball = physics::settled(ball, scene.materials.ball_radius);
    }
  }
  return balls;
}

SteppedShot step_through(const physics::Scene<double>& scene, Stepper stepper, double step,
                         double longest) {
  return Stepping(scene, stepper, step).run(longest);
}

}  // namespace poolhall::bench
