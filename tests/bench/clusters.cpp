// The instantaneous cluster against its elastic truth: what `cluster` and `hertz` make of breaks.
#include <cmath>
#include <ostream>

#include "physics/simulator.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/stability_parts.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

namespace {

using physics::ContactModel;
using physics::Simulation;

struct CueContact {
  double t = 0;      // s
  double speed = 0;  // m/s, of the cue ball as it arrives
};

// The cue ball alone, up to the rack: what it brings, the same for both models.
CueContact cue_contact(const physics::Scene<double>& scene) {
  const auto whole = physics::simulate(scene, {.contact = ContactModel::sequential, .t_max = 2});
  for (const auto& event : whole->events) {
    if (event.type == physics::EventType::ball_collision) {
      const auto before = physics::simulate(
          scene, {.contact = ContactModel::sequential, .t_max = event.t * (1 - 1e-9)});
      return {event.t, length(before->balls[0].velocity)};
    }
  }
  return {};
}

Simulation<double> after_impact(const physics::Scene<double>& scene, const CueContact& contact,
                                ContactModel model, double later) {
  return *physics::simulate(scene, {.contact = model, .t_max = contact.t + later});
}

// Root of the mean square of the balls' velocity differences, in the cue ball's speed.
double velocity_error(const Simulation<double>& one, const Simulation<double>& other,
                      double speed) {
  double sum = 0;
  for (std::size_t i = 0; i < one.balls.count; ++i) {
    const auto d = one.balls[i].velocity - other.balls[i].velocity;
    sum += dot(d, d);
  }
  return std::sqrt(sum / static_cast<double>(one.balls.count)) / speed;
}

struct Comparison {
  std::size_t breaks = 0;
  std::vector<double> errors;
  [[nodiscard]] double rms() const {
    double sum = 0;
    for (const double e : errors) {
      sum += e * e;
    }
    return std::sqrt(sum / static_cast<double>(errors.size()));
  }
};

Comparison compare(double gap, double later, const char* materials, const BenchOptions& options) {
  Comparison out;
  const std::size_t wanted = scaled_count(100, options);
  for (std::size_t i = 0; out.breaks < wanted; ++i) {
    const auto scene = test_support::scene_of(
        test_support::random_break({.seed = options.seed * 9'000'000 + i,
                                    .gap = gap,
                                    .table = *physics::preset_table("olympiad"),
                                    .materials = *physics::preset_materials(materials)}));
    const CueContact contact = cue_contact(scene);
    if (!(contact.speed > 0)) {
      continue;  // missed the rack
    }
    ++out.breaks;
    out.errors.push_back(velocity_error(after_impact(scene, contact, ContactModel::cluster, later),
                                        after_impact(scene, contact, ContactModel::hertz, later),
                                        contact.speed));
  }
  return out;
}

}  // namespace

bool clusters_against_springs(const BenchOptions& options, std::ostream& out) {
  constexpr double limit = 0.15;
  ReportTable table(
      "`cluster` against `hertz`: velocity error of the 16 balls of a break, in cue "
      "ball speeds",
      {"gap m", "materials", "ms later", "breaks", "rms", "median", "worst"});
  bool held = true;
  for (const double gap : {0.0, 1e-4}) {
    for (const char* materials : {"olympiad", "modern"}) {
      for (const double later : {1e-9, 2e-3}) {
        const Comparison c = compare(gap, later, materials, options);
        held = held && c.rms() <= limit;
        table.add({cell(gap), materials, cell(1000 * later), std::to_string(c.breaks),
                   cell(c.rms()), cell(quantile(c.errors, .5)), cell(quantile(c.errors, 1))});
      }
    }
  }
  table.print(out);
  table.write_csv(options.directory / "clusters.csv");
  out << "  goal: rms <= 0.15\n\n";
  return held;
}

}  // namespace poolhall::bench
