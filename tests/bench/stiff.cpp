// Step sweeps of the stiff parts: energy drift, error, largest stable step, explicit against
// implicit methods.
#include <cmath>
#include <ostream>

#include "tests/bench/report.hpp"
#include "tests/bench/stability_parts.hpp"
#include "tests/bench/stiff_problems.hpp"

namespace poolhall::bench {

namespace {

constexpr int finest = 12;  // steps of 2^0 to 2^-12

struct Sweep {
  std::string_view method;
  bool is_implicit = false;
  std::vector<StiffResult> results;  // by halvings of the step
};

// Energy within 1 % of what it should be at this step and at every smaller one.
double largest_stable_step(const Sweep& sweep) {
  double largest = 0;
  for (int k = finest; k >= 0; --k) {
    if (!(std::abs(sweep.results[static_cast<std::size_t>(k)].energy_drift) <= 0.01)) {
      break;
    }
    largest = std::ldexp(1.0, -k);
  }
  return largest;
}

std::vector<Sweep> sweeps(const StiffProblem& problem) {
  std::vector<Sweep> out;
  for (const StiffMethod& method : stiff_methods()) {
    if (method.needs_places && !problem.has_places) {
      continue;
    }
    Sweep sweep{method.name, method.is_implicit, {}};
    for (int k = 0; k <= finest; ++k) {
      sweep.results.push_back(problem.solve(method, std::ldexp(1.0, -k)));
    }
    out.push_back(std::move(sweep));
  }
  return out;
}

LogLogPlot plot_of(const StiffProblem& problem, const std::vector<Sweep>& all,
                   double StiffResult::*value, const std::string& what) {
  LogLogPlot plot{problem.name + ": " + what, "step, " + problem.unit, what, {}};
  for (const Sweep& sweep : all) {
    PlotSeries series{std::string(sweep.method), {}};
    for (int k = 0; k <= finest; ++k) {
      const double y = std::abs(sweep.results[static_cast<std::size_t>(k)].*value);
      // What has blown up has no place in the picture.
      if (y < 1e3) {
        series.points.push_back({std::ldexp(1.0, -k), std::max(y, 1e-16)});
      }
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

void add_rows(const StiffProblem& problem, const Sweep& sweep, ReportTable& table,
              ReportTable& all) {
  const auto at = [&sweep](int k) { return sweep.results[static_cast<std::size_t>(k)]; };
  const char* kind = sweep.is_implicit ? "implicit" : "explicit";
  const double stable = largest_stable_step(sweep);
  std::vector<std::string> row{problem.name, std::string(sweep.method), kind,
                               stable > 0 ? "1/" + cell(1 / stable) : "none"};
  for (const int k : {2, 4, 8, 12}) {
    row.push_back(cell(at(k).error));
    row.push_back(cell(at(k).energy_drift));
  }
  table.add(std::move(row));
  for (int k = 0; k <= finest; ++k) {
    all.add({problem.name, std::string(sweep.method), kind, cell(std::ldexp(1.0, -k), 7),
             cell(at(k).error, 6), cell(at(k).energy_drift, 6)});
  }
}

}  // namespace

bool stiff_steps(const BenchOptions& options, std::ostream& out) {
  ReportTable table(
      "Stiff parts: fixed steps, explicit and implicit; error of the velocities "
      "after the impact and energy drift",
      {"part", "method", "", "largest stable", "error 1/4", "drift", "error 1/16", "drift",
       "error 1/256", "drift", "error 1/4096", "drift"});
  ReportTable all("", {"part", "method", "kind", "step", "error", "energy_drift"});
  std::vector<LogLogPlot> plots;
  bool held = true;
  for (const StiffProblem& problem : stiff_problems()) {
    const std::vector<Sweep> found = sweeps(problem);
    for (const Sweep& sweep : found) {
      held = held && largest_stable_step(sweep) > 0;
      add_rows(problem, sweep, table, all);
    }
    plots.push_back(plot_of(problem, found, &StiffResult::error, "velocity error"));
    plots.push_back(plot_of(problem, found, &StiffResult::energy_drift, "energy drift"));
  }
  table.print(out);
  all.write_csv(options.directory / "stiff-steps.csv");
  write_panels(plots, 2, options.directory / "stiff-steps.svg");
  out << "  steps in contact times (hertz, spring) and in impulses that stop the ball "
         "(mathavan2010);\n  stable: energy within 1 % at this step and every smaller one; "
         "goal: every method has such a step\n\n";
  return held;
}

}  // namespace poolhall::bench
