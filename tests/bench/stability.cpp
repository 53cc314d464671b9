// The extreme scenes, expected against found, and what random shots and breaks must never do.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

#include "physics/adaptive_loop.hpp"
#include "physics/energy.hpp"
#include "physics/watch.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/stability_parts.hpp"
#include "tests/support/random_shots.hpp"
#include "tests/support/scenes.hpp"

namespace poolhall::bench {

namespace {

using physics::Ball;
using physics::Segment;
using test_support::RandomShot;

// A sequence of hundreds of events must not make every line of the table as long.
std::string in_short(const std::string& found) {
  constexpr std::size_t most = 100;
  return found.size() <= most ? found : found.substr(0, most - 4) + " ...";
}

bool extreme_scenes(const BenchOptions& options, std::ostream& out) {
  ReportTable table("Extreme scenes", {"scene", "expected", "found", ""});
  std::size_t wrong = 0, count = 0;
  for (const auto& scene : test_support::extreme_scenes()) {
    const auto finding = scene.judge(physics::simulate(scene.scene, scene.options));
    wrong += finding.as_expected ? 0 : 1;
    table.add(
        {scene.name, scene.expected, in_short(finding.found), finding.as_expected ? "" : "WRONG"});
    ++count;
  }
  table.print(out);
  table.write_csv(options.directory / "stability.csv");
  out << "  " << count << " scenes, " << wrong << " not as expected\n\n";
  return wrong == 0;
}

// What was seen of many shots.
struct Watched {
  std::size_t shots = 0;
  std::size_t events = 0;
  std::size_t unfinished = 0;  // a bound was met
  std::size_t not_finite = 0;
  double overlap = 0;      // m, deepest at any event
  double outside = 0;      // m, furthest beyond where a centre may be
  double energy_rise = 0;  // J beyond the counted separation energy
};

// Where every ball is as the log is read forward.
class Playback {
 public:
  Playback(const RandomShot& shot, const physics::Coefficients<double>& c) : shot_(shot), c_(c) {
    for (std::size_t i = 0; i < shot.balls.count; ++i) {
      segments_[i] = physics::segment(shot.balls[i], physics::Instant<double>{}, c_);
    }
  }

  void see(const physics::Event<double>& event, Watched& seen) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      const Ball<double>& ball = event.after[i];
      const auto id = static_cast<std::size_t>(number(ball.id));
      const bool finite = std::isfinite(ball.position.x + ball.position.y + ball.velocity.x +
                                        ball.velocity.y + ball.angular_velocity.x +
                                        ball.angular_velocity.y + ball.angular_velocity.z);
      seen.not_finite += finite ? 0 : 1;
      down_[id] = ball.state == physics::MotionState::pocketed;
      const physics::Instant<double> since{event.until.value_or(event.t), 0};
      segments_[id] = physics::segment(ball, since, c_);
      seen.outside = std::max(seen.outside, outside(ball.position, down_[id]));
      for (std::size_t k = 0; k < shot_.balls.count; ++k) {
        // An entry of many hops is a state of a later time: its ball is looked at next time.
        if (k != id && !down_[k] && !down_[id] && event.count == 1) {
          const auto d = at(k, event.t) - ball.position;
          seen.overlap = std::max(seen.overlap, c_.diameter - length(d));
        }
      }
    }
  }

 private:
  [[nodiscard]] physics::Vec2<double> at(std::size_t k, double t) const {
    const double since = t - segments_[k].start.high;
    return since < 0 ? physics::Vec2<double>{1e3 * static_cast<double>(k + 1), 1e3}
                     : physics::position_at(segments_[k], std::min(since, segments_[k].duration));
  }

  // Beyond the noses of a table with mouth lines; beyond the cushions of one with jaws.
  [[nodiscard]] double outside(const physics::Vec2<double>& p, bool down) const {
    const bool jaws = std::holds_alternative<physics::Jaws>(shot_.table.pockets);
    const double margin = jaws ? -0.0508 - c_.radius : (down ? 0 : c_.radius);
    return std::max({margin - p.x, margin - p.y, p.x - (shot_.table.width - margin),
                     p.y - (shot_.table.length - margin)});
  }

  const RandomShot& shot_;
  const physics::Coefficients<double>& c_;
  std::array<Segment<double>, physics::max_balls> segments_{};
  std::array<bool, physics::max_balls> down_{};
};

void play(const RandomShot& shot, Watched& seen) {
  const physics::Scene<double> scene = test_support::scene_of(shot);
  const auto c = physics::coefficients<double>(shot.materials);
  physics::AdaptiveLoop<double> loop(scene.table, scene.materials);
  physics::Recorder<double> recorder;
  const physics::Ending ending = loop.run(scene.balls, scene.shot, {}, recorder);
  ++seen.shots;
  seen.unfinished += ending == physics::Ending::at_rest ? 0 : 1;
  Playback playback(shot, c);
  for (const auto& event : recorder.take()) {
    ++seen.events;
    playback.see(event, seen);
  }
  const auto& energy = loop.energy();
  seen.energy_rise =
      std::max(seen.energy_rise, energy.end - energy.start - energy.added_by_separation);
}

bool random_play(const BenchOptions& options, std::ostream& out) {
  ReportTable table("Random shots (2 to 16 balls) and breaks (gaps 0 to 1 mm)",
                    {"table", "materials", "", "shots", "events", "bound met", "not finite",
                     "overlap m", "outside m", "energy risen J"});
  bool held = true;
  const double gaps[] = {0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3};
  for (const char* where : {"olympiad", "bar7"}) {
    for (const char* what : {"olympiad", "modern"}) {
      const physics::Table cloth = *physics::preset_table(where);
      const physics::Materials materials = *physics::preset_materials(what);
      Watched shots;
      for (std::size_t i = 0; i < scaled_count(250'000, options); ++i) {
        play(test_support::random_shot({.seed = options.seed * 6'000'000 + i,
                                        .balls = 2 + i % 15,
                                        .table = cloth,
                                        .materials = materials}),
             shots);
      }
      Watched breaks;
      for (std::size_t i = 0; i < scaled_count(25'000, options); ++i) {
        play(test_support::random_break({.seed = options.seed * 7'000'000 + i,
                                         .gap = gaps[i % std::size(gaps)],
                                         .table = cloth,
                                         .materials = materials}),
             breaks);
      }
      for (const Watched* w : {&shots, &breaks}) {
        held = held && w->unfinished == 0 && w->not_finite == 0 && w->overlap <= 1e-12 &&
               w->outside <= 1e-12 && w->energy_rise <= 1e-12;
        table.add({where, what, w == &shots ? "shots" : "breaks", std::to_string(w->shots),
                   std::to_string(w->events), std::to_string(w->unfinished),
                   std::to_string(w->not_finite), cell(w->overlap), cell(std::max(0.0, w->outside)),
                   cell(std::max(0.0, w->energy_rise))});
      }
    }
  }
  table.print(out);
  table.write_csv(options.directory / "robustness.csv");
  out << "  goal: no bound met, all finite, overlap and outside <= 1e-12 m, energy never risen\n\n";
  return held;
}

}  // namespace

bool bench_stability(const BenchOptions& options, std::ostream& out) {
  const bool scenes = extreme_scenes(options, out);
  const bool clusters = clusters_against_springs(options, out);
  const bool steps = stiff_steps(options, out);
  const bool random = random_play(options, out);
  return scenes && clusters && steps && random;
}

}  // namespace poolhall::bench
