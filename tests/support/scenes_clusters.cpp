// Balls that touch: chains, pairs, the symmetric hit, a ball between others.
#include <cmath>
#include <numbers>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double speed = 2;

// Ball 0 comes along +y (or +x) into a line of touching balls.
Scene<double> frozen_line(std::size_t balls, bool across) {
  Scene<double> scene = on_table();
  scene.materials.ball_friction = ConstantFriction{0};
  const auto place = [across](double along) {
    return across ? Vec2<double>{along, 0.5} : Vec2<double>{0.5, along};
  };
  scene = with(std::move(scene), 0, place(0.12),
               across ? Vec2<double>{speed, 0} : Vec2<double>{0, speed});
  for (std::size_t i = 1; i <= balls; ++i) {
    scene = with(std::move(scene), static_cast<unsigned>(i),
                 place(0.13 + ball_diameter * static_cast<double>(i)));
  }
  return scene;
}

// The last ball takes the speed that the first one had, the others keep a separation speed's worth.
NamedScene passes_on(std::size_t balls, bool across) {
  const std::string name = "chain of " + std::to_string(balls) + " at " + (across ? "0" : "90");
  return runs(name, "the last ball takes the speed, on the line", frozen_line(balls, across),
              [=](const Simulation<double>& r) -> Finding {
                const Event<double>* hit = nullptr;
                for (const auto& e : r.events) {
                  if (e.type == EventType::ball_collision && number(e.after[1].id) == balls) {
                    hit = &e;
                    break;
                  }
                }
                if (hit == nullptr) {
                  return {false, "nothing reached the last ball"};
                }
                // A slide over what is left of the way costs mu_s g t.
                const double way = across ? hit->after[1].velocity.x : hit->after[1].velocity.y;
                const double before = std::sqrt(speed * speed - 2 * 0.2 * 9.81 * 0.01);
                const double n = static_cast<double>(balls);
                Finding taken = near("takes", way, before, 1e-3 * n);
                for (const auto& b : r.balls) {
                  if (!b.pocket && (across ? b.position.y : b.position.x) != 0.5) {
                    return {false, "ball " + std::to_string(number(b.id)) + " left the line"};
                  }
                }
                return taken;
              });
}

Scene<double> frictionless_cloth() {
  Scene<double> scene = on_table();
  scene.materials.ball_friction = ConstantFriction{0};
  scene.materials.mu_slide = scene.materials.mu_roll = 0;
  return scene;
}

NamedScene symmetric_pair() {
  const double h = std::numbers::sqrt3 * ball_radius;
  const Scene<double> scene = with(
      with(with(frictionless_cloth(), 1, {0.5 - ball_radius, 0.5}), 2, {0.5 + ball_radius, 0.5}), 0,
      {0.5, 0.5 - h - 0.05}, {0, 1});
  return runs("symmetric two-ball hit (V)", "-0.2 and 0.6928 of v", scene,
              [](const Simulation<double>& r) -> Finding {
                const auto& e = r.events.front();
                const auto& f = r.events[1];
                const double off = length(e.after[1].velocity);
                return all_of({near("back", e.after[0].velocity.y, -0.2, 1e-12),
                               near("off", off, std::sqrt(0.48), 1e-12),
                               near("left - right", off - length(f.after[1].velocity), 0, 1e-15)});
              },
              {.t_max = 0.2});
}

// Momentum and energy through a frozen pair that is hit off its line.
NamedScene frozen_pair(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const Scene<double> scene = with(
      with(with(frictionless_cloth(), 0, {0.4, 0.5}, {1, 0}), 1, {0.4 + ball_diameter, 0.5}), 2,
      {0.4 + ball_diameter + ball_diameter * std::cos(angle),
       0.5 + ball_diameter * std::sin(angle)});
  return runs("frozen pair, its line " + in_words(degrees) + " degrees off",
              "momentum and energy kept to the separation speed", scene,
              [](const Simulation<double>& r) -> Finding {
                Vec2<double> momentum{};
                double energy = 0;
                for (const auto& b : r.balls) {
                  momentum = momentum + b.velocity;
                  energy += dot(b.velocity, b.velocity);
                }
                return all_of({near("px", momentum.x, 1, 1e-14), near("py", momentum.y, 0, 1e-14),
                               near("v^2", energy, 1, 1e-5)});
              },
              {.t_max = 1e-6});
}

}  // namespace

void add_clusters(std::vector<NamedScene>& out) {
  for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
    out.push_back(frozen_pair(degrees));
  }
  out.push_back(symmetric_pair());
  for (const bool across : {true, false}) {
    for (const std::size_t balls : {2U, 3U, 5U, 15U}) {
      out.push_back(passes_on(balls, across));
    }
  }
  const Scene<double> between =
      with(with(with(on_table(), 1, {0.5 - ball_diameter, 0.5}), 0, {0.5, 0.5}, {1, 0.5}), 2,
           {0.5 + ball_diameter, 0.5});
  out.push_back(ends("a ball between two frozen ones, moving", between));
  out.push_back(
      ends("a ball between two frozen ones, struck",
           struck(with(with(with(on_table(), 1, {0.5 - ball_diameter, 0.5}), 0, {0.5, 0.5}), 2,
                       {0.5 + ball_diameter, 0.5}),
                  {3, 2, 5, 90, 4})));
  Scene<double> squeezed =
      rolling(rolling(with(on_table(), 0, {0.5, 0.5}), 1, {0.5 - ball_diameter, 0.5}, {0.4, 0}), 2,
              {0.5 + ball_diameter, 0.5}, {-0.4, 0});
  out.push_back(ends("a ball squeezed between two rollers", squeezed));
  squeezed.materials.ball_restitution = 0.5;
  out.push_back(ends("the same, e 0.5", squeezed, Ending::at_rest, {.event_limit = 5000}));
}

}  // namespace poolhall::test_support
