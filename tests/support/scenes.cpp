#include "tests/support/scenes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "physics/motion.hpp"

namespace poolhall::test_support {

namespace {

using namespace physics;

constexpr double R = 0.028575;
constexpr double touching = 2 * R;

Scene<double> on_table(std::string_view table = "olympiad", std::string_view kind = "olympiad") {
  Scene<double> scene;
  scene.table = *preset_table(table);
  scene.materials = *preset_materials(kind);
  return scene;
}

Scene<double> closed_box() {
  Scene<double> scene = on_table();
  scene.table.pockets = NoPockets{};
  return scene;
}

Scene<double> with(Scene<double> scene, unsigned id, Vec2<double> at, Vec2<double> v = {},
                   Vec3<double> w = {}) {
  Ball<double>& ball = scene.balls[scene.balls.count++];
  ball.id = BallId{static_cast<std::uint8_t>(id)};
  ball.position = at;
  ball.velocity = v;
  ball.angular_velocity = w;
  ball.state = motion_state_of(v, w, scene.materials.ball_radius);
  return scene;
}

Scene<double> rolling(Scene<double> scene, unsigned id, Vec2<double> at, Vec2<double> v) {
  return with(std::move(scene), id, at, v, rolling_spin(v, 0.0, scene.materials.ball_radius));
}

std::string sequence(const Simulation<double>& result) {
  std::string words;
  for (const auto& event : result.events) {
    words += words.empty() ? "" : " ";
    words += name(event.type).substr(0, 4);
    words += std::to_string(number(event.after[0].id));
    if (event.ball_count == 2) {
      words += "+" + std::to_string(number(event.after[1].id));
    }
    if (event.type == EventType::transition) {
      words += ":" + std::string(name(event.after[0].state).substr(0, 2));
    }
  }
  return words;
}

using Check = std::function<std::string(const Simulation<double>&)>;

// The scene must run and keep the invariants; then `check` says what else is wrong.
NamedScene runs(std::string name, std::string expected, Scene<double> scene, Check check,
                SimulationOptions options = {}) {
  auto judge = [scene, check = std::move(check)](const Outcome& outcome) -> std::string {
    if (!outcome) {
      return "refused: " + outcome.error().field + " " + outcome.error().reason;
    }
    if (std::string broken = broken_invariant(scene, *outcome); !broken.empty()) {
      return broken;
    }
    return check(*outcome);
  };
  return {std::move(name), std::move(expected), std::move(scene), options, std::move(judge)};
}

NamedScene comes_as(std::string name, std::string events, Scene<double> scene,
                    SimulationOptions options = {}) {
  Check check = [events](const Simulation<double>& result) -> std::string {
    const std::string found = sequence(result);
    return found == events ? "" : "events " + found;
  };
  return runs(std::move(name), events, std::move(scene), std::move(check), options);
}

NamedScene ends(std::string name, Scene<double> scene, Ending ending = Ending::at_rest,
                SimulationOptions options = {}) {
  Check check = [ending](const Simulation<double>& result) -> std::string {
    return result.ending == ending ? "" : "ended with " + std::string(physics::name(result.ending));
  };
  return runs(std::move(name), "ends with " + std::string(physics::name(ending)), std::move(scene),
              std::move(check), options);
}

NamedScene is_refused(std::string name, Fault fault, std::string field, Scene<double> scene) {
  auto judge = [fault, field](const Outcome& outcome) -> std::string {
    if (outcome) {
      return "was simulated";
    }
    return outcome.error().fault == fault && outcome.error().field == field
               ? ""
               : std::string(physics::name(outcome.error().fault)) + " " + outcome.error().field;
  };
  std::string expected = "refused: " + std::string(physics::name(fault)) + " at " + field;
  return {std::move(name), std::move(expected), std::move(scene), {}, std::move(judge)};
}

Scene<double> frozen_line(std::size_t balls) {
  Scene<double> scene = with(on_table(), 0, {0.5, 0.2}, {0, 2});
  for (std::size_t i = 1; i <= balls; ++i) {
    scene = with(std::move(scene), static_cast<unsigned>(i),
                 {0.5, 0.4 + touching * static_cast<double>(i)});
  }
  return scene;
}

void add_free_motion(std::vector<NamedScene>& out) {
  out.push_back(comes_as("stun", "tran0:ro tran0:st", with(on_table(), 0, {0.5, 0.5}, {0, 0.5})));
  out.push_back(comes_as("draw without roll-out", "tran0:st",
                         with(on_table(), 0, {0.5, 0.5}, {0.8, 0}, {0, -2.5 * 0.8 / R, 0})));
  out.push_back(comes_as("spinning on the spot", "tran0:ro tran0:st",
                         with(on_table(), 0, {0.5, 0.5}, {}, {20, 0, 0})));
  for (const double sign : {1.0, -1.0}) {
    out.push_back(comes_as("pure side spin", "tran0:st",
                           with(on_table(), 0, {0.5, 0.5}, {}, {0, 0, sign * 40})));
  }
  for (const double v : {1e-9, 1e-5, 1e3, 1e-310, 5e-324}) {
    out.push_back(ends("speed " + std::to_string(v), with(on_table(), 0, {0.5, 0.5}, {v, v})));
  }
  Scene<double> slick = on_table();
  slick.materials.mu_slide = slick.materials.mu_roll = 0;
  slick.materials.mu_spin = 0;
  slick.materials.cushion = DampedCushion{1, 1, 1};
  slick.table.pockets = NoPockets{};
  out.push_back(ends("no friction, t_max", with(slick, 0, {0.5, 0.5}, {1, 0.7}), Ending::t_max,
                     {.t_max = 1e4}));
  out.push_back(ends("no friction, event limit", with(slick, 0, {0.5, 0.5}, {1, 0.7}),
                     Ending::event_limit, {.event_limit = 1000}));
  Scene<double> rough = on_table();
  rough.materials.mu_slide = rough.materials.mu_roll = 1e6;
  rough.materials.ball_friction = ConstantFriction{1e6};
  out.push_back(ends("friction 1e6", with(with(rough, 0, {0.5, 0.5}, {1, 0.3}, {9, 9, 30}), 1,
                                          {0.5 + touching + 1e-9, 0.5})));
}

void add_pairs(std::vector<NamedScene>& out) {
  out.push_back(
      comes_as("touching and receding", "tran1:ro tran1:st",
               with(with(on_table(), 1, {0.5, 0.5}, {-0.4, 0}), 2, {0.5 + touching, 0.5})));
  out.push_back(runs("touching and approaching", "contact at t = 0",
                     with(with(on_table(), 1, {0.25, 0.5}, {0.4, 0}), 2, {0.25 + touching, 0.5}),
                     [](const Simulation<double>& r) -> std::string {
                       return r.events.front().type == EventType::ball_collision &&
                                      r.events.front().t < 1e-15
                                  ? ""
                                  : sequence(r);
                     }));
  out.push_back(ends("one ulp of overlap", with(with(on_table(), 1, {0.25, 0.5}, {1, 0}), 2,
                                                {std::nextafter(0.25 + touching, 0), 0.5})));
  out.push_back(is_refused("gross overlap", Fault::overlap, "/balls/1/x",
                           with(with(on_table(), 1, {0.5, 0.5}), 2, {0.5 + touching - 1e-6, 0.5})));
  out.push_back(
      runs("side by side at one speed", "no contact",
           rolling(rolling(on_table(), 1, {0.5, 0.5}, {0, 1}), 2, {0.5 + touching, 0.5}, {0, 1}),
           [](const Simulation<double>& r) -> std::string {
             return sequence(r).find("ball") == std::string::npos ? "" : sequence(r);
           }));
  out.push_back(ends(
      "rolling at each other, touching",
      rolling(rolling(on_table(), 1, {0.5, 0.5}, {0.5, 0}), 2, {0.5 + touching, 0.5}, {-0.5, 0})));
  for (const double degrees : {0.0, 90.0}) {
    Scene<double> follow = with(with(on_table(), 0, {0.5, 0.5}), 1,
                                degrees == 0 ? Vec2<double>{0.8, 0.5} : Vec2<double>{0.5, 0.8});
    follow.shot = cue_shot_from_degrees(0.0, 12.0, 12.0, degrees, 1.5);
    out.push_back(runs("dead-straight follow at " + std::to_string(int(degrees)),
                       "the balls stay on their line", follow,
                       [degrees](const Simulation<double>& r) -> std::string {
                         const auto& p = r.balls[0].position;
                         const bool hit = sequence(r).find("ball0+1") != std::string::npos;
                         return hit && (degrees == 0 ? p.y : p.x) == 0.5 ? "" : sequence(r);
                       }));
  }
}

void add_clusters(std::vector<NamedScene>& out) {
  for (const std::size_t n : {3U, 5U}) {
    out.push_back(runs("chain of " + std::to_string(n), "the last ball takes the speed",
                       frozen_line(n), [n](const Simulation<double>& r) -> std::string {
                         for (const auto& e : r.events) {
                           if (e.type == EventType::ball_collision && number(e.after[1].id) == n) {
                             return e.after[1].velocity.y > 1.5 ? "" : "it took less";
                           }
                         }
                         return "nothing reached it";
                       }));
  }
  out.push_back(ends("chain of 15", frozen_line(15)));
  const double h = std::numbers::sqrt3 * R;
  Scene<double> v = with(with(on_table(), 1, {0.5 - R, 0.5}), 2, {0.5 + R, 0.5});
  v.materials.ball_friction = ConstantFriction{0};
  v.materials.mu_slide = v.materials.mu_roll = 0;
  out.push_back(runs(
      "symmetric two-ball hit", "-0.2 and 0.6928 of v", with(v, 0, {0.5, 0.5 - h - 0.05}, {0, 1}),
      [](const Simulation<double>& r) -> std::string {
        const auto& e = r.events.front();
        const double back = e.after[0].velocity.y;
        const double off = length(e.after[1].velocity);
        return std::abs(back + 0.2) < 1e-12 && std::abs(off - 0.69282032302755) < 1e-12
                   ? ""
                   : std::to_string(back) + " " + std::to_string(off);
      },
      {.t_max = 0.2}));
  out.push_back(ends("a ball between two frozen ones",
                     with(with(with(on_table(), 1, {0.5 - touching, 0.5}), 0, {0.5, 0.5}, {1, 0.5}),
                          2, {0.5 + touching, 0.5})));
}

void add_rails_and_pockets(std::vector<NamedScene>& out) {
  out.push_back(comes_as("rolling along a rail it touches", "pock0",
                         rolling(on_table(), 0, {R, 0.6}, {0, 1})));
  out.push_back(
      ends("pressed to a rail by spin", with(closed_box(), 0, {R, 0.6}, {0, 0.3}, {0, -60, 0})));
  out.push_back(ends("into a rail it touches", with(closed_box(), 0, {R, 0.6}, {-1, 0.2})));
  out.push_back(runs("both corner rails at once", "head, then head_left, at one time",
                     with(closed_box(), 0, {0.3, 0.3}, {-1, -1}),
                     [](const Simulation<double>& r) -> std::string {
                       const auto& e = r.events;
                       return e.size() > 2 && e[1].rail == RailId::head &&
                                      e[2].rail == RailId::head_left && e[2].t - e[1].t < 1e-15
                                  ? ""
                                  : sequence(r);
                     }));
  out.push_back(ends("squeezed against a rail",
                     rolling(with(closed_box(), 1, {R, 0.5}), 2, {R + touching, 0.5}, {-0.5, 0})));
  const double aside = R / std::numbers::sqrt2 + 1e-4;
  const double line = (0.11 / std::numbers::sqrt2 + R) / 2;
  out.push_back(comes_as("at rest on the mouth line", "", with(on_table(), 0, {line, line})));
  out.push_back(comes_as("from the mouth line outwards", "pock0",
                         with(on_table(), 0, {line, line}, {-0.1, -0.1})));
  out.push_back(is_refused("beyond a mouth line", Fault::outside_table, "/balls/0/x",
                           with(on_table(), 0, {line - 1e-6, line})));
  out.push_back(runs("two balls into one pocket at once", "both pocketed",
                     with(with(on_table(), 1, {0.2 + aside, 0.2 - aside}, {-1, -1}), 2,
                          {0.2 - aside, 0.2 + aside}, {-1, -1}),
                     [](const Simulation<double>& r) -> std::string {
                       return r.balls[0].pocket && r.balls[1].pocket ? "" : sequence(r);
                     }));
  out.push_back(
      ends("between the jaws of a corner", with(on_table("bar7"), 0, {0.05, 0.05}, {-0.3, -0.1})));
  out.push_back(ends("across the mouth of a side pocket",
                     with(on_table("bar7"), 0, {0.03, 0.8}, {-0.05, 2})));
  out.push_back(
      is_refused("not a number", Fault::not_finite, "/balls/0/vy",
                 with(on_table(), 0, {0.5, 0.5}, {1, std::numeric_limits<double>::quiet_NaN()})));
  out.push_back(is_refused("infinite", Fault::not_finite, "/balls/0/x",
                           with(on_table(), 0, {std::numeric_limits<double>::infinity(), 0.5})));
}

bool is_finite(const Ball<double>& b) {
  return std::isfinite(b.position.x) && std::isfinite(b.position.y) &&
         std::isfinite(b.velocity.x) && std::isfinite(b.velocity.y) &&
         std::isfinite(b.angular_velocity.x) && std::isfinite(b.angular_velocity.y) &&
         std::isfinite(b.angular_velocity.z);
}

}  // namespace

std::string broken_invariant(const Scene<double>& scene, const Simulation<double>& result) {
  const double radius = scene.materials.ball_radius;
  const bool jaws = std::holds_alternative<Jaws>(scene.table.pockets);
  const double least = jaws ? -0.05 : radius - 1e-9;
  for (const auto& event : result.events) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      if (!is_finite(event.after[i])) {
        return "a number that is not finite";
      }
    }
  }
  for (const Ball<double>& ball : result.balls) {
    const Vec2<double> p = ball.position;
    if (!is_finite(ball)) {
      return "a number that is not finite";
    }
    if (p.x < least || p.y < least || scene.table.width - p.x < least ||
        scene.table.length - p.y < least) {
      return "ball " + std::to_string(number(ball.id)) + " is outside";
    }
    for (const Ball<double>& other : result.balls) {
      if (other.id != ball.id && !ball.pocket && !other.pocket &&
          length(other.position - p) < 2 * radius - 1e-9) {
        return "balls overlap at the end";
      }
    }
  }
  const auto& energy = result.energy;
  if (energy.end > energy.start * (1 + 1e-12) + energy.added_by_separation) {
    return "the energy rose";
  }
  return "";
}

std::vector<NamedScene> extreme_scenes() {
  std::vector<NamedScene> out;
  add_free_motion(out);
  add_pairs(out);
  add_clusters(out);
  add_rails_and_pockets(out);
  return out;
}

}  // namespace poolhall::test_support
