#include "physics/reference/reference_contacts.hpp"

#include <boost/math/constants/constants.hpp>

#include <stdexcept>

namespace poolhall::physics::reference {

namespace {

Number degrees(double x) {
  return Number(x) * boost::math::constants::pi<Number>() / 180;
}

Number friction_coefficient(const BallFriction& model, const Number& slip_speed) {
  if (const auto* constant = std::get_if<ConstantFriction>(&model)) {
    return constant->coefficient;
  }
  // Alciatore TP A.14.
  return Number("9.951e-3") + Number("0.108") * exp(Number("-1.088") * slip_speed);
}

struct CushionFrame {
  Vec2<Number> x;  // into the cushion
  Vec2<Number> y;  // along it, up x into
};

// Velocity and spin seen from the cushion: x into it, y along it, z up.
struct CushionState {
  Number vx, vy, wx, wy, wz;
};

CushionState seen_from(const CushionFrame& f, const Ball<Number>& ball) {
  const Vec2<Number> w{ball.angular_velocity.x, ball.angular_velocity.y};
  return {dot(ball.velocity, f.x), dot(ball.velocity, f.y), dot(w, f.x), dot(w, f.y),
          ball.angular_velocity.z};
}

Ball<Number> seen_from_table(const CushionFrame& f, const CushionState& s, Ball<Number> ball) {
  ball.velocity = s.vx * f.x + s.vy * f.y;
  const Vec2<Number> w = s.wx * f.x + s.wy * f.y;
  ball.angular_velocity = {w.x, w.y, s.wz};
  return ball;
}

// Han 2005 in the form of physics.md 5; `spring` shares it with a restitution of its own.
CushionState han(CushionState s, const Number& restitution, const Number& friction,
                 const Number& nose_height, const MotionConstants& c) {
  const Number sin_th = nose_height / c.radius - 1;
  const Number cos_th = sqrt(1 - sin_th * sin_th);
  const Number inertia = 2 * c.mass * c.radius * c.radius / 5;
  const Number sx = s.vx * sin_th + c.radius * s.wy;
  const Number sy = -s.vy - c.radius * s.wz * cos_th + c.radius * s.wx * sin_th;
  const Number pze = (1 + restitution) * c.mass * s.vx * cos_th;
  const Number size = sqrt(sx * sx + sy * sy);
  Number factor = 2 * c.mass / 7;
  if (size > 0 && factor * size > friction * pze) {
    factor = friction * pze / size;
  }
  const Number p_x = factor * sx;
  const Number p_y = factor * sy;
  const Number px = -p_x * sin_th - pze * cos_th;
  const Number py = p_y;
  const Number pz = p_x * cos_th - pze * sin_th;
  s.vx += px / c.mass;
  s.vy += py / c.mass;
  const Number k = c.radius / inertia;
  s.wx += -k * py * sin_th;
  s.wy += k * (px * sin_th - pz * cos_th);
  s.wz += k * py * cos_th;
  return s;
}

Number nose(const std::optional<double>& table, const std::optional<double>& cushion,
            const MotionConstants& c) {
  if (cushion) {
    return *cushion;
  }
  return table ? Number(*table) : Number(c.radius * 128 / 100);
}

Number spring_restitution(const SpringCushion& spring) {
  const Number z = spring.damping_ratio;
  const Number pi = boost::math::constants::pi<Number>();
  return exp(-z * (pi - 2 * asin(z)) / sqrt(1 - z * z));
}

}  // namespace

Ball<Number> struck(Ball<Number> ball, const ReferenceShot& shot, const Materials& materials,
                    const MotionConstants& c) {
  const Number a = Number(shot.a) / 1000;
  const Number b = Number(shot.b) / 1000;
  const Number sin_t = sin(degrees(shot.theta));
  const Number cos_t = shot.theta == 90 ? Number(0) : Number(cos(degrees(shot.theta)));
  const Number depth = sqrt(c.radius * c.radius - a * a - b * b);
  const Number lever = b * cos_t - depth * sin_t;
  const Number impulse = (1 + Number(materials.tip_restitution)) * c.mass * Number(shot.v) /
                         (1 + c.mass / Number(materials.cue_mass) +
                          5 / (2 * c.radius * c.radius) * (a * a + lever * lever));
  const Number inertia = 2 * c.mass * c.radius * c.radius / 5;
  const Vec2<Number> ahead{cos(degrees(shot.phi)), sin(degrees(shot.phi))};
  const Vec2<Number> left{-ahead.y, ahead.x};
  // Cue frame: i is left of the shot, j towards the player.
  const Number wi = impulse * (b * cos_t - depth * sin_t) / inertia;
  const Number wj = impulse * a * sin_t / inertia;
  const Vec2<Number> w = wi * left - wj * ahead;
  ball.angular_velocity = {w.x, w.y, Number(-impulse * a * cos_t / inertia)};
  Vec2<Number> heading = ahead;
  if (materials.squirt_end_mass_ratio != 0) {
    const Number a_hat = a / c.radius;
    const Number rest = 1 - a_hat * a_hat;
    const Number tangent = Number("2.5") * a_hat * sqrt(rest) /
                           (1 + Number(materials.squirt_end_mass_ratio) + Number("2.5") * rest);
    const Number norm = sqrt(1 + tangent * tangent);
    // Left english (a > 0) turns the ball to the right.
    heading = Number(1 / norm) * ahead - Number(tangent / norm) * left;
  }
  ball.velocity = Number(impulse * cos_t / c.mass) * heading;
  return classified(ball, c);
}

std::pair<Ball<Number>, Ball<Number>> after_ball_contact(const Ball<Number>& first,
                                                         const Ball<Number>& second,
                                                         const Materials& materials,
                                                         const MotionConstants& c) {
  const Vec2<Number> d = second.position - first.position;
  const Vec2<Number> n2 = Number(1 / sqrt(dot(d, d))) * d;
  const Vec3<Number> n{n2.x, n2.y, 0};
  const Vec2<Number> v2 = first.velocity - second.velocity;
  const Vec3<Number> v{v2.x, v2.y, 0};
  const Number closing = dot(v, n);
  const Number e = materials.ball_restitution;
  const Number apart = std::max<Number>(e * closing, materials.separation_speed);
  const Number jn = c.mass / 2 * (closing + apart);
  const Vec3<Number> s =
      v - closing * n + c.radius * cross(first.angular_velocity + second.angular_velocity, n);
  const Number size = sqrt(dot(s, s));
  Vec3<Number> unit{0, 0, 0};
  Number jt = 0;
  if (size > 0) {
    unit = Number(1 / size) * s;
    jt = std::min<Number>(friction_coefficient(materials.ball_friction, size) * jn,
                          c.mass * size / 7);
  }
  const Vec2<Number> kick{(jn * n.x + jt * unit.x) / c.mass, (jn * n.y + jt * unit.y) / c.mass};
  const Vec3<Number> twist = Number(-5 * jt / (2 * c.mass * c.radius)) * cross(n, unit);
  Ball<Number> one = first;
  Ball<Number> two = second;
  one.velocity = one.velocity - kick;
  two.velocity = two.velocity + kick;
  one.angular_velocity = one.angular_velocity + twist;
  two.angular_velocity = two.angular_velocity + twist;
  return {classified(one, c), classified(two, c)};
}

Ball<Number> after_cushion_contact(const Ball<Number>& ball, const Vec2<Number>& into,
                                   const Materials& materials,
                                   const std::optional<double>& table_nose_height,
                                   const MotionConstants& c) {
  const CushionFrame frame{into, {-into.y, into.x}};
  CushionState s = seen_from(frame, ball);
  if (const auto* damped = std::get_if<DampedCushion>(&materials.cushion)) {
    s.vx *= -Number(damped->normal);
    s.vy *= damped->tangential;
    s.wx *= damped->spin;
    s.wy *= damped->spin;
    s.wz *= damped->spin;
  } else if (const auto* han2005 = std::get_if<Han2005Cushion>(&materials.cushion)) {
    s = han(s, han2005->restitution, han2005->friction,
            nose(table_nose_height, han2005->nose_height, c), c);
  } else if (const auto* spring = std::get_if<SpringCushion>(&materials.cushion)) {
    s = han(s, spring_restitution(*spring), spring->friction,
            nose(table_nose_height, spring->nose_height, c), c);
  } else {
    throw std::invalid_argument("the reference has no mathavan2010 cushion");
  }
  s.vx = std::min<Number>(s.vx, -Number(materials.separation_speed));
  return classified(seen_from_table(frame, s, ball), c);
}

}  // namespace poolhall::physics::reference
