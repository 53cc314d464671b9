// What makes a scene impossible; the bodies of check_scene. Errors name the field as in a scene
// file: "/balls/3/x".
#pragma once

#include <cmath>
#include <string>

#include "physics/boundary.hpp"
#include "physics/jaws.hpp"
#include "physics/motion.hpp"
#include "physics/number_check.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {

namespace check {

inline constexpr double speed_limit = 1e6;  // m/s; beyond it squares lose their meaning

[[nodiscard]] inline std::string ball_field(std::size_t index, std::string_view key) {
  return "/balls/" + std::to_string(index) + "/" + std::string(key);
}

[[nodiscard]] inline tl::unexpected<Error> refuse(Fault fault, std::string field,
                                                  std::string reason) {
  return tl::unexpected(Error{fault, std::move(field), std::move(reason)});
}

template <class Real>
[[nodiscard]] std::string written(const Real& value) {
  return decimal(static_cast<double>(value));
}

template <class Real>
[[nodiscard]] Expected<void> number_in_range(const Real& value, const std::string& field,
                                             double limit) {
  const double number = static_cast<double>(value);
  if (!std::isfinite(number)) {
    return refuse(Fault::not_finite, field, "expected a finite number, got " + written(value));
  }
  if (!(std::abs(number) <= limit)) {
    return refuse(Fault::out_of_range, field,
                  "expected a magnitude of at most " + written(limit) + ", got " + written(value));
  }
  return {};
}

template <class Real>
[[nodiscard]] Expected<void> ball_numbers(const Ball<Real>& ball, std::size_t i, double radius) {
  const double turning = speed_limit / radius;
  struct Entry {
    const char* key;
    const Real* value;
    double limit;
  };
  const std::array<Entry, 7> entries{{{"x", &ball.position.x, 1e3},
                                      {"y", &ball.position.y, 1e3},
                                      {"vx", &ball.velocity.x, speed_limit},
                                      {"vy", &ball.velocity.y, speed_limit},
                                      {"wx", &ball.angular_velocity.x, turning},
                                      {"wy", &ball.angular_velocity.y, turning},
                                      {"wz", &ball.angular_velocity.z, turning}}};
  for (const Entry& entry : entries) {
    // Names are made for what is wrong alone: every shot is checked several times.
    const bool fine = std::abs(static_cast<double>(*entry.value)) <= entry.limit;
    if (!fine) {
      return number_in_range(*entry.value, ball_field(i, entry.key), entry.limit);
    }
  }
  return {};
}

template <class Real>
[[nodiscard]] Expected<void> ball_state(const Ball<Real>& ball, std::size_t i, const Real& radius) {
  const bool down = ball.state == MotionState::pocketed;
  if (down != ball.pocket.has_value()) {
    return refuse(Fault::inconsistent_state, ball_field(i, "state"),
                  down ? "a pocketed ball needs its pocket" : "only a pocketed ball has a pocket");
  }
  const MotionState implied = motion_state_of(ball.velocity, ball.angular_velocity, radius);
  if (!down && implied != ball.state) {
    return refuse(Fault::inconsistent_state, ball_field(i, "state"),
                  "the velocities make the ball " + std::string(name(implied)) + ", the state is " +
                      std::string(name(ball.state)));
  }
  return {};
}

template <class Real>
[[nodiscard]] Expected<void> ball_place(const Ball<Real>& ball, std::size_t i,
                                        const Boundary<Real>& bounds) {
  const Real slack(position_tolerance);
  const auto outside = [&](std::string_view axis, const Real& value) {
    return refuse(Fault::outside_table, ball_field(i, axis),
                  "expected a place on the table, " + written(value) + " is beyond the rail");
  };
  const Real x = ball.position.x, y = ball.position.y;
  if (x < bounds.low.x - slack || x > bounds.high.x + slack) {
    return outside("x", x);
  }
  if (y < bounds.low.y - slack || y > bounds.high.y + slack) {
    return outside("y", y);
  }
  const Real far_x = bounds.size.x - x, far_y = bounds.size.y - y;
  const Real near_corner = (x < far_x ? x : far_x) + (y < far_y ? y : far_y);
  if (bounds.has_mouths && near_corner < bounds.corner_line - slack) {
    return refuse(Fault::outside_table, ball_field(i, "x"),
                  "expected a place on the table, the ball is beyond the mouth line of a corner");
  }
  return {};
}

template <class Real>
[[nodiscard]] Expected<void> place_among_jaws(const Ball<Real>& ball, std::size_t i,
                                              const JawTable<Real>& jaws) {
  if (!jaws.has_room(ball.position, Real(position_tolerance))) {
    return refuse(Fault::outside_table, ball_field(i, "x"),
                  "expected a place on the table, the ball is in a cushion, a pocket or beyond");
  }
  return {};
}

template <class Real>
[[nodiscard]] Expected<void> no_overlap(const BallSet<Real>& balls, std::size_t i,
                                        const Real& diameter) {
  for (std::size_t k = 0; k < i; ++k) {
    if (balls[k].id == balls[i].id) {
      return refuse(Fault::duplicate_ball, ball_field(i, "id"),
                    "ball " + std::to_string(number(balls[i].id)) + " is there twice");
    }
    if (balls[k].state == MotionState::pocketed || balls[i].state == MotionState::pocketed) {
      continue;
    }
    if (length(balls[i].position - balls[k].position) < diameter - Real(position_tolerance)) {
      return refuse(Fault::overlap, ball_field(i, "x"),
                    "ball " + std::to_string(number(balls[i].id)) + " overlaps ball " +
                        std::to_string(number(balls[k].id)));
    }
  }
  return {};
}

template <class Real>
[[nodiscard]] BallSet<double> in_double(const BallSet<Real>& balls) {
  BallSet<double> out;
  out.count = balls.count;
  for (std::size_t i = 0; i < balls.count; ++i) {
    const auto as_double = [](const Real& x) { return static_cast<double>(x); };
    out[i].id = balls[i].id;
    out[i].state = balls[i].state;
    out[i].pocket = balls[i].pocket;
    out[i].position = {as_double(balls[i].position.x), as_double(balls[i].position.y)};
  }
  return out;
}

template <class Real>
[[nodiscard]] Expected<void> cue(const Scene<Real>& scene) {
  if (!scene.shot) {
    return {};
  }
  const bool there = std::any_of(scene.balls.begin(), scene.balls.end(), [](const Ball<Real>& b) {
    return b.id == cue_ball && b.state != MotionState::pocketed;
  });
  if (!there) {
    return refuse(Fault::no_cue_ball, "/shot", "expected ball 0 on the table, it is not there");
  }
  const auto& given = scene.shot->given;
  const auto shot = cue_shot_from_degrees(
      static_cast<double>(given.a), static_cast<double>(given.b), static_cast<double>(given.theta),
      static_cast<double>(given.phi), static_cast<double>(given.v));
  auto possible = check_shot(shot, in_double(scene.balls), scene.table, scene.materials);
  if (!possible) {
    return refuse(possible.error().fault, "/shot" + possible.error().field,
                  possible.error().reason);
  }
  return {};
}

[[nodiscard]] inline Expected<void> below(std::string_view parent, Expected<void> checked) {
  if (!checked) {
    checked.error().field = std::string(parent) + checked.error().field;
  }
  return checked;
}

}  // namespace check

template <class Real>
Expected<void> check_scene(const Scene<Real>& scene) {
  if (auto fine = check::below("/physics", check_materials(scene.materials)); !fine) {
    return fine;
  }
  if (auto fine = check::below("/table", check_table(scene.table, scene.materials.ball_radius));
      !fine) {
    return fine;
  }
  const Real radius(scene.materials.ball_radius);
  const Boundary<Real> bounds = boundary(scene.table, radius);
  const bool has_jaws = std::holds_alternative<Jaws>(scene.table.pockets);
  const JawTable<Real> jaws =
      has_jaws ? JawTable<Real>(scene.table, scene.materials.ball_radius) : JawTable<Real>();
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    const Ball<Real>& ball = scene.balls[i];
    if (number(ball.id) >= max_balls) {
      return check::refuse(Fault::out_of_range, check::ball_field(i, "id"),
                           "expected 0 to 15, got " + std::to_string(number(ball.id)));
    }
    if (ball.state != MotionState::pocketed) {
      if (auto fine = check::ball_numbers(ball, i, scene.materials.ball_radius); !fine) {
        return fine;
      }
    }
    if (auto fine = check::ball_state(ball, i, radius); !fine) {
      return fine;
    }
    if (ball.state != MotionState::pocketed) {
      if (auto fine = has_jaws ? check::place_among_jaws(ball, i, jaws)
                               : check::ball_place(ball, i, bounds);
          !fine) {
        return fine;
      }
    }
    if (auto fine = check::no_overlap(scene.balls, i, Real(Real(2) * radius)); !fine) {
      return fine;
    }
  }
  return check::cue(scene);
}

}  // namespace poolhall::physics
