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
#include "physics/wide.hpp"
#include "tests/bench/counted.hpp"

namespace poolhall::bench {

namespace {

using physics::Ball;
using physics::EventType;
using physics::MotionState;
using physics::Vec2;
using physics::Vec3;

// Rates of a ball's state.
template <class Real>
struct Rates {
  Vec2<Real> position;
  Vec2<Real> velocity;
  Vec3<Real> spin;
};

template <class Real>
class Stepping {
 public:
  Stepping(const physics::Scene<Real>& scene, Stepper stepper, Real step)
      : scene_(scene),
        stepper_(stepper),
        step_(step),
        c_(physics::coefficients<Real>(scene.materials)),
        geometry_(physics::table_geometry<Real>(scene.table, scene.materials.ball_radius)),
        nose_(physics::nose_angle<Real>(scene.table, scene.materials)) {
    balls_ = balls_after_strike(scene);
  }

  SteppedShot run(Real longest) {
    Real t(0);
    while (moving()) {
      if (t >= longest) {
        out_.ended = false;
        break;
      }
      stepper_ == Stepper::paper_discrete ? step_backing_up(t) : step_and_resolve(t);
      t += step_;
      ++out_.steps;
    }
    out_.balls.count = balls_.count;
    for (std::size_t i = 0; i < balls_.count; ++i) {
      out_.balls[i] = physics::converted<double>(balls_[i]);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] static bool is_moving(const Ball<Real>& ball) {
    return ball.state == MotionState::sliding || ball.state == MotionState::rolling;
  }

  [[nodiscard]] bool moving() const { return std::any_of(balls_.begin(), balls_.end(), is_moving); }

  // The paper's count: 3 a moving ball, 12 for its rails and pockets, 1 a pair.
  void count_operations() {
    const auto n = static_cast<std::size_t>(std::count_if(balls_.begin(), balls_.end(), is_moving));
    out_.operations += n * (61 - n) / 2;
  }

  // Ends the slide or the roll that friction would reverse within one step of `dt`.
  void settle_states(Real dt) {
    using std::abs;
    using std::copysign;
    for (Ball<Real>& ball : balls_) {
      if (ball.state == MotionState::sliding) {
        const Vec2<Real> slip =
            physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
        if (length(slip) <= Real(3.5) * c_.slide_acceleration * dt) {
          ball.velocity = ball.velocity - Real(2.0 / 7.0) * slip;
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
      const Real lost = c_.spin_deceleration * dt;
      const Real spin = ball.angular_velocity.z;
      ball.angular_velocity.z = abs(spin) <= lost ? Real(0) : spin - copysign(lost, spin);
    }
  }

  [[nodiscard]] Rates<Real> rates(const Ball<Real>& ball) const {
    Rates<Real> r{ball.velocity, {}, {}};
    if (ball.state == MotionState::sliding) {
      const Vec2<Real> slip = physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
      r.velocity = (-c_.slide_acceleration / length(slip)) * slip;
      r.spin = {Real(2.5) * r.velocity.y / c_.radius, Real(-2.5) * r.velocity.x / c_.radius,
                Real(0)};
    } else if (ball.state == MotionState::rolling && length(ball.velocity) > Real(0)) {
      r.velocity = (-c_.roll_acceleration / length(ball.velocity)) * ball.velocity;
      r.spin = {-r.velocity.y / c_.radius, r.velocity.x / c_.radius, Real(0)};
    }
    return r;
  }

  [[nodiscard]] static Ball<Real> moved(Ball<Real> ball, const Rates<Real>& r, Real dt) {
    ball.position = ball.position + dt * r.position;
    ball.velocity = ball.velocity + dt * r.velocity;
    ball.angular_velocity = ball.angular_velocity + dt * r.spin;
    return ball;
  }

  [[nodiscard]] Ball<Real> stepped(const Ball<Real>& ball, Real dt) const {
    const Rates<Real> now = rates(ball);
    switch (stepper_) {
      case Stepper::paper_discrete:
        return moved(ball, now, dt);
      case Stepper::semi_implicit_euler: {
        Ball<Real> later = moved(ball, {{}, now.velocity, now.spin}, dt);
        later.position = ball.position + dt * later.velocity;
        return later;
      }
      case Stepper::verlet: {
        Ball<Real> later = moved(ball, now, dt);
        later.position = later.position + (dt * dt / 2) * now.velocity;
        const Rates<Real> next = rates(later);
        later.velocity = ball.velocity + (dt / 2) * (now.velocity + next.velocity);
        later.angular_velocity = ball.angular_velocity + (dt / 2) * (now.spin + next.spin);
        return later;
      }
      case Stepper::runge_kutta_4: {
        const Rates<Real> k2 = rates(moved(ball, now, dt / 2));
        const Rates<Real> k3 = rates(moved(ball, k2, dt / 2));
        const Rates<Real> k4 = rates(moved(ball, k3, dt));
        Ball<Real> later = moved(ball, now, dt / 6);
        later = moved(later, k2, dt / 3);
        later = moved(later, k3, dt / 3);
        return moved(later, k4, dt / 6);
      }
    }
    return ball;
  }

  void advance_all(Real dt) {
    for (Ball<Real>& ball : balls_) {
      if (is_moving(ball)) {
        ball = stepped(ball, dt);
      }
    }
  }

  void step_and_resolve(Real t) {
    settle_states(step_);
    count_operations();
    advance_all(step_);
    for (std::size_t i = 0; i < balls_.count; ++i) {
      resolve_table(i, t + step_);
      for (std::size_t k = i + 1; k < balls_.count; ++k) {
        resolve_pair(i, k, t + step_);
      }
    }
  }

  // Steps to the first contact within the step, at constant velocity, resolves it and goes on
  // with what is left of the step.
  void step_backing_up(Real t) {
    settle_states(step_);
    Real left = step_;
    for (int i = 0; i < 1000 && left > Real(0); ++i) {
      count_operations();
      const Real dt = time_to_first_contact(left);
      advance_all(dt);
      left -= dt;
      if (left > Real(0)) {
        for (std::size_t k = 0; k < balls_.count; ++k) {
          resolve_table(k, t + step_ - left);
          for (std::size_t m = k + 1; m < balls_.count; ++m) {
            resolve_pair(k, m, t + step_ - left);
          }
        }
      }
    }
  }

  [[nodiscard]] Real time_to_first_contact(Real longest) const {
    Real first = longest;
    for (std::size_t i = 0; i < balls_.count; ++i) {
      const Ball<Real>& ball = balls_[i];
      if (is_moving(ball)) {
        first = std::min(first, time_to_table(ball));
      }
      for (std::size_t k = i + 1; k < balls_.count; ++k) {
        first = std::min(first, time_to_pair(ball, balls_[k]));
      }
    }
    return first;
  }

  [[nodiscard]] Real time_to_table(const Ball<Real>& ball) const {
    Real first(INFINITY);
    for (const auto& rail : geometry_.rails) {
      const Real speed = dot(ball.velocity, rail.into);
      const Real gap = rail_gap(ball, rail);
      if (speed > Real(0) && gap > -step_ * speed) {
        first = std::min(first, std::max(Real(0), gap / speed));
      }
    }
    for (const auto& mouth : geometry_.mouths) {
      const Real speed = dot(ball.velocity, mouth.outward);
      if (speed > Real(0)) {
        first = std::min(
            first, std::max(Real(0), (mouth.offset - dot(ball.position, mouth.outward)) / speed));
      }
    }
    return first;
  }

  [[nodiscard]] Real time_to_pair(const Ball<Real>& p, const Ball<Real>& q) const {
    using std::sqrt;
    if (p.state == MotionState::pocketed || q.state == MotionState::pocketed ||
        (!is_moving(p) && !is_moving(q))) {
      return Real(INFINITY);
    }
    const Vec2<Real> d = q.position - p.position;
    const Vec2<Real> v = q.velocity - p.velocity;
    const Real closing = dot(d, v);
    const Real excess = dot(d, d) - c_.reach_squared;
    const Real discriminant = closing * closing - dot(v, v) * excess;
    if (closing >= Real(0) || discriminant < Real(0)) {
      return Real(INFINITY);
    }
    return std::max(Real(0), excess / (-closing + sqrt(discriminant)));
  }

  [[nodiscard]] Real rail_gap(const Ball<Real>& ball,
                              const physics::StraightRail<Real>& rail) const {
    const Real at = rail.axis == physics::Axis::x ? ball.position.x : ball.position.y;
    return rail.side * (rail.centre_line - at);
  }

  void resolve_table(std::size_t i, Real t) {
    Ball<Real>& ball = balls_[i];
    if (!is_moving(ball)) {
      return;
    }
    const Real slack(1e-12);  // of the backed-up contact's rounding
    for (const auto& mouth : geometry_.mouths) {
      const bool beyond = dot(ball.position, mouth.outward) >= mouth.offset - slack;
      const Vec2<Real> along = mouth.to - mouth.from;
      const Real foot = dot(ball.position - mouth.from, along);
      if (beyond && dot(ball.velocity, mouth.outward) > Real(0) && foot >= Real(0) &&
          foot <= dot(along, along)) {
        pocket(ball, mouth.pocket, t);
        return;
      }
    }
    for (const auto& rail : geometry_.rails) {
      if (rail_gap(ball, rail) <= slack && dot(ball.velocity, rail.into) > Real(0)) {
        ball = physics::settled(physics::after_cushion(ball, rail.into, scene_.materials, nose_),
                                c_.radius);
        const Real speed = dot(ball.velocity, rail.into);
        if (speed > -c_.separation_speed) {
          ball.velocity = ball.velocity - (speed + c_.separation_speed) * rail.into;
        }
        out_.events.push_back({static_cast<double>(t), EventType::rail_collision, ball.id, {}});
      }
    }
  }

  void pocket(Ball<Real>& ball, physics::PocketId where, Real t) {
    ball.state = MotionState::pocketed;
    ball.pocket = where;
    ball.velocity = {};
    ball.angular_velocity = {};
    out_.events.push_back({static_cast<double>(t), EventType::pocketed, ball.id, {}});
  }

  void resolve_pair(std::size_t i, std::size_t k, Real t) {
    Ball<Real>& p = balls_[i];
    Ball<Real>& q = balls_[k];
    if (p.state == MotionState::pocketed || q.state == MotionState::pocketed ||
        (!is_moving(p) && !is_moving(q))) {
      return;
    }
    const Vec2<Real> d = q.position - p.position;
    const Real slack(1e-12);
    if (dot(d, d) > c_.reach_squared + slack || dot(d, q.velocity - p.velocity) >= Real(0)) {
      return;
    }
    const auto after = physics::collide(p, q, c_, scene_.materials.ball_friction);
    p = after.first;
    q = after.second;
    out_.events.push_back({static_cast<double>(t), EventType::ball_collision, p.id, q.id});
  }

  const physics::Scene<Real>& scene_;
  Stepper stepper_;
  Real step_;
  physics::Coefficients<Real> c_;
  physics::TableGeometry<Real> geometry_;
  physics::NoseAngle<Real> nose_;
  physics::BallSet<Real> balls_;
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

template <class Real>
physics::BallSet<Real> balls_after_strike(const physics::Scene<Real>& scene) {
  physics::BallSet<Real> balls = scene.balls;
  for (Ball<Real>& ball : balls) {
    if (scene.shot && ball.id == physics::cue_ball) {
      ball = physics::strike(ball, *scene.shot, scene.materials);
    }
    if (ball.state != MotionState::pocketed) {
      ball = physics::settled(ball, Real(scene.materials.ball_radius));
    }
  }
  return balls;
}

template <class Real>
SteppedShot step_through(const physics::Scene<Real>& scene, Stepper stepper, double step,
                         double longest) {
  return Stepping<Real>(scene, stepper, Real(step)).run(Real(longest));
}

template physics::BallSet<double> balls_after_strike(const physics::Scene<double>&);
template SteppedShot step_through(const physics::Scene<double>&, Stepper, double, double);
template SteppedShot step_through(const physics::Scene<Counted>&, Stepper, double, double);

}  // namespace poolhall::bench
