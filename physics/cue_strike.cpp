#include "physics/cue_strike.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/cue_stick.hpp"
#include "physics/number_check.hpp"

namespace poolhall::physics {
namespace {

// An offset of exactly R, or exactly at the miscue limit, is possible however it was rounded.
constexpr double rounding = 1 + 1e-15;

constexpr double slowest_moved_speed = 0.01;  // m/s
constexpr double elevation_step = 0.1;        // degrees
constexpr int elevation_steps = 900;
constexpr int bisections = 60;

const Ball<double>* cue_ball_of(const BallSet<double>& balls) {
  const auto* found = std::find_if(balls.begin(), balls.end(), [](const Ball<double>& ball) {
    return ball.id == cue_ball && ball.state != MotionState::pocketed;
  });
  return found == balls.end() ? nullptr : found;
}

bool is_off_ball(const CueShot<double>& shot, const Materials& materials) {
  const double radius = materials.ball_radius;
  return square_root(shot.a * shot.a + shot.b * shot.b) > radius * rounding;
}

bool is_miscue(const CueShot<double>& shot, const Materials& materials) {
  const double radius = materials.ball_radius;
  return cue_line_distance(shot, radius) > materials.miscue_limit * radius * rounding;
}

std::string larger_offset(const CueShot<double>& shot) {
  return std::abs(shot.a) >= std::abs(shot.b) ? "/a" : "/b";
}

Expected<void> check_contact(const CueShot<double>& shot, const Materials& materials) {
  const double radius = 1000 * materials.ball_radius;
  if (is_off_ball(shot, materials)) {
    return tl::unexpected(
        Error{Fault::tip_off_ball, larger_offset(shot),
              "got a = " + decimal(shot.given.a) + ", b = " + decimal(shot.given.b) +
                  " mm, expected a point of the ball, a^2 + b^2 <= " + decimal(radius) + "^2"});
  }
  if (is_miscue(shot, materials)) {
    const double distance = 1000 * cue_line_distance(shot, materials.ball_radius);
    return tl::unexpected(Error{Fault::miscue, larger_offset(shot),
                                "the line of the cue passes the ball's centre at " +
                                    decimal(distance) + " mm, expected at most " +
                                    decimal(materials.miscue_limit * radius)});
  }
  return {};
}

Expected<void> check_room(const CueShot<double>& shot, const BallSet<double>& balls,
                          const Table& table, const Materials& materials) {
  const Ball<double>* ball = cue_ball_of(balls);
  if (ball == nullptr) {
    return tl::unexpected(
        Error{Fault::no_cue_ball, "", "got no cue ball on the table, expected ball 0"});
  }
  const CueStick stick = cue_stick(shot, ball->position, materials.ball_radius);
  const auto obstacle = obstacle_of(stick, balls, table, materials);
  if (!obstacle)
    return {};
  return tl::unexpected(Error{Fault::cue_obstructed, "/theta",
                              "the cue at " + decimal(shot.given.theta) +
                                  " degrees would pass through " + *obstacle +
                                  ", expected a higher cue or another aim"});
}

bool has_room(const CueShot<double>& shot, const Vec2<double>& ball, const BallSet<double>& balls,
              const Table& table, const Materials& materials) {
  const CueStick stick = cue_stick(shot, ball, materials.ball_radius);
  return !obstacle_of(stick, balls, table, materials);
}

Expected<void> check_numbers(const ShotParameters<double>& given, const Materials& materials) {
  const double lowest = std::numeric_limits<double>::lowest();
  const double highest = std::numeric_limits<double>::max();
  return check_all({{"/a", given.a, at_least(lowest), at_most(highest)},
                    {"/b", given.b, at_least(lowest), at_most(highest)},
                    {"/theta", given.theta, at_least(0), at_most(90)},
                    {"/phi", given.phi, at_least(lowest), at_most(highest)},
                    {"/v", given.v, above(0), at_most(materials.max_cue_speed)}});
}

// The largest k in [0, 1], to 1e-18, for which `is_possible` holds, given that it holds at 0.
template <class Predicate>
double largest_possible(Predicate is_possible) {
  if (is_possible(1.0))
    return 1;
  double low = 0;
  double high = 1;
  for (int i = 0; i < bisections; ++i) {
    const double middle = (low + high) / 2;
    (is_possible(middle) ? low : high) = middle;
  }
  return low;
}

ShotParameters<double> offset_scaled(ShotParameters<double> given, double k) {
  given.a *= k;
  given.b *= k;
  return given;
}

// The same with the offset seen along the cue: k = 0 is the cue aimed at the centre, which for a
// high cue is a contact point high on the ball.
ShotParameters<double> line_scaled(const ShotParameters<double>& given, double k,
                                   double ball_radius) {
  const CueShot<double> shot = cue_shot(given);
  const double c = contact_depth(shot, ball_radius);
  const double a = k * shot.a;
  const double lift = k * (shot.b * shot.elevation.cosine - c * shot.elevation.sine);
  const double depth = std::sqrt(std::max(0.0, ball_radius * ball_radius - a * a - lift * lift));
  ShotParameters<double> scaled = given;
  scaled.a *= k;
  scaled.b = 1000 * (lift * shot.elevation.cosine + depth * shot.elevation.sine);
  return scaled;
}

ShotParameters<double> within_ball(const ShotParameters<double>& given,
                                   const Materials& materials) {
  const double k = largest_possible(
      [&](double scale) { return !is_off_ball(cue_shot(offset_scaled(given, scale)), materials); });
  return offset_scaled(given, k);
}

// The offset scaled towards the ball's centre to the miscue limit; where even the centre would be
// a miscue, because the cue is high, towards the line through the centre.
ShotParameters<double> within_miscue_limit(const ShotParameters<double>& given,
                                           const Materials& materials) {
  const auto is_sound = [&](const ShotParameters<double>& moved) {
    return !is_miscue(cue_shot(moved), materials);
  };
  if (is_sound(given))
    return given;
  if (is_sound(offset_scaled(given, 0))) {
    return offset_scaled(
        given, largest_possible([&](double k) { return is_sound(offset_scaled(given, k)); }));
  }
  const double radius = materials.ball_radius;
  return line_scaled(
      given, largest_possible([&](double k) { return is_sound(line_scaled(given, k, radius)); }),
      radius);
}

double finite_or(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

ShotParameters<double> in_range(const ShotParameters<double>& given, const Materials& materials) {
  ShotParameters<double> moved{finite_or(given.a, 0), finite_or(given.b, 0),
                               std::clamp(finite_or(given.theta, 0), 0.0, 90.0),
                               finite_or(given.phi, 0), finite_or(given.v, slowest_moved_speed)};
  moved.v = std::min(std::max(moved.v, slowest_moved_speed), materials.max_cue_speed);
  return within_ball(moved, materials);
}

}  // namespace

Expected<void> check_shot(const CueShot<double>& shot, const BallSet<double>& balls,
                          const Table& table, const Materials& materials) {
  return check_numbers(shot.given, materials)
      .and_then([&] { return check_contact(shot, materials); })
      .and_then([&] { return check_room(shot, balls, table, materials); });
}

NearestShot nearest_possible_shot(const CueShot<double>& shot, const BallSet<double>& balls,
                                  const Table& table, const Materials& materials) {
  if (check_shot(shot, balls, table, materials))
    return {shot, false};
  const ShotParameters<double> base = in_range(shot.given, materials);
  const Ball<double>* ball = cue_ball_of(balls);
  CueShot<double> moved = cue_shot(within_miscue_limit(base, materials));
  if (ball == nullptr)
    return {moved, true};
  for (int step = 0; step <= elevation_steps; ++step) {
    ShotParameters<double> raised = base;
    raised.theta = std::min(90.0, base.theta + elevation_step * step);
    moved = cue_shot(within_miscue_limit(raised, materials));
    if (has_room(moved, ball->position, balls, table, materials))
      return {moved, true};
    if (raised.theta == 90.0)
      break;
  }
  // A ball close behind is in the way even of an upright cue: the tip goes towards the top.
  const ShotParameters<double> upright = moved.given;
  for (int tenths = 9; tenths >= 0; --tenths) {
    moved = cue_shot(line_scaled(upright, tenths / 10.0, materials.ball_radius));
    if (has_room(moved, ball->position, balls, table, materials))
      break;
  }
  return {moved, true};
}

}  // namespace poolhall::physics
