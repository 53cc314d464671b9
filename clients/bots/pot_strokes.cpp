#include "clients/bots/pot_strokes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "clients/bots/stroke.hpp"
#include "physics/cue_strike.hpp"

namespace poolhall::bots {
namespace {

constexpr double a_degree = std::numbers::pi / 180;
constexpr int most_turnings = 3;
constexpr double aimed_well = 4e-4;     // rad, of the object ball's course
constexpr double hopeless = 2e-2;       // rad
constexpr double most_turned = 5e-2;    // rad, in a step
constexpr double slowest_stroke = 0.3;  // m/s

// Aims the strokes of one line, each from where the last one ended.
class Aimer {
 public:
  Aimer(const PotLine& line, Trial& trial)
      : line_(line),
        trial_(trial),
        slope_(-line.cue_run / (2 * trial.hall().radius() * line.cos_cut)),
        phi_(std::atan2(line.aim.y, line.aim.x)) {}

  [[nodiscard]] double phi() const { return phi_; }

  // `stroke` with the heading that sends the object ball along the line.
  [[nodiscard]] std::optional<protocol::ShotParams> aimed(protocol::ShotParams stroke) {
    double phi = phi_;
    std::optional<double> off;
    for (int step = 0; step <= most_turnings; ++step) {
      stroke.phi = phi / a_degree;
      off = trial_.miss(line_, stroke);
      if (!off || std::abs(*off) <= aimed_well) {
        break;
      }
      phi += std::clamp(-*off / slope_, -most_turned, most_turned);
    }
    if (!off || std::abs(*off) > hopeless) {
      return std::nullopt;
    }
    phi_ = stroke.phi * a_degree;
    return stroke;
  }

 private:
  const PotLine& line_;
  Trial& trial_;
  double slope_;  // turning the cue by d turns the object ball by about slope_ * d
  double phi_;    // rad
};

bool side_matters(const physics::Materials& materials) {
  const bool damped = std::holds_alternative<physics::DampedCushion>(materials.cushion);
  return !damped;
}

}  // namespace

StrokeGrid wide_grid(const physics::Materials& materials) {
  StrokeGrid grid{
      {1.15, 1.4, 1.75, 2.2, 2.8, 3.6, 4.8, 6.5}, {-0.7, -0.45, -0.2, 0, 0.2, 0.45, 0.7}, {0}};
  if (side_matters(materials)) {
    grid.speeds = {1.15, 1.5, 2.0, 2.7, 3.6, 5.0};
    grid.follows = {-0.35, -0.15, 0, 0.2, 0.4};
    grid.sides = {0, -0.3, 0.3};
  }
  return grid;
}

StrokeGrid narrow_grid() {
  return {{1.3, 1.9, 2.9, 4.5}, {-0.45, 0, 0.45}, {0}};
}

double least_speed(const PotLine& line, const physics::Materials& m) {
  // The ball starts without spin, slides until it has 5/7 of its speed, and rolls; the cue ball
  // loses to the cloth on the way. With (3) a centre hit gives the ball (1 + e_t) / (1 + m/M) of
  // the cue's speed.
  const double per_square = 12 / (49 * m.mu_slide * m.gravity) + 25 / (98 * m.mu_roll * m.gravity);
  const double object_speed = std::sqrt(line.object_run / per_square);
  const double at_contact = object_speed / line.cos_cut;
  const double at_start =
      std::sqrt(at_contact * at_contact + 2.8 * m.mu_roll * m.gravity * line.cue_run);
  return at_start * (1 + m.ball_mass / m.cue_mass) / (1 + m.tip_restitution);
}

std::vector<protocol::ShotParams> pot_strokes(const PotLine& line, const Position& placed,
                                              const StrokeGrid& grid, Trial& trial) {
  const auto& hall = trial.hall();
  const auto balls = ball_set(placed);
  const double least = least_speed(line, hall.materials);
  const double fastest = hall.materials.max_cue_speed * 0.95;
  const double widest = 0.95 * hall.materials.miscue_limit;  // of the radius
  Aimer aimer(line, trial);
  std::vector<protocol::ShotParams> strokes;
  for (const double follow : grid.follows) {
    for (const double side : grid.sides) {
      if (std::hypot(follow, side) > widest) {
        continue;
      }
      // The elevation hardly hangs on the speed and on the last hundredths of the aim.
      const auto raised = clear_stroke({.phi = aimer.phi(),
                                        .speed = least,
                                        .side = side * hall.radius(),
                                        .follow = follow * hall.radius()},
                                       balls, hall.table, hall.materials);
      if (!raised) {
        continue;
      }
      for (const double factor : grid.speeds) {
        protocol::ShotParams stroke = *raised;
        stroke.v = std::clamp(factor * least, slowest_stroke, fastest);
        const auto aimed = aimer.aimed(stroke);
        if (aimed &&
            physics::check_shot(physics::cue_shot(*aimed), balls, hall.table, hall.materials)) {
          strokes.push_back(*aimed);
        }
      }
    }
  }
  return strokes;
}

}  // namespace poolhall::bots
