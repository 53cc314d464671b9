// What balls, cloth, cushions and cue are made of. SI units; doubles in every precision, so that
// two precisions simulate the same scene.
//
//   Materials m = preset_materials("olympiad").value();
//   if (Expected<void> sound = check_materials(m); !sound) refuse(sound.error());
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "physics/expected.hpp"

namespace poolhall::physics {

// v_n -> -normal v_n, v_t -> tangential v_t, w -> spin w: the Olympiad's cushion.
struct DampedCushion {
  double normal = 0.6;
  double tangential = 0.9;
  double spin = 0.1;
};

// Han 2005, "Dynamics in carom and three cushion billiards".
struct Han2005Cushion {
  double restitution = 0.85;
  double friction = 0.2;
  std::optional<double> nose_height{};  // m; unset: 1.28 ball radii
};

// Mathavan, Jackson, Parkin 2010, "A theoretical analysis of billiard ball dynamics under
// cushion impacts".
struct Mathavan2010Cushion {
  double restitution = 0.85;
  double friction = 0.2;
  std::optional<double> nose_height{};  // m; unset: 1.28 ball radii
};

// The paper's choice, after Marlow: a damped spring in the normal, friction as in Han.
struct SpringCushion {
  double stiffness = 1.7e4;  // N/m
  double damping_ratio = 0.0535;
  double friction = 0.2;
  std::optional<double> nose_height{};  // m; unset: 1.28 ball radii
};

using Cushion = std::variant<DampedCushion, Han2005Cushion, Mathavan2010Cushion, SpringCushion>;

// Ball-ball friction coefficient against the slip at the contact: a constant, or Alciatore's
// fit 9.951e-3 + 0.108 exp(-1.088 |s|) (TP A.14).
struct ConstantFriction {
  double coefficient = 0.01;
};
struct AlciatoreFriction {};
using BallFriction = std::variant<ConstantFriction, AlciatoreFriction>;

struct Materials {
  std::string name;                           // of the preset
  double gravity = 9.81;                      // m/s^2
  double ball_radius = 0.028575;              // m
  double ball_mass = 0.16301;                 // kg
  double mu_slide = 0.2;                      // sliding friction with the cloth
  double mu_roll = 0.015;                     // rolling friction with the cloth
  std::optional<double> mu_spin = 0.044;      // (10): deceleration 5 mu_spin g / (2 R)
  std::optional<double> spin_deceleration{};  // rad/s^2, instead of mu_spin
  double ball_restitution = 1;                // e_b
  BallFriction ball_friction = ConstantFriction{};
  Cushion cushion = DampedCushion{};
  double cue_mass = 0.5287;          // kg
  double tip_restitution = 1;        // e_t
  double squirt_end_mass_ratio = 0;  // m / m_end; 0 is no squirt
  double miscue_limit = 1;           // fraction of R
  double max_cue_speed = 10;         // m/s
  double separation_speed = 1e-3;    // m/s, v_sep
};

[[nodiscard]] std::optional<Materials> preset_materials(std::string_view name);
[[nodiscard]] std::vector<std::string> preset_material_names();

// Whether each number is finite and in its range; Error.field is the key in scenes and
// config files ("/mu_slide", "/cushion/restitution").
[[nodiscard]] Expected<void> check_materials(const Materials& materials);

}  // namespace poolhall::physics
