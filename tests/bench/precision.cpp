// Error against run time, and how errors grow.
#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "physics/reference/reference_simulator.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/methods.hpp"
#include "tests/bench/report.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

struct SceneClass {
  std::string name;
  std::size_t balls;  // 0: a break
  std::size_t full_count;
  double gap = 0;  // m, of the rack
};

RandomShot shot_of(const SceneClass& scenes, std::uint64_t seed) {
  const physics::Table table = *physics::preset_table("olympiad");
  const physics::Materials materials = *physics::preset_materials("olympiad");
  if (scenes.balls == 0) {
    return test_support::random_break(
        {.seed = seed, .gap = scenes.gap, .table = table, .materials = materials});
  }
  return test_support::random_shot(
      {.seed = seed, .balls = scenes.balls, .table = table, .materials = materials});
}

// What one method did on many scenes.
struct Tally {
  std::size_t scenes = 0;
  std::size_t wrong_sequences = 0;
  std::size_t wrong_outcomes = 0;
  std::vector<double> microseconds;
  std::vector<double> position;  // a value a ball, of scenes with the right sequence
  std::vector<double> time_error;

  void add(const Measured& m) {
    ++scenes;
    wrong_outcomes += m.same_outcome ? 0 : 1;
    microseconds.push_back(m.microseconds);
    if (!m.same_sequence) {
      ++wrong_sequences;
      return;
    }
    time_error.push_back(m.time_error);
    position.insert(position.end(), m.position.begin(), m.position.end());
  }
};

std::string percent(std::size_t part, std::size_t whole) {
  return cell(100.0 * static_cast<double>(part) /
              static_cast<double>(std::max<std::size_t>(1, whole))) +
         " %";
}

void add_row(ReportTable& table, const std::string& name, const Tally& t) {
  table.add({name, std::to_string(t.scenes), cell(quantile(t.microseconds, .5)),
             cell(quantile(t.position, .5)), cell(quantile(t.position, .9)),
             cell(quantile(t.position, .999)), cell(quantile(t.position, 1)),
             cell(quantile(t.time_error, 1)), percent(t.wrong_sequences, t.scenes),
             percent(t.wrong_outcomes, t.scenes)});
}

const std::vector<std::string> columns{
    "",      "scenes", "us a shot",    "error m, median", "p90",
    "p99.9", "max",    "event time s", "wrong sequences", "wrong outcomes"};

// The default method on many scenes of each class.
bool accuracy(const BenchOptions& options, std::ostream& out) {
  const std::vector<SceneClass> classes{{"2 balls", 2, 3000, 0},
                                        {"4 balls", 4, 2500, 0},
                                        {"8 balls", 8, 2500, 0},
                                        {"16 balls", 16, 2000, 0},
                                        {"break, gap 1e-6 m", 0, 300, 1e-6},
                                        {"break, gap 1e-5 m", 0, 300, 1e-5},
                                        {"break, gap 1e-4 m", 0, 400, 1e-4}};
  const Method method = event_methods().front();
  ReportTable table("Accuracy of the " + method.name + " against 100 digits", columns);
  Tally shots;
  std::size_t wrong = 0;
  for (const SceneClass& scenes : classes) {
    Tally tally;
    for (std::size_t i = 0; i < scaled_count(scenes.full_count, options); ++i) {
      const RandomShot shot = shot_of(scenes, options.seed * 1'000'000 + i);
      const Measured m = method.run(shot, reference_simulate(reference_scene(shot), {}));
      tally.add(m);
      if (scenes.balls != 0) {
        shots.add(m);
      }
    }
    add_row(table, scenes.name, tally);
    wrong += tally.wrong_sequences;
  }
  add_row(table, "all but breaks", shots);
  table.print(out);
  table.write_csv(options.directory / "accuracy.csv");
  out << "  goal: no wrong sequence (" << wrong
      << " found), median <= 1e-14 m, p99.9 <= 1e-11 m\n\n";
  return wrong == 0 && quantile(shots.position, .5) <= 1e-14 &&
         quantile(shots.position, .999) <= 1e-11;
}

// Every method on the same scenes: the work-precision diagram.
void work_precision(const BenchOptions& options, std::ostream& out) {
  std::vector<std::pair<RandomShot, ReferenceSimulation>> scenes;
  for (std::size_t i = 0; i < scaled_count(100, options); ++i) {
    RandomShot shot = shot_of({"", 2 + i % 7, 0}, options.seed * 2'000'000 + i);
    ReferenceSimulation truth = reference_simulate(reference_scene(shot), {});
    scenes.emplace_back(std::move(shot), std::move(truth));
  }
  std::vector<Method> methods = event_methods();
  for (Method& method : stepping_methods()) {
    methods.push_back(std::move(method));
  }
  ReportTable table("Error against run time, 2 to 8 balls, every method on the same scenes",
                    columns);
  LogLogPlot plot{"Error against run time",
                  "microseconds a shot (median)",
                  "error of final positions, m (90 % below)",
                  {}};
  for (const Method& method : methods) {
    Tally tally;
    std::vector<double> every_position;
    for (const auto& [shot, truth] : scenes) {
      Measured m = method.run(shot, truth);
      tally.add(m);
      every_position.insert(every_position.end(), m.position.begin(), m.position.end());
    }
    // Shots with a wrong sequence count too: an error is an error.
    tally.position = every_position;
    add_row(table, method.name, tally);
    const auto same_family = [&](const PlotSeries& s) { return s.name == method.family; };
    auto series = std::find_if(plot.series.begin(), plot.series.end(), same_family);
    if (series == plot.series.end()) {
      plot.series.push_back({method.family, {}});
      series = std::prev(plot.series.end());
    }
    series->points.push_back(
        {quantile(tally.microseconds, .5), std::max(1e-20, quantile(every_position, .9))});
  }
  table.print(out);
  out << '\n';
  table.write_csv(options.directory / "precision.csv");
  plot.write_svg(options.directory / "precision.svg");
}

// How much a change of 1e-40 m of the cue ball's place moves the balls in the end, by the number
// of ball collisions in the shot: measured where nothing is rounded.
void growth(const BenchOptions& options, std::ostream& out) {
  using physics::reference::Number;
  std::map<std::size_t, std::vector<double>> by_collisions;
  for (std::size_t i = 0; i < scaled_count(600, options); ++i) {
    const RandomShot shot = shot_of({"", 2 + i % 15, 0}, options.seed * 3'000'000 + i);
    const auto truth = reference_simulate(reference_scene(shot), {});
    physics::reference::ReferenceOptions moved;
    moved.cue_ball_shift = "1e-40";
    const auto other = reference_simulate(reference_scene(shot), moved);
    const auto collisions = static_cast<std::size_t>(std::count_if(
        truth.events.begin(), truth.events.end(),
        [](const auto& event) { return event.type == physics::EventType::ball_collision; }));
    Number largest = 0;
    for (std::size_t k = 0; k < truth.balls.size(); ++k) {
      const auto d = truth.balls[k].position - other.balls[k].position;
      largest = std::max<Number>(largest, sqrt(dot(d, d)));
    }
    by_collisions[std::min<std::size_t>(collisions, 12)].push_back(
        static_cast<double>(Number(largest / Number("1e-40"))));
  }
  ReportTable table(
      "Growth of a change of the cue ball's place, by ball collisions in the shot",
      {"ball collisions", "shots", "median", "p90", "max", "error of an ulp of 1 m, median"});
  for (const auto& [collisions, growths] : by_collisions) {
    table.add({(collisions == 12 ? "12 or more" : std::to_string(collisions)),
               std::to_string(growths.size()), cell(quantile(growths, .5)),
               cell(quantile(growths, .9)), cell(quantile(growths, 1)),
               cell(quantile(growths, .5) * 0x1p-52)});
  }
  table.print(out);
  table.write_csv(options.directory / "growth.csv");
  // Least squares of log10(median growth) on the number of collisions.
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [collisions, growths] : by_collisions) {
    if (growths.size() >= 5 && collisions < 12) {
      const double x = static_cast<double>(collisions);
      const double y = std::log10(quantile(growths, .5));
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
  }
  if (n >= 2) {
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    const double level = (sy - slope * sx) / n;
    out << "  a collision multiplies a change by " << cell(std::pow(10, slope))
        << "; an ulp (2.2e-16 m) is 1 mm after " << cell((12.65 - level) / slope)
        << " collisions: beyond that horizon double no longer knows the shot\n\n";
  }
}

}  // namespace

std::size_t scaled_count(std::size_t full, const BenchOptions& options) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::llround(static_cast<double>(full) * options.share)));
}

bool bench_precision(const BenchOptions& options, std::ostream& out) {
  const bool held = accuracy(options, out);
  work_precision(options, out);
  growth(options, out);
  return held;
}

}  // namespace poolhall::bench
