#include "tests/support/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "physics/motion.hpp"

namespace poolhall::test_support {

using namespace physics;

Scene<double> on_table(std::string_view table, std::string_view kind) {
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

Scene<double> frictionless_box() {
  Scene<double> scene = closed_box();
  scene.materials.mu_slide = scene.materials.mu_roll = 0;
  scene.materials.mu_spin = 0;
  scene.materials.ball_friction = ConstantFriction{0};
  scene.materials.cushion = DampedCushion{1, 1, 1};
  return scene;
}

Scene<double> with(Scene<double> scene, unsigned id, Vec2<double> at, Vec2<double> v,
                   Vec3<double> w) {
  Ball<double>& ball = scene.balls[scene.balls.count++];
  ball.id = BallId{static_cast<std::uint8_t>(id)};
  ball.position = at;
  ball.velocity = v;
  ball.angular_velocity = w;
  ball.state = motion_state_of(v, w, scene.materials.ball_radius);
  return scene;
}

Scene<double> rolling(Scene<double> scene, unsigned id, Vec2<double> at, Vec2<double> v) {
  const double radius = scene.materials.ball_radius;
  return with(std::move(scene), id, at, v, rolling_spin(v, 0.0, radius));
}

Scene<double> struck(Scene<double> scene, const ShotParameters<double>& shot) {
  scene.shot = cue_shot(shot);
  return scene;
}

std::string sequence(const Simulation<double>& result) {
  std::string words;
  for (const auto& event : result.events) {
    words += words.empty() ? "" : " ";
    words += event.type == EventType::cue_strike ? "stri" : name(event.type).substr(0, 4);
    words += std::to_string(number(event.after[0].id));
    if (event.ball_count == 2) {
      words += "+" + std::to_string(number(event.after[1].id));
    }
    if (event.type == EventType::transition) {
      words += ":" + std::string(name(event.after[0].state).substr(0, 2));
    }
  }
  return words.empty() ? "nothing" : words;
}

const Event<double>* first_of(const Simulation<double>& result, EventType type) {
  const auto found = std::find_if(result.events.begin(), result.events.end(),
                                  [type](const Event<double>& e) { return e.type == type; });
  return found == result.events.end() ? nullptr : &*found;
}

std::string in_words(double number) {
  std::ostringstream out;
  out.precision(6);
  out << number;
  return out.str();
}

Finding near(std::string_view what, double found, double expected, double tolerance) {
  const double off = std::abs(found - expected);
  std::string words(what);
  words += " " + in_words(found) + " (off by " + in_words(off) + ")";
  return {off <= tolerance, std::move(words)};
}

Finding all_of(const std::vector<Finding>& findings) {
  Finding all{true, ""};
  for (const Finding& one : findings) {
    if (!one.as_expected) {
      return one;
    }
    all.found += (all.found.empty() ? "" : ", ") + one.found;
  }
  return all;
}

namespace {

std::string refusal(const physics::Error& error) {
  return "refused: " + std::string(name(error.fault)) + " at " + error.field;
}

// A log of hundreds of events is told by its length.
std::string in_short(const Simulation<double>& result) {
  const std::string words = sequence(result);
  return words.size() <= 60 ? words : std::to_string(result.events.size()) + " entries";
}

}  // namespace

NamedScene runs(std::string name, std::string expected, Scene<double> scene, Check check,
                SimulationOptions options) {
  auto judge = [scene, check = std::move(check)](const Outcome& outcome) -> Finding {
    if (!outcome) {
      return {false, refusal(outcome.error())};
    }
    if (std::string broken = broken_invariant(scene, *outcome); !broken.empty()) {
      return {false, broken};
    }
    return check(*outcome);
  };
  return {std::move(name), std::move(expected), std::move(scene), options, std::move(judge)};
}

NamedScene comes_as(std::string name, const std::string& events, Scene<double> scene,
                    SimulationOptions options) {
  Check check = [events](const Simulation<double>& result) -> Finding {
    std::string found = sequence(result);
    return {found == events, std::move(found)};
  };
  return runs(std::move(name), events, std::move(scene), std::move(check), options);
}

NamedScene ends(std::string name, Scene<double> scene, Ending ending, SimulationOptions options) {
  Check check = [ending](const Simulation<double>& result) -> Finding {
    return {result.ending == ending,
            std::string(physics::name(result.ending)) + ": " + in_short(result)};
  };
  return runs(std::move(name), std::string(physics::name(ending)), std::move(scene),
              std::move(check), options);
}

NamedScene is_refused(std::string name, Fault fault, std::string field, Scene<double> scene,
                      SimulationOptions options) {
  std::string expected = refusal({fault, std::move(field), ""});
  auto judge = [expected](const Outcome& outcome) -> Finding {
    std::string found = outcome ? "was simulated" : refusal(outcome.error());
    return {found == expected, std::move(found)};
  };
  return {std::move(name), std::move(expected), std::move(scene), options, std::move(judge)};
}

}  // namespace poolhall::test_support
