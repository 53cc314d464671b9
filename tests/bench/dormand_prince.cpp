#include "tests/bench/dormand_prince.hpp"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <optional>

#include "physics/ball_collision.hpp"
#include "physics/coefficients.hpp"
#include "physics/cushion.hpp"
#include "physics/motion.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::bench {

namespace {

namespace odeint = boost::numeric::odeint;
using physics::Ball;
using physics::EventType;
using physics::MotionState;
using physics::Vec2;

// Seven numbers a ball: x, y, vx, vy, wx, wy, wz.
using Packed = std::vector<double>;
constexpr std::size_t per_ball = 7;
constexpr double longest_step = 0.01;  // s

// Something that happens when its gap has fallen to zero while closing.
struct Watch {
  enum class Kind : std::uint8_t { transition, rail, mouth, pair };
  Kind kind;
  std::size_t ball;
  std::size_t other;  // index of the rail, the mouth or the second ball
};

class Integration {
 public:
  Integration(const physics::Scene<double>& scene, double tolerance)
      : scene_(scene),
        tolerance_(tolerance),
        c_(physics::coefficients<double>(scene.materials)),
        geometry_(physics::table_geometry<double>(scene.table, scene.materials.ball_radius)),
        nose_(physics::nose_angle<double>(scene.table, scene.materials)),
        balls_(balls_after_strike(scene)) {}

  SteppedShot run(double longest) {
    double t = 0;
    while (t < longest && std::any_of(balls_.begin(), balls_.end(), is_moving)) {
      t = integrate_to_next_event(t, longest);
    }
    out_.ended = t < longest;
    out_.balls = balls_;
    return std::move(out_);
  }

 private:
  [[nodiscard]] static bool is_moving(const Ball<double>& ball) {
    return ball.state == MotionState::sliding || ball.state == MotionState::rolling;
  }

  [[nodiscard]] Packed packed() const {
    Packed x;
    for (const Ball<double>& b : balls_) {
      x.insert(x.end(), {b.position.x, b.position.y, b.velocity.x, b.velocity.y,
                         b.angular_velocity.x, b.angular_velocity.y, b.angular_velocity.z});
    }
    return x;
  }

  [[nodiscard]] Ball<double> unpacked(const Packed& x, std::size_t i) const {
    Ball<double> ball = balls_[i];
    const double* p = x.data() + i * per_ball;
    ball.position = {p[0], p[1]};
    ball.velocity = {p[2], p[3]};
    ball.angular_velocity = {p[4], p[5], p[6]};
    return ball;
  }

  // Equations of motion; the motion states stand still between events.
  void rates(const Packed& x, Packed& slope) const {
    std::fill(slope.begin(), slope.end(), 0.0);
    for (std::size_t i = 0; i < balls_.count; ++i) {
      const Ball<double> ball = unpacked(x, i);
      double* d = slope.data() + i * per_ball;
      Vec2<double> a{};
      if (ball.state == MotionState::sliding) {
        const Vec2<double> slip =
            physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
        a = (-c_.slide_acceleration / std::max(length(slip), 1e-300)) * slip;
        d[4] = 2.5 * a.y / c_.radius;
        d[5] = -2.5 * a.x / c_.radius;
      } else if (ball.state == MotionState::rolling) {
        a = (-c_.roll_acceleration / std::max(length(ball.velocity), 1e-300)) * ball.velocity;
        d[4] = -a.y / c_.radius;
        d[5] = a.x / c_.radius;
      } else {
        continue;
      }
      d[0] = ball.velocity.x;
      d[1] = ball.velocity.y;
      d[2] = a.x;
      d[3] = a.y;
    }
  }

  // The centres' place is convex: whichever rail's or corner mouth's whole line is passed first is
  // met between its ends. A side mouth lies in the long rails' line.
  [[nodiscard]] static bool is_side(const physics::MouthLine<double>& mouth) {
    return mouth.outward.y == 0;
  }
  [[nodiscard]] std::optional<physics::PocketId> side_pocket_at(
      const Ball<double>& ball, const physics::StraightRail<double>& rail) const {
    for (const auto& mouth : geometry_.mouths) {
      const double from = std::min(mouth.from.y, mouth.to.y);
      const double to = std::max(mouth.from.y, mouth.to.y);
      if (is_side(mouth) && dot(mouth.outward, rail.into) > 0 && ball.position.y >= from &&
          ball.position.y <= to) {
        return mouth.pocket;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Watch> watches() const {
    std::vector<Watch> all;
    for (std::size_t i = 0; i < balls_.count; ++i) {
      if (is_moving(balls_[i])) {
        all.push_back({Watch::Kind::transition, i, 0});
        for (std::size_t m = 0; m < geometry_.mouths.size; ++m) {
          if (!is_side(geometry_.mouths[m])) {
            all.push_back({Watch::Kind::mouth, i, m});
          }
        }
        for (std::size_t r = 0; r < geometry_.rails.size; ++r) {
          all.push_back({Watch::Kind::rail, i, r});
        }
      }
      for (std::size_t k = i + 1; k < balls_.count; ++k) {
        const bool down =
            balls_[i].state == MotionState::pocketed || balls_[k].state == MotionState::pocketed;
        if (!down && (is_moving(balls_[i]) || is_moving(balls_[k]))) {
          all.push_back({Watch::Kind::pair, i, k});
        }
      }
    }
    return all;
  }

  // What is left of a transition: the slip (or speed) along what it was when the segment began.
  [[nodiscard]] double left_of_state(const Ball<double>& now, const Ball<double>& began) const {
    if (began.state == MotionState::rolling) {
      return dot(now.velocity, began.velocity);
    }
    return dot(physics::cloth_slip(now.velocity, now.angular_velocity, c_.radius),
               physics::cloth_slip(began.velocity, began.angular_velocity, c_.radius));
  }

  [[nodiscard]] double gap(const Watch& w, const Packed& x) const {
    const Ball<double> ball = unpacked(x, w.ball);
    switch (w.kind) {
      case Watch::Kind::transition:
        return left_of_state(ball, balls_[w.ball]);
      case Watch::Kind::rail: {
        const auto& rail = geometry_.rails[w.other];
        const double at = rail.axis == physics::Axis::x ? ball.position.x : ball.position.y;
        return rail.side * (rail.centre_line - at);
      }
      case Watch::Kind::mouth: {
        const auto& mouth = geometry_.mouths[w.other];
        return mouth.offset - dot(ball.position, mouth.outward);
      }
      case Watch::Kind::pair:
        return length(unpacked(x, w.other).position - ball.position) - c_.diameter;
    }
    return 1;
  }

  [[nodiscard]] bool closing(const Watch& w, const Packed& x) const {
    const Ball<double> ball = unpacked(x, w.ball);
    switch (w.kind) {
      case Watch::Kind::transition:
        return true;
      case Watch::Kind::rail:
        return dot(ball.velocity, geometry_.rails[w.other].into) > 0;
      case Watch::Kind::mouth:
        return dot(ball.velocity, geometry_.mouths[w.other].outward) > 0;
      case Watch::Kind::pair: {
        const Ball<double> other = unpacked(x, w.other);
        return dot(other.position - ball.position, other.velocity - ball.velocity) < 0;
      }
    }
    return false;
  }

  double integrate_to_next_event(double start, double longest) {
    auto stepper = odeint::make_dense_output(tolerance_, tolerance_, longest_step,
                                             odeint::runge_kutta_dopri5<Packed>());
    const auto system = [this](const Packed& x, Packed& slope, double) { rates(x, slope); };
    stepper.initialize(packed(), start, 1e-4);
    const std::vector<Watch> all = watches();
    while (stepper.current_time() < longest) {
      const auto [from, to] = stepper.do_step(system);
      ++out_.steps;
      std::optional<Watch> first;
      double when = to;
      for (const Watch& w : all) {
        const std::optional<double> closed = closed_within_step(stepper, w, from, to);
        const double t = closed ? located(stepper, w, from, *closed) : to;
        if (closed && (!first || t < when)) {
          first = w;
          when = t;
        }
      }
      if (first) {
        Packed x(balls_.count * per_ball);
        stepper.calc_state(when, x);
        take(x, when - start);
        resolve(*first, when);
        return when;
      }
    }
    take(stepper.current_state(), stepper.current_time() - start);
    return stepper.current_time();
  }

  // A time in the step at which the gap is closed, if there is one: at its end, or, of a pair that
  // has passed, when it was closest.
  template <class DenseOutput>
  std::optional<double> closed_within_step(DenseOutput& stepper, const Watch& w, double from,
                                           double to) const {
    if (gap(w, stepper.current_state()) <= 0 && closing(w, stepper.current_state())) {
      return to;
    }
    if (w.kind != Watch::Kind::pair || !closing(w, stepper.previous_state()) ||
        closing(w, stepper.current_state())) {
      return std::nullopt;
    }
    Packed x(balls_.count * per_ball);
    double low = from, high = to;
    for (int i = 0; i < 40; ++i) {
      const double middle = low + (high - low) / 2;
      stepper.calc_state(middle, x);
      (closing(w, x) ? low : high) = middle;
    }
    stepper.calc_state(low, x);
    return gap(w, x) <= 0 ? std::optional(low) : std::nullopt;
  }

  // Bisection of the dense output for the time at which the gap closes.
  template <class DenseOutput>
  double located(DenseOutput& stepper, const Watch& w, double low, double high) const {
    Packed x(balls_.count * per_ball);
    stepper.calc_state(low, x);
    if (gap(w, x) <= 0) {
      return low;
    }
    while (high - low > tolerance_ * 1e-3) {
      const double middle = low + (high - low) / 2;
      if (middle <= low || middle >= high) {
        break;
      }
      stepper.calc_state(middle, x);
      (gap(w, x) <= 0 ? high : low) = middle;
    }
    return high;
  }

  void take(const Packed& x, double duration) {
    const double lost = c_.spin_deceleration * duration;
    for (std::size_t i = 0; i < balls_.count; ++i) {
      balls_[i] = unpacked(x, i);
      double& spin = balls_[i].angular_velocity.z;
      spin = spin > lost ? spin - lost : spin < -lost ? spin + lost : 0;
    }
  }

  void pocket(Ball<double>& ball, physics::PocketId where, double t) {
    ball.state = MotionState::pocketed;
    ball.pocket = where;
    ball.velocity = {};
    ball.angular_velocity = {};
    out_.events.push_back({t, EventType::pocketed, ball.id, {}});
  }

  void resolve(const Watch& w, double t) {
    Ball<double>& ball = balls_[w.ball];
    switch (w.kind) {
      case Watch::Kind::transition:
        end_state(ball);
        break;
      case Watch::Kind::rail: {
        const auto& rail = geometry_.rails[w.other];
        if (const auto side = side_pocket_at(ball, rail)) {
          pocket(ball, *side, t);
          break;
        }
        ball = physics::after_cushion(ball, rail.into, scene_.materials, nose_);
        const double speed = std::max(0.0, dot(ball.velocity, rail.into) + c_.separation_speed);
        ball.velocity = ball.velocity - speed * rail.into;
        ball = physics::settled(ball, c_.radius);
        out_.events.push_back({t, EventType::rail_collision, ball.id, {}});
        break;
      }
      case Watch::Kind::mouth:
        pocket(ball, geometry_.mouths[w.other].pocket, t);
        break;
      case Watch::Kind::pair: {
        const auto after =
            physics::collide(ball, balls_[w.other], c_, scene_.materials.ball_friction);
        out_.events.push_back({t, EventType::ball_collision, ball.id, balls_[w.other].id});
        ball = after.first;
        balls_[w.other] = after.second;
        break;
      }
    }
  }

  void end_state(Ball<double>& ball) const {
    if (ball.state == MotionState::sliding) {
      const Vec2<double> slip =
          physics::cloth_slip(ball.velocity, ball.angular_velocity, c_.radius);
      ball.velocity = ball.velocity - (2.0 / 7.0) * slip;
      ball.angular_velocity =
          physics::rolling_spin(ball.velocity, ball.angular_velocity.z, c_.radius);
      ball.state = MotionState::rolling;
    } else {
      ball.velocity = {};
      ball.angular_velocity.x = ball.angular_velocity.y = 0;
      ball.state = ball.angular_velocity.z == 0 ? MotionState::stationary : MotionState::spinning;
    }
  }

  const physics::Scene<double>& scene_;
  double tolerance_;
  physics::Coefficients<double> c_;
  physics::TableGeometry<double> geometry_;
  physics::NoseAngle<double> nose_;
  physics::BallSet<double> balls_;
  SteppedShot out_;
};

}  // namespace

SteppedShot integrate_adaptively(const physics::Scene<double>& scene, double tolerance,
                                 double longest) {
  return Integration(scene, tolerance).run(longest);
}

}  // namespace poolhall::bench
