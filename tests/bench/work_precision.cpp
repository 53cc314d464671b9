// Every method on the same scenes: error against run time.
#include <algorithm>
#include <ostream>

#include "tests/bench/event_runs.hpp"
#include "tests/bench/methods.hpp"
#include "tests/bench/precision_parts.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/scene_classes.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

// What one method did on many scenes. Shots with a wrong sequence count too: an error is an error.
struct Tally {
  std::size_t scenes = 0;
  std::size_t wrong_sequences = 0;
  std::size_t wrong_outcomes = 0;
  std::vector<double> microseconds;
  std::vector<double> position;  // a value a shot, of the ball that is furthest off
  std::vector<double> time;      // a value an event, up to the first that is another

  void add(const Measured& m) {
    ++scenes;
    wrong_outcomes += m.same_outcome ? 0 : 1;
    wrong_sequences += m.same_sequence ? 0 : 1;
    microseconds.push_back(m.microseconds);
    if (!m.position.empty()) {
      position.push_back(*std::max_element(m.position.begin(), m.position.end()));
    }
    time.insert(time.end(), m.time_errors.begin(), m.time_errors.end());
  }
};

std::string percent(std::size_t part, std::size_t whole) {
  return cell(100.0 * static_cast<double>(part) / static_cast<double>(whole)) + " %";
}

const std::vector<std::string> method_columns{
    "",      "us a shot", "position m, median",   "p90",
    "p99.9", "max",       "event time s, median", "p90",
    "p99.9", "max",       "wrong sequences",      "wrong outcomes"};

void add_row(ReportTable& table, const std::string& name, const Tally& t) {
  std::vector<std::string> row{name, cell(quantile(t.microseconds, .5))};
  for (const std::vector<double>* errors : {&t.position, &t.time}) {
    for (const double value : quantiles(*errors, {.5, .9, .999, 1})) {
      row.push_back(cell(value));
    }
  }
  row.push_back(percent(t.wrong_sequences, t.scenes));
  row.push_back(percent(t.wrong_outcomes, t.scenes));
  table.add(std::move(row));
}

void add_point(LogLogPlot& plot, const Method& method, const Tally& t) {
  auto series = std::find_if(plot.series.begin(), plot.series.end(),
                             [&](const PlotSeries& s) { return s.name == method.family; });
  if (series == plot.series.end()) {
    plot.series.push_back({method.family, {}});
    series = std::prev(plot.series.end());
  }
  series->points.push_back(
      {quantile(t.microseconds, .5), std::max(1e-20, quantile(t.position, .9)), method.label});
}

}  // namespace

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
  ReportTable table("Error against run time, " + std::to_string(scenes.size()) +
                        " shots of 2 to 8 balls, every method on the same",
                    method_columns);
  LogLogPlot plot{"Error against run time, shots of 2 to 8 balls",
                  "microseconds a shot (median)",
                  "error of final positions, m (90 % of shots below)",
                  {}};
  for (const Method& method : methods) {
    Tally tally;
    for (const auto& [shot, truth] : scenes) {
      tally.add(method.run(shot, truth));
    }
    add_row(table, method.name, tally);
    add_point(plot, method, tally);
  }
  table.print(out);
  out << '\n';
  table.write_csv(options.directory / "precision.csv");
  plot.write_svg(options.directory / "precision.svg");
}

}  // namespace poolhall::bench
