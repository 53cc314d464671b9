#include "clients/bots/aiming.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/simulator.hpp"

namespace poolhall::bots {
namespace {

constexpr int most_steps = 4;
constexpr double good_enough = 5e-4;  // rad, of the object ball's course

// Cue ball and object ball alone on the table.
class Bench {
 public:
  Bench(const PotLine& line, const physics::BallSet<double>& balls, const physics::Table& table,
        const physics::Materials& materials)
      : line_(line), scene_{table, materials, {}, {}} {
    for (const auto& ball : balls) {
      if (ball.id == physics::cue_ball || ball.id == line.ball) {
        scene_.balls[scene_.balls.count++] = ball;
      }
    }
    // Long enough for the slowest useful cue ball to arrive; what follows does not matter.
    options_.t_max = 3;
  }

  // The angle in rad by which the object ball leaves to the left of its course; nothing if it is
  // not hit.
  [[nodiscard]] std::optional<double> miss(const protocol::ShotParams& stroke) {
    scene_.shot = protocol::to_physics(stroke);
    const auto simulation = physics::simulate(scene_, options_);
    if (!simulation) {
      return std::nullopt;
    }
    events_ += simulation->events.size();
    for (const auto& event : simulation->events) {
      if (event.type == physics::EventType::ball_collision) {
        const auto& object = event.after[0].id == line_.ball ? event.after[0] : event.after[1];
        const Point v = object.velocity;
        return std::atan2(line_.course.x * v.y - line_.course.y * v.x, dot(line_.course, v));
      }
      if (event.type == physics::EventType::rail_collision) {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint64_t events() const { return events_; }

 private:
  const PotLine& line_;
  physics::Scene<double> scene_;
  physics::SimulationOptions options_;
  std::uint64_t events_ = 0;
};

}  // namespace

std::optional<Aimed> aim(const PotLine& line, StrokeWish wish,
                         const physics::BallSet<double>& balls, const physics::Table& table,
                         const physics::Materials& materials) {
  wish.phi = std::atan2(line.aim.y, line.aim.x);
  auto stroke = clear_stroke(wish, balls, table, materials);
  if (!stroke) {
    return std::nullopt;
  }
  Bench bench(line, balls, table, materials);
  // Turning the cue by d moves the contact by d * cue_run and so turns the line of centres by
  // that over 2R cos(cut), the other way.
  double slope = -line.cue_run / (2 * materials.ball_radius * line.cos_cut);
  auto miss = bench.miss(*stroke);
  for (int step = 0; step < most_steps && miss && std::abs(*miss) > good_enough; ++step) {
    const double before = *miss;
    const double turn = std::clamp(-before / slope, -0.05, 0.05);
    stroke->phi += turn * 180 / std::numbers::pi;
    miss = bench.miss(*stroke);
    if (miss && turn != 0 && std::abs(*miss - before) > 1e-9) {
      slope = (*miss - before) / turn;
    }
  }
  if (!miss || std::abs(*miss) > 20 * good_enough) {
    return std::nullopt;
  }
  return Aimed{*stroke, bench.events()};
}

}  // namespace poolhall::bots
