// Racks with gaps from nothing to a millimetre; scenes seen in a mirror, rotated and renumbered.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_shots.hpp"
#include "tests/support/scene_parts.hpp"
#include "tests/support/symmetry.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double break_speed = 8;

// A cue ball a little off the middle on its way into a full rack.
Scene<double> rack(double gap) {
  Scene<double> scene = on_table();
  const Table& table = scene.table;
  scene = with(std::move(scene), 0, {table.foot_spot_x + 0.004, table.foot_spot_y - 0.1},
               {0, break_speed});
  const double pitch = ball_diameter + gap;
  unsigned id = 1;
  for (int row = 0; row < 5; ++row) {
    for (int i = 0; i <= row; ++i, ++id) {
      scene = with(std::move(scene), id,
                   {table.foot_spot_x + pitch * (i - row / 2.0),
                    table.foot_spot_y + pitch * row * std::numbers::sqrt3 / 2});
    }
  }
  return scene;
}

// What the break has made of the rack 5 ms after the cue ball came.
struct Scattered {
  BallSet<double> balls;
  std::size_t together = 0;  // contacts at the first instant
};

Scattered scattered(double gap) {
  const Scene<double> scene = rack(gap);
  const auto whole = simulate(scene, {.t_max = 0.1});
  const double first = first_of(*whole, EventType::ball_collision)->t;
  Scattered out;
  for (const auto& event : whole->events) {
    out.together += event.type == EventType::ball_collision && event.t == first ? 1U : 0U;
  }
  out.balls = simulate(scene, {.t_max = first + 5e-3})->balls;
  return out;
}

// Root of the mean square difference of the balls' velocities, in cue ball speeds.
double difference(const Scattered& one, const Scattered& other) {
  double sum = 0;
  for (std::size_t i = 0; i < one.balls.count; ++i) {
    const Vec2<double> d = one.balls[i].velocity - other.balls[i].velocity;
    sum += dot(d, d);
  }
  return std::sqrt(sum / static_cast<double>(one.balls.count)) / break_speed;
}

NamedScene gap_like_none(double gap, double bound) {
  return runs("rack gap " + in_words(gap), "velocities as with gap 0 to " + in_words(bound),
              rack(gap), [=](const Simulation<double>& r) -> Finding {
                const double off = difference(scattered(gap), scattered(0));
                return {r.ending == Ending::at_rest && off <= bound, in_words(off)};
              });
}

// The largest gap at which the whole rack is hit at one instant.
double cluster_threshold() {
  const std::size_t all = scattered(0).together;
  double low = 1e-6, high = 1e-3;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (scattered(middle).together >= all / 2 ? low : high) = middle;
  }
  return low;
}

NamedScene jump_at_the_threshold() {
  return runs("rack gap at the cluster threshold", "found between 1e-5 and 1e-3 m; jump below 0.2",
              rack(0), [](const Simulation<double>&) -> Finding {
                const double edge = cluster_threshold();
                // Rounding of the places parts the rack's own gaps by 1e-12 of the edge.
                const Scattered below = scattered(edge * (1 - 1e-9));
                const double jump = difference(below, scattered(edge * (1 + 1e-9)));
                const double smooth = difference(below, scattered(edge * (1 - 1e-3)));
                return {edge > 1e-5 && edge < 1e-3 && jump < 0.2 && smooth < 1e-6,
                        "threshold " + in_words(edge) + " m, jump " + in_words(jump) +
                            " of the cue ball's speed; " + in_words(smooth) +
                            " over the last 0.1 % below"};
              });
}

const char* words(Symmetry how) {
  switch (how) {
    case Symmetry::mirrored:
      return "mirrored";
    case Symmetry::rotated:
      return "rotated by 180 degrees";
    case Symmetry::renumbered:
      return "renumbered";
  }
  return "";
}

NamedScene same_when(Symmetry how, const std::string& name, const Scene<double>& scene,
                     SimulationOptions options) {
  return runs(
      name + ", " + words(how), "the same to 1e-12 m times its amplification", scene,
      [=](const Simulation<double>& r) -> Finding {
        const auto image = simulate(transformed(scene, how), options);
        if (!image) {
          return {false, image.error().reason};
        }
        const double off = image_distance(r, *image, scene.table, how);
        const double growth = amplification(scene, options);
        return {image->events.size() == r.events.size() && off <= 1e-12 * growth,
                in_words(off) + " m, amplification " + in_words(growth)};
      },
      options);
}

}  // namespace

void add_racks(std::vector<NamedScene>& out) {
  out.push_back(ends("rack gap 0", rack(0)));
  out.push_back(gap_like_none(1e-12, 1e-9));
  // Directions turn with the gap, by gap / R in each of five rows.
  for (const double gap : {1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
    out.push_back(gap_like_none(gap, 1000 * gap));
  }
  out.push_back(jump_at_the_threshold());
  for (const double gap : {1e-4, 1e-3}) {
    out.push_back(ends("rack gap " + in_words(gap), rack(gap)));
  }
}

void add_symmetries(std::vector<NamedScene>& out) {
  for (const char* table : {"olympiad", "wpa9"}) {
    const RandomShot shot = random_shot({.seed = 5,
                                         .balls = 10,
                                         .table = *preset_table(table),
                                         .materials = *preset_materials("modern")});
    for (const auto how : {Symmetry::mirrored, Symmetry::rotated, Symmetry::renumbered}) {
      out.push_back(same_when(how, "shot of ten balls on " + std::string(table), scene_of(shot),
                              SimulationOptions{}));
    }
  }
  for (const auto how : {Symmetry::mirrored, Symmetry::rotated, Symmetry::renumbered}) {
    out.push_back(same_when(how, "break, gap 0, 50 ms", rack(0), {.t_max = 0.05}));
  }
}

}  // namespace poolhall::test_support
