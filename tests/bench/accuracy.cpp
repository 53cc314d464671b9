// Random shots and breaks against 100 digits, every difference in the sequence explained.
#include <algorithm>
#include <array>
#include <ostream>

#include "tests/bench/against_reference.hpp"
#include "tests/bench/event_runs.hpp"
#include "tests/bench/precision_parts.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/scene_classes.hpp"
#include "tests/bench/tie_proof.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

// What one way of playing did on many scenes.
struct Accuracy {
  std::array<std::size_t, 4> verdicts{};
  std::vector<double> position;  // m, of the ball that is furthest off, where the events are right
  std::vector<double> time;      // s, of the event that is furthest off
  std::vector<std::string> unexplained;

  void add(const Accuracy& other) {
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      verdicts[i] += other.verdicts[i];
    }
    position.insert(position.end(), other.position.begin(), other.position.end());
    time.insert(time.end(), other.time.begin(), other.time.end());
    unexplained.insert(unexplained.end(), other.unexplained.begin(), other.unexplained.end());
  }

  void add(const RandomShot& shot, const std::string& name, const physics::Simulation<double>& run,
           const ReferenceSimulation& truth) {
    const Difference d = difference(run, truth);
    const Verdict v = verdict(shot, timed_events(run.events), truth);
    ++verdicts[static_cast<std::size_t>(v)];
    if (d.sequence.same) {
      position.push_back(d.position);
      time.push_back(
          *std::max_element(d.sequence.time_errors.begin(), d.sequence.time_errors.end()));
    }
    if (v == Verdict::unexplained) {
      unexplained.push_back(name + ": " + d.sequence.first_difference);
    }
  }
};

struct Ways {
  Accuracy simulated;  // as `simulate` plays
  Accuracy plain;      // in double throughout, as `evaluate` does
  Accuracy wide;       // balls kept in wider numbers throughout

  void add(const Ways& other) {
    simulated.add(other.simulated);
    plain.add(other.plain);
    wide.add(other.wide);
  }
};

void add_row(ReportTable& table, const std::string& name, const std::string& way,
             const Accuracy& a) {
  const std::vector<double> position = quantiles(a.position, {.5, .999, 1});
  const std::vector<double> time = quantiles(a.time, {.5, .999, 1});
  std::size_t scenes = 0;
  for (const std::size_t n : a.verdicts) {
    scenes += n;
  }
  table.add({name, way, std::to_string(scenes), std::to_string(a.verdicts[0]),
             std::to_string(a.verdicts[1]), std::to_string(a.verdicts[2]),
             std::to_string(a.verdicts[3]), cell(position[0]), cell(position[1]), cell(position[2]),
             cell(time[0]), cell(time[1]), cell(time[2])});
}

void add_rows(ReportTable& table, const std::string& name, const Ways& ways) {
  add_row(table, name, "as simulate", ways.simulated);
  add_row(table, name, "plain double", ways.plain);
  add_row(table, name, "wider numbers", ways.wide);
}

Ways played_against_reference(const SceneClass& scenes, const BenchOptions& options) {
  Ways ways;
  for (std::size_t i = 0; i < scaled_count(scenes.full_count, options); ++i) {
    const std::uint64_t seed = options.seed * 1'000'000 + i;
    const RandomShot shot = shot_of(scenes, seed);
    const ReferenceSimulation truth = reference_simulate(reference_scene(shot), {});
    const std::string name = scenes.name + ", seed " + std::to_string(seed);
    const auto solver = physics::RootSolver::bracketed;
    using physics::EventLoop;
    ways.simulated.add(shot, name, played<double, physics::AdaptiveLoop<double>>(shot, solver),
                       truth);
    ways.plain.add(shot, name, played<double, EventLoop<double>>(shot, solver), truth);
    ways.wide.add(shot, name, played<double, EventLoop<double, physics::Precise>>(shot, solver),
                  truth);
  }
  return ways;
}

}  // namespace

bool accuracy(const BenchOptions& options, std::ostream& out) {
  const std::vector<SceneClass> classes{{"2 balls", 2, 3000},
                                        {"4 balls", 4, 2500},
                                        {"8 balls", 8, 2500},
                                        {"16 balls", 16, 2000},
                                        {"break, gap 1e-6 m", 0, 300, 1e-6},
                                        {"break, gap 1e-5 m", 0, 300, 1e-5},
                                        {"break, gap 1e-4 m", 0, 400, 1e-4}};
  ReportTable table(
      "Accuracy against 100 digits; errors are those of a shot's ball, or event, that is furthest "
      "off",
      {"", "played", "scenes", "same events", "proven ties", "flip under an ulp", "unexplained",
       "position m, median", "p99.9", "max", "event time s, median", "p99.9", "max"});
  Ways shots;
  Ways breaks;
  for (const SceneClass& scenes : classes) {
    const Ways ways = played_against_reference(scenes, options);
    add_rows(table, scenes.name, ways);
    (scenes.balls == 0 ? breaks : shots).add(ways);
  }
  Ways all = shots;
  all.add(breaks);
  add_rows(table, "all shots", shots);
  add_rows(table, "all breaks", breaks);
  add_rows(table, "all", all);
  table.print(out);
  table.write_csv(options.directory / "accuracy.csv");
  for (const Accuracy* way : {&all.simulated, &all.plain, &all.wide}) {
    for (const std::string& line : way->unexplained) {
      out << "  " << line << '\n';
    }
  }
  const std::size_t unexplained =
      all.simulated.unexplained.size() + all.plain.unexplained.size() + all.wide.unexplained.size();
  const std::vector<double> found = quantiles(all.simulated.position, {.5, .999});
  out << "  goal: no unexplained difference (" << unexplained
      << " found); as simulate plays, over all scenes, median <= 1e-14 m (" << cell(found[0])
      << ") and p99.9 <= 1e-11 m (" << cell(found[1]) << ")\n\n";
  return unexplained == 0 && found[0] <= 1e-14 && found[1] <= 1e-11;
}

}  // namespace poolhall::bench
