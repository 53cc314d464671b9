#include "tests/support/symmetry.hpp"

#include <algorithm>
#include <limits>

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double unlike = std::numeric_limits<double>::infinity();

Ball<double> seen(Ball<double> ball, const Table& table, Symmetry how) {
  // An angular velocity is an axial vector: of a mirrored one, what lies along the mirror turns
  // round.
  auto& w = ball.angular_velocity;
  if (how == Symmetry::mirrored) {
    ball.position.x = table.width - ball.position.x;
    ball.velocity.x = -ball.velocity.x;
    w = {w.x, -w.y, -w.z};
  } else if (how == Symmetry::rotated) {
    ball.position = Vec2<double>{table.width, table.length} - ball.position;
    ball.velocity = -1.0 * ball.velocity;
    w = {-w.x, -w.y, w.z};
  } else {
    // An odd factor permutes 1 to 15.
    ball.id = BallId{static_cast<std::uint8_t>(std::size_t{number(ball.id)} * 7 % max_balls)};
  }
  return ball;
}

CueShot<double> seen(const CueShot<double>& shot, Symmetry how) {
  ShotParameters<double> given = shot.given;
  if (how == Symmetry::mirrored) {
    given.a = -given.a;
    given.phi = 180 - given.phi;
  } else if (how == Symmetry::rotated) {
    given.phi += given.phi < 180 ? 180 : -180;
  }
  return cue_shot(given);
}

}  // namespace

Scene<double> transformed(const Scene<double>& scene, Symmetry how) {
  Scene<double> image = scene;
  for (Ball<double>& ball : image.balls) {
    ball = seen(ball, scene.table, how);
  }
  if (how == Symmetry::renumbered) {
    std::reverse(image.balls.begin(), image.balls.end());
  }
  if (scene.shot) {
    image.shot = seen(*scene.shot, how);
  }
  return image;
}

double image_distance(const Simulation<double>& original, const Simulation<double>& image,
                      const Table& table, Symmetry how) {
  double most = 0;
  for (const Ball<double>& ball : original.balls) {
    const Ball<double> there = seen(ball, table, how);
    const auto found =
        std::find_if(image.balls.begin(), image.balls.end(),
                     [&there](const Ball<double>& other) { return other.id == there.id; });
    if (found == image.balls.end() || found->pocket.has_value() != ball.pocket.has_value()) {
      return unlike;
    }
    if (!ball.pocket) {
      most = std::max(most, length(found->position - there.position));
    }
  }
  return most;
}

double amplification(const Scene<double>& scene, const SimulationOptions& options) {
  constexpr double shift = 1e-12;
  Scene<double> moved = scene;
  moved.balls[0].position.x += shift;
  const auto one = simulate(scene, options);
  const auto other = simulate(moved, options);
  if (!one || !other || one->events.size() != other->events.size()) {
    return unlike;
  }
  double most = shift;
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    if (one->balls[i].pocket.has_value() != other->balls[i].pocket.has_value()) {
      return unlike;
    }
    if (!one->balls[i].pocket) {
      most = std::max(most, length(one->balls[i].position - other->balls[i].position));
    }
  }
  return most / shift;
}

}  // namespace poolhall::test_support
