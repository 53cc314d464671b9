#include "tests/fuzz/simulate/shot_demands.hpp"

#include <cmath>

#include "tests/fuzz/protocol/demand.hpp"

namespace poolhall::fuzz {

namespace {

using namespace physics;

bool is_finite(const Ball<double>& b) {
  const double sum = b.position.x + b.position.y + b.velocity.x + b.velocity.y +
                     b.angular_velocity.x + b.angular_velocity.y + b.angular_velocity.z;
  return std::isfinite(sum);
}

void demand_sound_log(const EventLog<double>& events) {
  double before = 0;
  for (const auto& event : events) {
    demand(std::isfinite(event.t) && event.t >= before, "times are numbers in order");
    before = event.t;
    demand(!event.until || *event.until >= event.t, "a row of hops ends after it began");
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      demand(is_finite(event.after[i]), "a ball in the log is made of numbers");
    }
  }
}

// Overlaps that a scene may have are those that check_scene lets pass.
void demand_apart(const Scene<double>& scene, const BallSet<double>& balls, double slack) {
  const double reach = 2 * scene.materials.ball_radius;
  for (std::size_t i = 0; i < balls.count; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!balls[i].pocket && !balls[k].pocket) {
        demand(length(balls[i].position - balls[k].position) >= reach - slack,
               "two balls are not in one place");
      }
    }
  }
}

void demand_inside(const Scene<double>& scene, const BallSet<double>& balls, double slack) {
  if (std::holds_alternative<Jaws>(scene.table.pockets)) {
    return;
  }
  const double least = scene.materials.ball_radius - slack;
  for (const auto& ball : balls) {
    if (ball.pocket) {
      continue;
    }
    const Vec2<double> far = Vec2<double>{scene.table.width, scene.table.length} - ball.position;
    demand(std::min({ball.position.x, ball.position.y, far.x, far.y}) >= least,
           "no ball is beyond the rails");
  }
}

}  // namespace

void demand_sound(const Scene<double>& scene, const Simulation<double>& result) {
  demand_sound_log(result.events);
  for (const auto& ball : result.balls) {
    demand(is_finite(ball), "a ball at the end is made of numbers");
  }
  const auto& energy = result.energy;
  demand(std::isfinite(energy.end) && energy.added_by_separation >= 0, "energies are numbers");
  demand(energy.end <= energy.start * (1 + 1e-9) + energy.added_by_separation * (1 + 1e-9),
         "the energy has not risen");
  // What one ulp of a coordinate is at 100 m, and what the scene itself may have had.
  const double slack = 1e-12 * (scene.table.width + scene.table.length) + 2.1 * position_tolerance;
  demand_apart(scene, result.balls, slack);
  demand_inside(scene, result.balls, slack);
}

}  // namespace poolhall::fuzz
