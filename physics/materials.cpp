#include "physics/materials.hpp"

#include <array>

#include "physics/number_check.hpp"

namespace poolhall::physics {
namespace {

// Bounds beyond which a number is a mistake rather than an extreme scene.
constexpr double huge = 1e9;

Materials olympiad() {
  Materials m;
  m.name = "olympiad";
  return m;
}

// Marlow's rolling friction, all else as the Olympiad's.
Materials marlow() {
  Materials m = olympiad();
  m.name = "marlow";
  m.mu_roll = 0.016;
  return m;
}

// A 6 oz ball, a 20 oz cue with a leather tip, and what has been measured since Marlow.
Materials modern() {
  Materials m;
  m.name = "modern";
  m.ball_mass = 0.170097;
  m.mu_roll = 0.01;
  m.mu_spin.reset();
  m.spin_deceleration = 10;
  m.ball_restitution = 0.95;
  m.ball_friction = AlciatoreFriction{};
  m.cushion = Han2005Cushion{};
  m.cue_mass = 0.567;
  m.tip_restitution = 0.73;
  m.miscue_limit = 0.5;
  return m;
}

constexpr std::array presets{olympiad, marlow, modern};

CheckedNumber nose_check(const std::optional<double>& height, double radius) {
  return {"/cushion/nose_height", height.value_or(radius), above(0), below(2 * radius)};
}

Expected<void> check_cushion(const DampedCushion& c, double) {
  return check_all({{"/cushion/normal", c.normal, at_least(0), at_most(1)},
                    {"/cushion/tangential", c.tangential, at_least(0), at_most(1)},
                    {"/cushion/spin", c.spin, at_least(0), at_most(1)}});
}

template <class Cushion>
Expected<void> check_cushion(const Cushion& c, double radius) {
  return check_all({{"/cushion/restitution", c.restitution, at_least(0), at_most(1)},
                    {"/cushion/friction", c.friction, at_least(0), at_most(huge)},
                    nose_check(c.nose_height, radius)});
}

Expected<void> check_cushion(const SpringCushion& c, double radius) {
  return check_all({{"/cushion/stiffness", c.stiffness, above(0), at_most(1e15)},
                    {"/cushion/damping_ratio", c.damping_ratio, at_least(0), below(1)},
                    {"/cushion/friction", c.friction, at_least(0), at_most(huge)},
                    nose_check(c.nose_height, radius)});
}

Expected<void> check_ball_friction(const BallFriction& friction) {
  const auto* constant = std::get_if<ConstantFriction>(&friction);
  if (constant == nullptr)
    return {};
  return check_number({"/ball_friction", constant->coefficient, at_least(0), at_most(huge)});
}

}  // namespace

std::optional<Materials> preset_materials(std::string_view name) {
  for (const auto& preset : presets) {
    if (Materials m = preset(); m.name == name)
      return m;
  }
  return std::nullopt;
}

std::vector<std::string> preset_material_names() {
  std::vector<std::string> names;
  for (const auto& preset : presets)
    names.push_back(preset().name);
  return names;
}

Expected<void> check_materials(const Materials& m) {
  return check_all(
             {
                 {"/gravity", m.gravity, above(0), at_most(huge)},
                 {"/ball_radius", m.ball_radius, above(0), at_most(1)},
                 {"/ball_mass", m.ball_mass, above(0), at_most(huge)},
                 {"/mu_slide", m.mu_slide, at_least(0), at_most(huge)},
                 {"/mu_roll", m.mu_roll, at_least(0), at_most(huge)},
                 {"/mu_spin", m.mu_spin.value_or(0), at_least(0), at_most(huge)},
                 {"/spin_deceleration", m.spin_deceleration.value_or(0), at_least(0),
                  at_most(1e15)},
                 {"/ball_restitution", m.ball_restitution, at_least(0), at_most(1)},
                 {"/cue_mass", m.cue_mass, above(0), at_most(huge)},
                 {"/tip_restitution", m.tip_restitution, at_least(0), at_most(1)},
                 {"/squirt_end_mass_ratio", m.squirt_end_mass_ratio, at_least(0), at_most(huge)},
                 {"/miscue_limit", m.miscue_limit, above(0), at_most(1)},
                 {"/max_cue_speed", m.max_cue_speed, above(0), at_most(1e4)},
                 {"/separation_speed", m.separation_speed, at_least(0), at_most(1)},
             })
      .and_then([&] { return check_ball_friction(m.ball_friction); })
      .and_then([&] {
        return std::visit([&](const auto& c) { return check_cushion(c, m.ball_radius); },
                          m.cushion);
      });
}

}  // namespace poolhall::physics
