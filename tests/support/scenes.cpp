#include "tests/support/scenes.hpp"

#include <cmath>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

bool is_finite(const Ball<double>& b) {
  return std::isfinite(b.position.x) && std::isfinite(b.position.y) &&
         std::isfinite(b.velocity.x) && std::isfinite(b.velocity.y) &&
         std::isfinite(b.angular_velocity.x) && std::isfinite(b.angular_velocity.y) &&
         std::isfinite(b.angular_velocity.z);
}

bool all_finite(const Simulation<double>& result) {
  for (const auto& event : result.events) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      if (!is_finite(event.after[i]) || !std::isfinite(event.t)) {
        return false;
      }
    }
  }
  for (const Ball<double>& ball : result.balls) {
    if (!is_finite(ball)) {
      return false;
    }
  }
  return std::isfinite(result.energy.end) && std::isfinite(result.energy.added_by_separation);
}

}  // namespace

std::string broken_invariant(const Scene<double>& scene, const Simulation<double>& result) {
  const double radius = scene.materials.ball_radius;
  const bool jaws = std::holds_alternative<Jaws>(scene.table.pockets);
  const double least = jaws ? -0.05 : radius - 1e-9;
  if (!all_finite(result)) {
    return "a number that is not finite";
  }
  for (const Ball<double>& ball : result.balls) {
    const Vec2<double> p = ball.position;
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
  add_frictions_and_speeds(out);
  add_pairs(out);
  add_lines_and_followers(out);
  add_clusters(out);
  add_racks(out);
  add_symmetries(out);
  add_rails(out);
  add_pockets(out);
  add_strokes(out);
  add_long_runs(out);
  add_refusals(out);
  return out;
}

}  // namespace poolhall::test_support
