// The cue strikes the ball: (3)-(5) of the paper with tip restitution and squirt, and what makes
// a strike impossible.
//
//   CueShot<double> shot = cue_shot_from_degrees(1.0, -2.0, 5.0, 90.0, 3.0);
//   if (auto possible = check_shot(shot, balls, table, materials); !possible) refuse(...);
//   Ball<double> struck = strike(cue_ball, shot, materials);
#pragma once

#include "physics/ball.hpp"
#include "physics/expected.hpp"
#include "physics/materials.hpp"
#include "physics/math.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

// A shot as players, files and the wire give it: millimetres and degrees.
template <class Real>
struct ShotParameters {
  Real a{};      // mm, offset of the contact point to the left as the player sees it
  Real b{};      // mm, height of the contact point above the ball's centre
  Real theta{};  // degrees, elevation of the cue, 0..90
  Real phi{};    // degrees, heading, counter-clockwise from +x
  Real v{};      // m/s, of the cue before the strike

  friend constexpr bool operator==(const ShotParameters&, const ShotParameters&) = default;
};

// The same shot in SI units and radians. Made by cue_shot or cue_shot_from_degrees only: degrees
// rounded to radians would already cost more than a whole simulated shot may, so that the
// directions come from the degrees, and `theta`, `phi` are there to be read.
template <class Real>
struct CueShot {
  Real a{};                      // m
  Real b{};                      // m
  Real theta{};                  // rad
  Real phi{};                    // rad
  Real speed{};                  // m/s
  Direction<Real> elevation{};   // cosine and sine of theta
  Direction<Real> heading{};     // cosine and sine of phi
  ShotParameters<Real> given{};  // what it was made from, to the last bit
};

// Lengths are right to half an ulp, directions to one, and exact at multiples of 90 degrees;
// headings that are mirror images have directions that are mirror images.
template <class Real>
[[nodiscard]] CueShot<Real> cue_shot(const ShotParameters<Real>& given) {
  const Real degree = pi<Real>() / Real(180);
  return {.a = given.a / Real(1000),
          .b = given.b / Real(1000),
          .theta = given.theta * degree,
          .phi = given.phi * degree,
          .speed = given.v,
          .elevation = direction_of_degrees(given.theta),
          .heading = direction_of_degrees(given.phi),
          .given = given};
}

template <class Real>
[[nodiscard]] CueShot<Real> cue_shot_from_degrees(const Real& a_mm, const Real& b_mm,
                                                  const Real& theta_deg, const Real& phi_deg,
                                                  const Real& v) {
  return cue_shot(ShotParameters<Real>{a_mm, b_mm, theta_deg, phi_deg, v});
}

// Velocity and spin of the cue ball right after the strike; the vertical part of the impulse is
// dropped (two-dimensional model), so that a high cue loses energy. The motion state is left for
// the caller to classify. `shot` must be possible.
template <class Real>
[[nodiscard]] Ball<Real> strike(const Ball<Real>& ball, const CueShot<Real>& shot,
                                const Materials& materials);

// Why `shot` cannot be played on this table with these balls; Error.field is one of "/a", "/b",
// "/theta", "/phi", "/v" or "".
[[nodiscard]] Expected<void> check_shot(const CueShot<double>& shot, const BallSet<double>& balls,
                                        const Table& table, const Materials& materials);

// The nearest shot that can be played, for what noise made impossible (physics.md 3).
struct NearestShot {
  CueShot<double> shot;
  bool moved = false;
};
[[nodiscard]] NearestShot nearest_possible_shot(const CueShot<double>& shot,
                                                const BallSet<double>& balls, const Table& table,
                                                const Materials& materials);

// Distance from the ball's centre to the line of the cue.
template <class Real>
[[nodiscard]] Real cue_line_distance(const CueShot<Real>& shot, const Real& ball_radius);

// How far the contact point lies behind the ball's centre: c = sqrt(R^2 - a^2 - b^2), 0 beyond
// the rim.
template <class Real>
[[nodiscard]] Real contact_depth(const CueShot<Real>& shot, const Real& ball_radius) {
  const bool is_a_larger = absolute(shot.a) > absolute(shot.b);
  const Real p = is_a_larger ? shot.a : shot.b;
  const Real q = is_a_larger ? shot.b : shot.a;
  // (R - p)(R + p) keeps the digits that R^2 - p^2 loses near the rim.
  const Real squared = (ball_radius - p) * (ball_radius + p) - q * q;
  return squared > Real(0) ? square_root(squared) : Real(0);
}

template <class Real>
Real cue_line_distance(const CueShot<Real>& shot, const Real& ball_radius) {
  const Real c = contact_depth(shot, ball_radius);
  const Real lift = shot.b * shot.elevation.cosine - c * shot.elevation.sine;
  return square_root(Real(shot.a * shot.a + lift * lift));
}

// Heading of the ball: that of the cue, turned by the squirt away from the struck side
// (Alciatore TP A.31; a ball struck on its left is turned to the right).
template <class Real>
[[nodiscard]] Direction<Real> squirted_heading(const CueShot<Real>& shot,
                                               const Materials& materials) {
  if (materials.squirt_end_mass_ratio == 0 || shot.a == Real(0))
    return shot.heading;
  const Real offset = shot.a / Real(materials.ball_radius);
  const Real rest = Real(1) - offset * offset;
  const Real depth = rest > Real(0) ? square_root(rest) : Real(0);
  const Real tangent = Real(2.5) * offset * depth /
                       (Real(1) + Real(materials.squirt_end_mass_ratio) + Real(2.5) * rest);
  const Real cosine = Real(1) / square_root(Real(Real(1) + tangent * tangent));
  const Real sine = tangent * cosine;
  return {shot.heading.cosine * cosine + shot.heading.sine * sine,
          shot.heading.sine * cosine - shot.heading.cosine * sine};
}

template <class Real>
Ball<Real> strike(const Ball<Real>& ball, const CueShot<Real>& shot, const Materials& materials) {
  const Real m(materials.ball_mass);
  const Real radius(materials.ball_radius);
  const Real mass_ratio = m / Real(materials.cue_mass);
  const Real restitution = Real(1) + Real(materials.tip_restitution);
  const Real cosine = shot.elevation.cosine;
  const Real sine = shot.elevation.sine;
  const Real c = contact_depth(shot, radius);
  const Real lift = shot.b * cosine - c * sine;
  const Real arm = (shot.a * shot.a + lift * lift) / (radius * radius);
  // (5) with restitution, as a speed: J / m.
  const Real impulse = restitution * shot.speed / (Real(1) + mass_ratio + Real(2.5) * arm);
  // J / I with I = 2/5 m R^2.
  const Real turn = Real(2.5) * impulse / (radius * radius);
  const Real about_left = turn * lift;
  const Real about_back = turn * shot.a * sine;
  const Direction<Real> heading = squirted_heading(shot, materials);

  Ball<Real> struck = ball;
  struck.velocity = {impulse * cosine * heading.cosine, impulse * cosine * heading.sine};
  // i is left of the shot, j back towards the player.
  struck.angular_velocity = {-about_left * shot.heading.sine - about_back * shot.heading.cosine,
                             about_left * shot.heading.cosine - about_back * shot.heading.sine,
                             -turn * shot.a * cosine};
  return struck;
}

}  // namespace poolhall::physics
