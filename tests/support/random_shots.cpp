#include "tests/support/random_shots.hpp"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

namespace poolhall::test_support {

namespace {

using physics::Vec2;

// Uniform numbers from Philox4x32-10, keyed by the seed.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint32_t stream)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        stream_(stream) {}

  double between(double low, double high) {
    const r123::Philox4x32::ctr_type counter{{next_++, stream_, 0, 0}};
    const auto bits = r123::Philox4x32{}(counter, key_);
    const std::uint64_t word = (std::uint64_t{bits[0]} << 32) | bits[1];
    return low + (high - low) * static_cast<double>(word >> 11) * 0x1p-53;
  }

 private:
  r123::Philox4x32::key_type key_;
  std::uint32_t stream_;
  std::uint32_t next_ = 0;
};

bool free_place(const Vec2<double>& place, const physics::BallSet<double>& balls, double radius) {
  for (const auto& ball : balls) {
    const Vec2<double> d = ball.position - place;
    if (dot(d, d) < (2 * radius + 1e-4) * (2 * radius + 1e-4)) {
      return false;
    }
  }
  return true;
}

void add_ball(physics::BallSet<double>& balls, const Vec2<double>& place) {
  physics::Ball<double> ball;
  ball.id = physics::BallId{static_cast<std::uint8_t>(balls.count)};
  ball.position = place;
  balls[balls.count++] = ball;
}

// Degrees in [0, 360).
double heading(const Vec2<double>& from, const Vec2<double>& to) {
  const double phi = std::atan2(to.y - from.y, to.x - from.x) * 180 / std::numbers::pi;
  return phi < 0 ? phi + 360 : phi;
}

protocol::ShotParams random_stroke(Dice& dice, double phi, double least, double most) {
  protocol::ShotParams shot;
  shot.a = dice.between(-10, 10);
  shot.b = dice.between(-10, 10);
  shot.theta = dice.between(0, 10);
  shot.phi = phi;
  shot.v = dice.between(least, most);
  return shot;
}

// The cue is raised where it would pass through a rail or a ball.
void make_possible(RandomShot& shot) {
  const physics::NearestShot nearest = physics::nearest_possible_shot(
      protocol::to_physics(shot.shot), shot.balls, shot.table, shot.materials);
  shot.shot = nearest.shot.given;
}

}  // namespace

RandomShot random_shot(const RandomShotOrder& order) {
  Dice dice(order.seed, 1);
  RandomShot out{order.table, order.materials, {}, {}};
  const double radius = order.materials.ball_radius;
  // Clear of the mouth lines of every table we know.
  const double margin = radius + 0.09;
  while (out.balls.count < order.balls) {
    const Vec2<double> place{dice.between(margin, order.table.width - margin),
                             dice.between(margin, order.table.length - margin)};
    if (free_place(place, out.balls, radius)) {
      add_ball(out.balls, place);
    }
  }
  double phi = dice.between(0, 360);
  if (order.balls > 1 && dice.between(0, 1) < 0.5) {
    const auto target =
        1 + static_cast<std::size_t>(dice.between(0, static_cast<double>(order.balls - 1)));
    phi = heading(out.balls[0].position, out.balls[target].position) + dice.between(-5, 5);
    phi = phi < 0 ? phi + 360 : phi;
  }
  out.shot = random_stroke(dice, phi, order.least_speed, order.most_speed);
  make_possible(out);
  return out;
}

RandomShot random_break(const RandomBreakOrder& order) {
  Dice dice(order.seed, 2);
  RandomShot out{order.table, order.materials, {}, {}};
  const double radius = order.materials.ball_radius;
  const double margin = radius + 0.09;
  const Vec2<double> spot{order.table.foot_spot_x, order.table.foot_spot_y};
  add_ball(out.balls, {dice.between(margin, order.table.width - margin),
                       dice.between(margin, order.table.head_string - 1e-3)});
  const double pitch = 2 * radius + order.gap;
  for (int row = 0; row < 5; ++row) {
    for (int i = 0; i <= row; ++i) {
      add_ball(out.balls,
               {spot.x + pitch * (i - row / 2.0), spot.y + pitch * row * std::numbers::sqrt3 / 2});
    }
  }
  const double phi = heading(out.balls[0].position, spot) + dice.between(-1, 1);
  out.shot = random_stroke(dice, phi, order.least_speed, order.most_speed);
  out.shot.theta = 0;
  make_possible(out);
  return out;
}

physics::Scene<double> scene_of(const RandomShot& shot) {
  return {shot.table, shot.materials, shot.balls, protocol::to_physics(shot.shot)};
}

}  // namespace poolhall::test_support
