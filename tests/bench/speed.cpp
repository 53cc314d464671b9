// Microseconds a shot, alone and against the paper's own scheme.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>

#include "physics/adaptive_loop.hpp"
#include "physics/quartic_closed_form.hpp"
#include "physics/watch.hpp"
#include "protocol/scene_json.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/paper_scheme.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/timing.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

namespace {

using test_support::RandomShot;

struct SpeedClass {
  std::string name;
  std::size_t balls;  // 0: a break
  double goal;        // us
  double goal_ratio;  // to the paper's scheme
};

struct Timings {
  std::vector<double> core;  // as `simulate` plays it
  std::vector<double> plain;
  std::vector<double> wide;
  std::vector<double> paper;
  std::vector<double> an_event;
  std::vector<double> events;
  int careful = 0;  // shots played again in wider numbers
};

RandomShot speed_shot(const SpeedClass& scenes, std::uint64_t seed) {
  const physics::Table table = *physics::preset_table("olympiad");
  const physics::Materials materials = *physics::preset_materials("olympiad");
  if (scenes.balls == 0) {
    return test_support::random_break({.seed = seed, .table = table, .materials = materials});
  }
  return test_support::random_shot(
      {.seed = seed, .balls = scenes.balls, .table = table, .materials = materials});
}

Timings time_class(const SpeedClass& scenes, const BenchOptions& options) {
  Timings t;
  for (std::size_t i = 0; i < scaled_count(1000, options); ++i) {
    const RandomShot shot = speed_shot(scenes, options.seed * 4'000'000 + i);
    const physics::Scene<double> scene = test_support::scene_of(shot);
    physics::SimulationOptions how;
    how.contact = physics::ContactModel::sequential;
    const auto time = [&](auto& loop) {
      return least_microseconds(5, [&] {
        physics::Unwatched none;
        static_cast<void>(loop.run(scene.balls, scene.shot, how, none));
      });
    };
    physics::AdaptiveLoop<double> loop(scene.table, scene.materials);
    physics::EventLoop<double> plain(scene.table, scene.materials);
    physics::EventLoop<double, physics::Precise> wide(scene.table, scene.materials);
    PaperScheme<double> paper(scene.table, scene.materials);
    t.core.push_back(time(loop));
    t.plain.push_back(time(plain));
    t.wide.push_back(time(wide));
    t.careful += loop.was_careful() ? 1 : 0;
    t.paper.push_back(
        least_microseconds(3, [&] { static_cast<void>(paper.run(scene.balls, scene.shot)); }));
    t.events.push_back(loop.events());
    t.an_event.push_back(t.core.back() / std::max<double>(1, loop.events()));
  }
  return t;
}

// Nanoseconds of one closed-form contact search, over pairs as they come in shots.
double quartic_nanoseconds(const BenchOptions& options) {
  std::vector<physics::PairMotion<double>> pairs;
  const physics::Materials materials = *physics::preset_materials("olympiad");
  const auto c = physics::coefficients<double>(materials);
  for (std::size_t i = 0; i < 4096; ++i) {
    const RandomShot shot = speed_shot({"", 2, 0, 0}, options.seed * 5'000'000 + i);
    const physics::Scene<double> scene = test_support::scene_of(shot);
    const auto struck =
        physics::settled(physics::strike(scene.balls[0], *scene.shot, materials), c.radius);
    pairs.push_back(physics::pair_motion(physics::segment(struck, {}, c),
                                         physics::segment(scene.balls[1], {}, c), {}, c));
  }
  double sum = 0;
  const double took = least_microseconds(20, [&] {
    for (const auto& pair : pairs) {
      sum += physics::closed_form_contact(pair, 10.0, physics::Polish::no).value_or(0.0);
    }
  });
  return std::isfinite(sum) ? 1000 * took / static_cast<double>(pairs.size()) : NAN;
}

void time_scene_file(const std::filesystem::path& file, std::ostream& out) {
  std::ifstream in(file);
  if (!in) {
    throw std::invalid_argument("cannot read " + file.string());
  }
  std::vector<double> times;
  std::vector<double> events;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    const auto where = file.string() + ":" + std::to_string(number) + ": ";
    const auto given = protocol::decode_scene(line);
    if (!given) {
      throw std::invalid_argument(where + given.error().field + ": " + given.error().reason);
    }
    const physics::Scene<double> scene = protocol::scene_of(*given);
    if (const auto possible = physics::check_scene(scene); !possible) {
      throw std::invalid_argument(where + possible.error().field + ": " + possible.error().reason);
    }
    physics::AdaptiveLoop<double> loop(scene.table, scene.materials);
    times.push_back(least_microseconds(5, [&] {
      physics::Unwatched none;
      static_cast<void>(loop.run(scene.balls, scene.shot, given->options, none));
    }));
    events.push_back(loop.events());
  }
  if (in.bad()) {  // a folder can be opened, but not read
    throw std::invalid_argument("cannot read " + file.string());
  }
  ReportTable table("Run time of the scenes in " + file.string() + ", event log off",
                    {"scenes", "us a shot, median", "p90", "events, median"});
  table.add({std::to_string(times.size()), cell(quantile(times, .5)), cell(quantile(times, .9)),
             cell(quantile(events, .5))});
  table.print(out);
}

}  // namespace

bool bench_speed(const BenchOptions& options, std::ostream& out) {
  if (!options.scenes.empty()) {
    time_scene_file(options.scenes, out);
    return true;
  }
  const std::vector<SpeedClass> classes{{"cue ball + 1", 2, 1.2, 2},
                                        {"8 balls", 8, 3.5, 4},
                                        {"16 balls", 16, 8, 5},
                                        {"break, gap 0.1 mm", 0, 100, 10}};
  ReportTable table(
      "Run time as simulate plays a shot, event log off, sequential contacts, one core",
      {"", "shots", "us a shot, median", "p90", "goal", "events, median", "us an event",
       "played again in wider numbers", "plain double us", "wider numbers us", "paper's scheme us",
       "ratio of medians", "goal"});
  bool held = true;
  for (const SpeedClass& scenes : classes) {
    const Timings t = time_class(scenes, options);
    const double core = quantile(t.core, .5);
    const double paper = quantile(t.paper, .5);
    held = held && core <= scenes.goal && paper / core >= scenes.goal_ratio;
    table.add({scenes.name, std::to_string(t.core.size()), cell(core), cell(quantile(t.core, .9)),
               "<= " + cell(scenes.goal), cell(quantile(t.events, .5)),
               cell(quantile(t.an_event, .5)),
               cell(100.0 * t.careful / static_cast<double>(t.core.size())) + " %",
               cell(quantile(t.plain, .5)), cell(quantile(t.wide, .5)), cell(paper),
               cell(paper / core), ">= " + cell(scenes.goal_ratio)});
  }
  table.print(out);
  table.write_csv(options.directory / "speed.csv");
  const double quartic = quartic_nanoseconds(options);
  out << "  the paper's scheme solves a quartic in " << cell(quartic)
      << " ns here (it must be at most 150 for the ratio to be fair)\n\n";
  return held && quartic <= 150;
}

}  // namespace poolhall::bench
