// How an error grows event by event, and where it has grown so far that double no longer knows the
// shot.
// A run in float rounds each number of a scene, all given as doubles: that is what it is for.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "tests/bench/against_reference.hpp"
#include "tests/bench/event_runs.hpp"
#include "tests/bench/precision_parts.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/scene_classes.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::Number;
using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

// m, of the ball of an event that is furthest from where the reference has it right after.
template <class Real>
double place_error(const physics::Event<Real>& event, const physics::Event<Number>& truth) {
  double most = 0;
  for (std::size_t i = 0; i < truth.ball_count; ++i) {
    const Number x = Number(event.after[i].position.x) - truth.after[i].position.x;
    const Number y = Number(event.after[i].position.y) - truth.after[i].position.y;
    most = std::max(most, static_cast<double>(Number(sqrt(x * x + y * y))));
  }
  return most;
}

// Errors by the number of the event in its shot.
struct ByEvent {
  std::vector<std::vector<double>> place;  // m
  std::vector<std::vector<double>> time;   // s

  void add(const physics::Simulation<double>& run, const ReferenceSimulation& truth) {
    const std::size_t shorter = std::min(run.events.size(), truth.events.size());
    for (std::size_t k = 0; k < shorter; ++k) {
      const auto& event = run.events[k];
      const auto& right = truth.events[k];
      if (event.count > 1 || timed_event(event).key != timed_event(right).key) {
        return;
      }
      if (place.size() <= k) {
        place.emplace_back();
        time.emplace_back();
      }
      place[k].push_back(place_error(event, right));
      time[k].push_back(std::abs(static_cast<double>(Number(Number(event.t) - right.t))));
    }
  }
};

void errors_by_event(const BenchOptions& options, std::ostream& out) {
  ByEvent plain;
  ByEvent simulated;
  for (std::size_t i = 0; i < scaled_count(1000, options); ++i) {
    const std::size_t kind = i % 16;
    const SceneClass scenes{"", kind == 0 ? 0 : kind + 1, 0, 1e-4};
    const RandomShot shot = shot_of(scenes, options.seed * 6'000'000 + i);
    const auto truth = reference_simulate(reference_scene(shot), {});
    const auto solver = physics::RootSolver::bracketed;
    plain.add(played<double, physics::EventLoop<double>>(shot, solver), truth);
    simulated.add(played<double, physics::AdaptiveLoop<double>>(shot, solver), truth);
  }
  ReportTable table("Error of each event, shots of 2 to 16 balls and breaks",
                    {"event", "shots", "plain double: place m, median", "p99", "time s, median",
                     "p99", "as simulate: place m, median", "p99", "time s, median", "p99"});
  for (const std::size_t number : {1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 30, 40, 60, 80, 100}) {
    if (number > plain.place.size() || number > simulated.place.size()) {
      break;
    }
    std::vector<std::string> row{std::to_string(number),
                                 std::to_string(plain.place[number - 1].size())};
    for (const ByEvent* way : {&plain, &simulated}) {
      for (const auto* errors : {&way->place[number - 1], &way->time[number - 1]}) {
        for (const double value : quantiles(*errors, {.5, .99})) {
          row.push_back(cell(value));
        }
      }
    }
    table.add(std::move(row));
  }
  table.print(out);
  out << "  places are those right after the event, times and places as the log rounds them\n\n";
  table.write_csv(options.directory / "error_by_event.csv");
}

// The straight line of least squares through points.
struct Line {
  double slope = 0;
  double level = 0;
};

Line fitted(const std::vector<PlotPoint>& points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const PlotPoint& p : points) {
    n += 1, sx += p.x, sy += p.y, sxx += p.x * p.x, sxy += p.x * p.y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {slope, (sy - slope * sx) / n};
}

// How much a change of 1e-40 m of the cue ball's place moves the balls in the end, measured where
// nothing is rounded.
double growth_of_a_change(const RandomShot& shot, const ReferenceSimulation& truth) {
  physics::reference::ReferenceOptions moved;
  moved.cue_ball_shift = "1e-40";
  const auto other = reference_simulate(reference_scene(shot), moved);
  Number largest = 0;
  for (std::size_t k = 0; k < truth.balls.size(); ++k) {
    const auto d = truth.balls[k].position - other.balls[k].position;
    largest = std::max<Number>(largest, sqrt(dot(d, d)));
  }
  return static_cast<double>(Number(largest / Number("1e-40")));
}

constexpr std::size_t most_collisions = 12;  // or more

void growth(const BenchOptions& options, std::ostream& out) {
  std::map<std::size_t, std::vector<double>> by_collisions;
  for (std::size_t i = 0; i < scaled_count(600, options); ++i) {
    const RandomShot shot = shot_of({"", 2 + i % 15, 0}, options.seed * 3'000'000 + i);
    const auto truth = reference_simulate(reference_scene(shot), {});
    const auto collisions = static_cast<std::size_t>(std::count_if(
        truth.events.begin(), truth.events.end(),
        [](const auto& event) { return event.type == physics::EventType::ball_collision; }));
    by_collisions[std::min(collisions, most_collisions)].push_back(growth_of_a_change(shot, truth));
  }
  ReportTable table(
      "Growth of a change of the cue ball's place, by ball collisions in the shot",
      {"ball collisions", "shots", "median", "p90", "max", "error of an ulp of 1 m, median"});
  std::vector<PlotPoint> medians;
  for (const auto& [collisions, growths] : by_collisions) {
    const std::vector<double> q = quantiles(growths, {.5, .9, 1});
    table.add({std::to_string(collisions) + (collisions == most_collisions ? " or more" : ""),
               std::to_string(growths.size()), cell(q[0]), cell(q[1]), cell(q[2]),
               cell(q[0] * 0x1p-52)});
    if (growths.size() >= 5 && collisions < most_collisions) {
      medians.push_back({static_cast<double>(collisions), std::log10(q[0])});
    }
  }
  table.print(out);
  table.write_csv(options.directory / "growth.csv");
  if (medians.size() >= 2) {
    const Line line = fitted(medians);
    out << "  a collision multiplies a change by " << cell(std::pow(10, line.slope))
        << "; an ulp (2.2e-16 m) would be 1 mm after " << cell((12.65 - line.level) / line.slope)
        << " collisions\n\n";
  }
}

// A break on a table without pockets, with next to no friction: it goes on and on.
RandomShot endless_break(std::uint64_t seed) {
  RandomShot shot = shot_of({"", 0, 0, 1e-4}, seed);
  shot.table.pockets = physics::NoPockets{};
  shot.materials.mu_slide = 0.01;
  shot.materials.mu_roll = 1e-3;
  shot.materials.ball_friction = physics::ConstantFriction{0};
  shot.materials.cushion = physics::DampedCushion{0.95, 0.98, 0};
  return shot;
}

// How far the events of many scenes are the reference's.
struct Horizon {
  std::string name;
  std::size_t lost = 0;  // scenes in which they part
  std::vector<double> events{};
  std::vector<double> collisions{};
  std::vector<double> seconds{};

  template <class Real>
  void add(const physics::Simulation<Real>& run, const ReferenceSimulation& truth) {
    const std::vector<TimedEvent> found = timed_events(run.events);
    const Sequence sequence = compare_sequences(found, timed_events(truth.events));
    const std::size_t right = std::min(sequence.time_errors.size(), found.size() - 1);
    const auto departure = found.begin() + static_cast<std::ptrdiff_t>(right);
    lost += sequence.parted ? 1 : 0;
    events.push_back(static_cast<double>(right));
    collisions.push_back(
        static_cast<double>(std::count_if(found.begin(), departure, [](const TimedEvent& event) {
          return event.key.type == physics::EventType::ball_collision;
        })));
    seconds.push_back(departure->t);
  }
};

void horizons(const BenchOptions& options, std::ostream& out) {
  Horizon in_float{"float"}, in_double{"double"}, simulated{"as simulate"}, wide{"long double"};
  const std::size_t limit = 500;
  for (std::size_t i = 0; i < scaled_count(50, options); ++i) {
    const RandomShot shot = endless_break(options.seed * 7'000'000 + i);
    physics::reference::ReferenceOptions so_long;
    so_long.event_limit = limit;
    const auto truth = reference_simulate(reference_scene(shot), so_long);
    const auto solver = physics::RootSolver::bracketed;
    in_float.add(played<float, physics::EventLoop<float>>(shot, solver), truth);
    in_double.add(played<double, physics::EventLoop<double>>(shot, solver), truth);
    simulated.add(played<double, physics::AdaptiveLoop<double>>(shot, solver), truth);
    wide.add(played<long double, physics::EventLoop<long double>>(shot, solver), truth);
  }
  ReportTable table(
      "How long the events are the reference's, breaks with next to no friction, no "
      "pockets, the first " +
          std::to_string(limit) + " events",
      {"", "scenes", "lost", "ball collisions, least", "median", "events, least", "median",
       "s, least", "median"});
  for (const Horizon* h : {&in_float, &in_double, &simulated, &wide}) {
    std::vector<std::string> row{h->name, std::to_string(h->events.size()),
                                 std::to_string(h->lost)};
    for (const auto* values : {&h->collisions, &h->events, &h->seconds}) {
      for (const double value : quantiles(*values, {0, .5})) {
        row.push_back(cell(value));
      }
    }
    table.add(std::move(row));
  }
  table.print(out);
  table.write_csv(options.directory / "horizon.csv");
  out << "  beyond that the number type no longer knows the shot; where it is not lost, the first "
      << limit << " events are right\n\n";
}

}  // namespace

void error_growth(const BenchOptions& options, std::ostream& out) {
  errors_by_event(options, out);
  growth(options, out);
  horizons(options, out);
}

}  // namespace poolhall::bench
