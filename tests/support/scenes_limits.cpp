// Strokes at their limits, numbers that are none, and shots that last for hours.
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

Scene<double> cue_ball_at(const Vec2<double>& place) {
  return with(on_table(), 0, place);
}

// (5) with the cue's line `arm` radii from the centre: speed of the impulse.
double impulse(double arm, double speed) {
  const Materials m = on_table().materials;
  return 2 * speed / (1 + m.ball_mass / m.cue_mass + 2.5 * arm * arm);
}

NamedScene strikes(std::string name, const ShotParameters<double>& shot, const Vec2<double>& v,
                   const Vec3<double>& w) {
  return runs(
      std::move(name), "v and w of (3)-(5)", struck(cue_ball_at({0.6, 1.6}), shot),
      [=](const Simulation<double>& r) -> Finding {
        const auto& ball = r.events.front().after[0];
        const Vec3<double>& spin = ball.angular_velocity;
        return all_of({near("vx", ball.velocity.x, v.x, 1e-14),
                       near("vy", ball.velocity.y, v.y, 1e-14), near("wx", spin.x, w.x, 1e-11),
                       near("wy", spin.y, w.y, 1e-11), near("wz", spin.z, w.z, 1e-11)});
      });
}

// A field of a scene that is no finite number, each of three ways.
template <class Set>
void add_not_finite(std::vector<NamedScene>& out, const std::string& field, Set set) {
  const auto judge = [field](const Outcome& outcome) -> Finding {
    if (outcome) {
      return {false, "was simulated"};
    }
    const physics::Error& error = outcome.error();
    return {error.fault == Fault::not_finite && error.field == field,
            "refused: " + std::string(name(error.fault)) + " at " + error.field};
  };
  for (const double value : {not_a_number, endless, -endless}) {
    Scene<double> scene = struck(cue_ball_at({0.5, 0.5}), {0, 0, 0, 0, 1});
    set(scene, value);
    out.push_back({in_words(value) + " at " + field,
                   "refused: not_finite at " + field,
                   std::move(scene),
                   {},
                   judge});
  }
}

void add_not_finite_balls(std::vector<NamedScene>& out) {
  using Number = double& (*)(Ball<double>&);
  const std::pair<const char*, Number> numbers[] = {
      {"x", [](Ball<double>& b) -> double& { return b.position.x; }},
      {"y", [](Ball<double>& b) -> double& { return b.position.y; }},
      {"vx", [](Ball<double>& b) -> double& { return b.velocity.x; }},
      {"vy", [](Ball<double>& b) -> double& { return b.velocity.y; }},
      {"wx", [](Ball<double>& b) -> double& { return b.angular_velocity.x; }},
      {"wy", [](Ball<double>& b) -> double& { return b.angular_velocity.y; }},
      {"wz", [](Ball<double>& b) -> double& { return b.angular_velocity.z; }}};
  for (const auto& [key, number] : numbers) {
    add_not_finite(out, std::string("/balls/0/") + key,
                   [number = number](Scene<double>& s, double v) { number(s.balls[0]) = v; });
  }
}

void add_not_finite_shots(std::vector<NamedScene>& out) {
  using Number = double ShotParameters<double>::*;
  const std::pair<const char*, Number> numbers[] = {{"a", &ShotParameters<double>::a},
                                                    {"b", &ShotParameters<double>::b},
                                                    {"theta", &ShotParameters<double>::theta},
                                                    {"phi", &ShotParameters<double>::phi},
                                                    {"v", &ShotParameters<double>::v}};
  for (const auto& [key, number] : numbers) {
    add_not_finite(out, std::string("/shot/") + key, [number = number](Scene<double>& s, double v) {
      ShotParameters<double> given = s.shot->given;
      given.*number = v;
      s.shot = cue_shot(given);
    });
  }
}

void add_not_finite_materials(std::vector<NamedScene>& out) {
  using Number = double Materials::*;
  const std::pair<const char*, Number> numbers[] = {
      {"gravity", &Materials::gravity},
      {"ball_radius", &Materials::ball_radius},
      {"ball_mass", &Materials::ball_mass},
      {"mu_slide", &Materials::mu_slide},
      {"mu_roll", &Materials::mu_roll},
      {"ball_restitution", &Materials::ball_restitution},
      {"cue_mass", &Materials::cue_mass},
      {"tip_restitution", &Materials::tip_restitution},
      {"squirt_end_mass_ratio", &Materials::squirt_end_mass_ratio},
      {"miscue_limit", &Materials::miscue_limit},
      {"max_cue_speed", &Materials::max_cue_speed},
      {"separation_speed", &Materials::separation_speed}};
  for (const auto& [key, number] : numbers) {
    add_not_finite(out, std::string("/physics/") + key,
                   [number = number](Scene<double>& s, double v) { s.materials.*number = v; });
  }
  add_not_finite(out, "/physics/mu_spin",
                 [](Scene<double>& s, double v) { s.materials.mu_spin = v; });
  add_not_finite(out, "/physics/spin_deceleration",
                 [](Scene<double>& s, double v) { s.materials.spin_deceleration = v; });
  add_not_finite(out, "/physics/ball_friction", [](Scene<double>& s, double v) {
    s.materials.ball_friction = ConstantFriction{v};
  });
  add_not_finite(out, "/physics/cushion/normal", [](Scene<double>& s, double v) {
    s.materials.cushion = DampedCushion{v, 0.9, 0.1};
  });
  add_not_finite(out, "/physics/cushion/stiffness", [](Scene<double>& s, double v) {
    s.materials.cushion = SpringCushion{.stiffness = v};
  });
  add_not_finite(out, "/physics/cushion/nose_height", [](Scene<double>& s, double v) {
    s.materials.cushion = Han2005Cushion{.nose_height = v};
  });
}

void add_not_finite_tables(std::vector<NamedScene>& out) {
  using Number = double Table::*;
  const std::pair<const char*, Number> numbers[] = {{"width", &Table::width},
                                                    {"length", &Table::length},
                                                    {"head_string", &Table::head_string},
                                                    {"foot_spot", &Table::foot_spot_x}};
  for (const auto& [key, number] : numbers) {
    add_not_finite(out, std::string("/table/") + key,
                   [number = number](Scene<double>& s, double v) { s.table.*number = v; });
  }
  add_not_finite(out, "/table/nose_height",
                 [](Scene<double>& s, double v) { s.table.nose_height = v; });
  add_not_finite(out, "/table/pockets/corner", [](Scene<double>& s, double v) {
    s.table.pockets = MouthLines{v, 0.12};
  });
  add_not_finite(out, "/table/pockets/side", [](Scene<double>& s, double v) {
    s.table.pockets = MouthLines{0.11, v};
  });
  add_not_finite(out, "/table/pockets/corner/depth", [](Scene<double>& s, double v) {
    s.table = *preset_table("bar7");
    std::get<Jaws>(s.table.pockets).corner.depth = v;
  });
  add_not_finite(out, "/table/pockets/side/jaw_radius", [](Scene<double>& s, double v) {
    s.table = *preset_table("bar7");
    std::get<Jaws>(s.table.pockets).side.jaw_radius = v;
  });
}

// Where a ball that nothing slows is after t seconds between two rails, in long double.
double unfolded(double from, double v, double t, double extent) {
  const long double room = static_cast<long double>(extent) - ball_diameter;
  long double way = std::fmod(
      static_cast<long double>(from) - ball_radius + static_cast<long double>(v) * t, 2 * room);
  way = way < 0 ? way + 2 * room : way;
  return static_cast<double>(ball_radius + (way <= room ? way : 2 * room - way));
}

}  // namespace

void add_strokes(std::vector<NamedScene>& out) {
  constexpr double radius_mm = 28.575;
  const double turn = 2.5 / ball_radius;
  const double rim = impulse(1, 2);
  // A cue along +y: left is -x, w about x is draw and follow.
  out.push_back(strikes("tip offset exactly R, to the left", {radius_mm, 0, 0, 90, 2}, {0, rim},
                        {0, 0, -turn * rim}));
  out.push_back(strikes("tip offset exactly R, above", {0, radius_mm, 0, 90, 2}, {0, rim},
                        {-turn * rim, 0, 0}));
  out.push_back(strikes("tip offset exactly R, below", {0, -radius_mm, 0, 90, 2}, {0, rim},
                        {turn * rim, 0, 0}));
  const double half = radius_mm / std::numbers::sqrt2;
  const double share = turn * rim / std::numbers::sqrt2;
  out.push_back(strikes("tip offset exactly R, aslant", {half, half, 0, 90, 2}, {0, rim},
                        {-share, 0, -share}));
  out.push_back(is_refused("tip offset an ulp of 1e-12 beyond R", Fault::tip_off_ball, "/shot/a",
                           struck(cue_ball_at({0.6, 1}), {radius_mm * (1 + 1e-12), 0, 0, 90, 2})));
  // Straight down at a place half a radius behind the centre: all draw, no speed.
  const double behind = std::sqrt(0.75);
  const double down = impulse(0.5, 2);
  out.push_back(strikes("masse at 90 degrees, behind the centre",
                        {0, radius_mm * behind, 90, 90, 2}, {0, 0}, {turn * down * 0.5, 0, 0}));
  const double beside = turn * impulse(std::sqrt(0.75), 2);
  out.push_back(strikes("masse at 90 degrees, behind and beside the centre",
                        {radius_mm * 0.5, radius_mm * 0.5, 90, 90, 2}, {0, 0},
                        {beside * std::sqrt(0.5), -beside * 0.5, 0}));
  Scene<double> exact = on_table();
  exact.materials.ball_radius = 1.0 / 32;
  out.push_back(comes_as("masse at 90 degrees, on top: nothing moves", "stri0",
                         struck(with(exact, 0, {0.6, 1}), {0, 31.25, 90, 90, 2})));
  out.push_back(is_refused("cue at 90.0001 degrees", Fault::out_of_range, "/shot/theta",
                           struck(cue_ball_at({0.6, 1}), {0, 0, 90.0001, 0, 2})));
  out.push_back(is_refused("cue at no speed", Fault::out_of_range, "/shot/v",
                           struck(cue_ball_at({0.6, 1}), {0, 0, 0, 0, 0})));
  for (const double v : {5e-324, 1e-300, 1e-9}) {
    out.push_back(
        ends("cue at " + in_words(v) + " m/s", struck(cue_ball_at({0.6, 1}), {1, 2, 3, 40, v})));
  }
  out.push_back(
      ends("heading of 1e300 degrees", struck(cue_ball_at({0.6, 1}), {1, 2, 3, 1e300, 2})));
}

void add_refusals(std::vector<NamedScene>& out) {
  add_not_finite_balls(out);
  add_not_finite_shots(out);
  add_not_finite_materials(out);
  add_not_finite_tables(out);
  for (const double t : {not_a_number, endless, -1.0}) {
    NamedScene scene = is_refused("t_max of " + in_words(t), Fault::out_of_range, "/t_max",
                                  cue_ball_at({0.5, 0.5}), {.t_max = t});
    out.push_back(std::move(scene));
  }
  Scene<double> contradicting = with(on_table(), 0, {0.5, 0.5}, {1, 0});
  contradicting.balls[0].state = MotionState::rolling;
  out.push_back(is_refused("a state that contradicts the velocities", Fault::inconsistent_state,
                           "/balls/0/state", std::move(contradicting)));
}

void add_long_runs(std::vector<NamedScene>& out) {
  for (const double hours : {1e4, 1e5}) {
    const Vec2<double> from{0.5, 0.5}, v{0.9, 0.7};
    const Scene<double> scene = with(frictionless_box(), 0, from, v);
    const Table table = scene.table;
    // Every wall is met to an ulp of its coordinate.
    const double walls = hours * (v.x / table.width + v.y / table.length);
    out.push_back(runs("between four rails for " + in_words(hours) + " s",
                       "the unfolded straight line, an ulp a rail", scene,
                       [=](const Simulation<double>& r) -> Finding {
                         const Vec2<double>& p = r.balls[0].position;
                         const double bound = walls * 2.3e-16;
                         return all_of(
                             {near("x", p.x, unfolded(from.x, v.x, hours, table.width), bound),
                              near("y", p.y, unfolded(from.y, v.y, hours, table.length), bound)});
                       },
                       {.t_max = hours, .event_limit = 300'000}));
  }
  Scene<double> turns = with(on_table(), 0, {0.5, 0.5}, {}, {0, 0, 1e6});
  turns.materials.mu_spin.reset();
  turns.materials.spin_deceleration = 100;
  out.push_back(runs(
      "a spin that lasts 1e4 s", "at rest at 1e4 s", std::move(turns),
      [](const Simulation<double>& r) -> Finding { return near("at", r.duration, 1e4, 1e-9); }));
  // Both come after hours of rest: nothing else moves them.
  Scene<double> late = with(with(frictionless_box(), 1, {0.2, 0.5}, {1e-5, 0}), 2, {0.35, 0.5});
  const double gap = 0.15 - ball_diameter;
  out.push_back(runs(
      "two balls that meet after 9285 s", "met at gap / v", std::move(late),
      [gap](const Simulation<double>& r) -> Finding {
        const auto* hit = first_of(r, EventType::ball_collision);
        return hit == nullptr ? Finding{false, sequence(r)} : near("at", hit->t, gap / 1e-5, 1e-9);
      },
      {.t_max = 1e4}));
}

}  // namespace poolhall::test_support
