#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "physics/event_loop.hpp"
#include "tests/fuzz/protocol/demand.hpp"
#include "tests/fuzz/simulate/shot_demands.hpp"
#include "tests/fuzz/simulate/simulate_targets.hpp"

namespace poolhall::fuzz {

namespace {

using namespace physics;

// Zeros when the input is at its end.
class Bytes {
 public:
  explicit Bytes(std::string_view input) : input_(input) {}

  [[nodiscard]] bool empty() const { return at_ >= input_.size(); }
  [[nodiscard]] unsigned next() { return empty() ? 0U : static_cast<unsigned char>(input_[at_++]); }
  template <std::size_t n>
  [[nodiscard]] double one_of(const std::array<double, n>& choice) {
    return choice[next() % n];
  }
  // 0 to 1 in 65,536 steps.
  [[nodiscard]] double share() { return (next() * 256.0 + next()) / 65535.0; }

 private:
  std::string_view input_;
  std::size_t at_ = 0;
};

constexpr double least = std::numeric_limits<double>::denorm_min();

// A number of any size, either sign.
double number_of(Bytes& in, double scale) {
  constexpr std::array sizes{0.0,   1.0,    0.5,    1e-3,  1e-6, 1e-9, 1e-12, 1e-15,
                             1e-30, 1e-160, 1e-310, least, 2.0,  10.0, 1e3,   0.1};
  const unsigned kind = in.next();
  const double sign = (kind & 0x80U) != 0 ? -1 : 1;
  const double size = (kind & 0x40U) != 0 ? in.share() : sizes[kind % sizes.size()];
  return sign * size * scale;
}

Cushion cushion_of(Bytes& in) {
  switch (in.next() % 5) {
    case 1:
      return Han2005Cushion{in.share(), in.share(), std::nullopt};
    case 2:
      return Mathavan2010Cushion{in.share(), in.share(), std::nullopt};
    case 3:
      return SpringCushion{1.7e4, 0.99 * in.share(), in.share(), std::nullopt};
    case 4:
      return DampedCushion{in.share(), in.share(), in.share()};
    default:
      return DampedCushion{};
  }
}

Scene<double> empty_scene(Bytes& in) {
  constexpr std::array tables{"olympiad", "bar7", "wpa8", "wpa9"};
  constexpr std::array kinds{"olympiad", "modern", "marlow"};
  constexpr std::array frictions{0.0, 1e-9, 0.01, 0.2, 1.0, 1e6};
  Scene<double> scene;
  scene.table = *preset_table(tables[in.next() % tables.size()]);
  if (in.next() % 4 == 0) {
    scene.table.pockets = NoPockets{};
  }
  scene.materials = *preset_materials(kinds[in.next() % kinds.size()]);
  const unsigned changes = in.next();
  if ((changes & 1U) != 0) {
    scene.materials.mu_slide = in.one_of(frictions);
  }
  if ((changes & 2U) != 0) {
    scene.materials.mu_roll = in.one_of(frictions);
  }
  if ((changes & 4U) != 0) {
    scene.materials.ball_friction = ConstantFriction{in.one_of(frictions)};
  }
  if ((changes & 8U) != 0) {
    scene.materials.ball_restitution = in.share();
  }
  if ((changes & 16U) != 0) {
    scene.materials.cushion = cushion_of(in);
  }
  if ((changes & 32U) != 0) {
    scene.materials.separation_speed = in.one_of(std::array{0.0, 1e-9, 1e-6, 1e-3, 1.0});
  }
  return scene;
}

// Anywhere, at a rail, or touching the ball before (a hair more or less).
Vec2<double> place_of(Bytes& in, const Scene<double>& scene) {
  const double radius = scene.materials.ball_radius;
  const Vec2<double> size{scene.table.width, scene.table.length};
  const unsigned kind = in.next() % 4;
  if (kind == 1 && scene.balls.count > 0) {
    const Vec2<double> last = scene.balls[in.next() % scene.balls.count].position;
    const double angle = in.next() * 0.5235987755982988;  // 30 degrees
    const double reach = 2 * radius + std::abs(number_of(in, 1e-3));
    return {last.x + reach * std::cos(angle), last.y + reach * std::sin(angle)};
  }
  const Vec2<double> free{in.share() * size.x, in.share() * size.y};
  if (kind == 2) {
    return {in.next() % 2 == 0 ? radius : size.x - radius, free.y};
  }
  if (kind == 3) {
    return {free.x, in.next() % 2 == 0 ? radius : size.y - radius};
  }
  return free;
}

void add_ball(Bytes& in, Scene<double>& scene) {
  const double radius = scene.materials.ball_radius;
  Ball<double>& ball = scene.balls[scene.balls.count] = {};
  ball.id = BallId{static_cast<std::uint8_t>(scene.balls.count)};
  ball.position = place_of(in, scene);
  const unsigned motion = in.next() % 4;
  if (motion != 0) {
    ball.velocity = {number_of(in, 3), number_of(in, 3)};
    ball.angular_velocity =
        motion == 1 ? rolling_spin(ball.velocity, number_of(in, 50), radius)
                    : Vec3<double>{number_of(in, 50), number_of(in, 50), number_of(in, 50)};
  }
  settle(ball, radius);
  ++scene.balls.count;
}

SimulationOptions options_of(Bytes& in, const Cushion& cushion) {
  constexpr std::array models{ContactModel::cluster, ContactModel::sequential};
  const unsigned model = in.next() % 32;
  SimulationOptions options{.contact = models[model % models.size()], .event_limit = 60};
  // What is integrated in small steps is a thousand times slower: seldom, and few events of it.
  if (model == 31) {
    options.contact = ContactModel::hertz;
    options.event_limit = 3;
  } else if (std::holds_alternative<Mathavan2010Cushion>(cushion)) {
    options.event_limit = 3;
  }
  if (in.next() % 4 == 0) {
    options.t_max = std::abs(number_of(in, 10));
  }
  return options;
}

}  // namespace

void balls(std::string_view input) {
  Bytes in(input);
  Scene<double> scene = empty_scene(in);
  const SimulationOptions options = options_of(in, scene.materials.cushion);
  const bool shoots = in.next() % 4 == 0;
  if (shoots) {
    scene.shot = cue_shot(ShotParameters<double>{
        number_of(in, 20), number_of(in, 20), 90 * in.share(), 360 * in.share(), 10 * in.share()});
  }
  while (!in.empty() && scene.balls.count < max_balls) {
    add_ball(in, scene);
    const auto possible = check_scene(scene);
    // A ball that has no place is left out.
    if (!possible && possible.error().field.starts_with("/balls")) {
      --scene.balls.count;
    }
  }
  if (const auto result = physics::simulate(scene, options)) {
    demand_sound(scene, *result);
    EventLoop<double> loop(scene.table, scene.materials);
    Recorder<double> recorder;
    Simulation<double> plain;
    plain.ending = loop.run(scene.balls, scene.shot, options, recorder);
    plain.events = recorder.take();
    plain.balls = loop.balls();
    plain.energy = loop.energy();
    demand_sound(scene, plain);
  }
}

}  // namespace poolhall::fuzz
