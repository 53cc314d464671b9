// A run in float rounds each number of a scene, all given as doubles: that is what it is for.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"

#include "tests/bench/methods.hpp"

#include <algorithm>
#include <cmath>

#include "physics/adaptive_loop.hpp"
#include "tests/bench/dormand_prince.hpp"
#include "tests/bench/event_runs.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/time_stepping.hpp"
#include "tests/bench/timing.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::Number;
using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

template <class Real>
void compare_balls(const physics::BallSet<Real>& balls, const ReferenceSimulation& truth,
                   Measured& measured) {
  measured.same_outcome = true;
  for (std::size_t i = 0; i < balls.count; ++i) {
    measured.same_outcome = measured.same_outcome && balls[i].pocket == truth.balls[i].pocket;
    if (!balls[i].pocket && !truth.balls[i].pocket) {
      const Number x = Number(balls[i].position.x) - truth.balls[i].position.x;
      const Number y = Number(balls[i].position.y) - truth.balls[i].position.y;
      measured.position.push_back(static_cast<double>(Number(sqrt(x * x + y * y))));
    }
  }
}

template <class Real, class Loop>
Measured run_event_method(physics::RootSolver solver, const RandomShot& shot,
                          const ReferenceSimulation& truth) {
  const physics::Scene<Real> scene = scene_in<Real>(shot);
  const physics::SimulationOptions options = sequential_with(solver);
  Measured measured;
  Loop loop(scene.table, scene.materials);
  measured.microseconds = least_microseconds(3, [&] {
    physics::Unwatched none;
    static_cast<void>(loop.run(scene.balls, scene.shot, options, none));
  });
  const physics::Simulation<Real> result = played<Real, Loop>(shot, solver);
  const Difference d = difference(result, truth);
  measured.same_sequence = d.sequence.same;
  measured.time_errors = d.sequence.time_errors;
  compare_balls(result.balls, truth, measured);
  return measured;
}

// What time stepping finds has no transitions: its events are held against the reference's others.
void compare_stepped(const SteppedShot& run, const ReferenceSimulation& truth, Measured& measured) {
  std::vector<EventKey> theirs;
  std::vector<double> times;
  for (const auto& event : truth.events) {
    if (event.type != physics::EventType::transition &&
        event.type != physics::EventType::cue_strike) {
      TimedEvent timed = timed_event(event);
      timed.key.place = -1;
      theirs.push_back(timed.key);
      times.push_back(timed.t);
    }
  }
  measured.same_sequence = run.events.size() == theirs.size();
  for (std::size_t i = 0; measured.same_sequence && i < theirs.size(); ++i) {
    const SteppedEvent& e = run.events[i];
    const bool pair = e.type == physics::EventType::ball_collision;
    const EventKey ours{e.type, pair ? std::min(e.first, e.second) : e.first,
                        pair ? std::max(e.first, e.second) : e.first, -1};
    measured.same_sequence = ours == theirs[i];
    if (measured.same_sequence) {
      measured.time_errors.push_back(std::abs(e.t - times[i]));
    }
  }
  compare_balls(run.balls, truth, measured);
}

std::string words(physics::RootSolver solver) {
  std::string name(physics::name(solver));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

template <class Real, class Loop = physics::EventLoop<Real>>
void add_event_method(std::vector<Method>& methods, const std::string& precision,
                      physics::RootSolver solver) {
  const std::string family = "event method, " + words(solver);
  const bool is_default = solver == physics::RootSolver::bracketed;
  methods.push_back({family, family + ", " + precision, is_default ? precision : std::string{},
                     [solver](const RandomShot& shot, const ReferenceSimulation& truth) {
                       return run_event_method<Real, Loop>(solver, shot, truth);
                     }});
}

template <class Step>
Method stepping_method(const std::string& family, const std::string& step, const Step& run) {
  return {family, family + ", " + step, family == name(Stepper::paper_discrete) ? step : "",
          [run](const RandomShot& shot, const ReferenceSimulation& truth) {
            const physics::Scene<double> scene = scene_in<double>(shot);
            Measured measured;
            SteppedShot result;
            measured.microseconds = processor_microseconds([&] { result = run(scene); });
            compare_stepped(result, truth, measured);
            return measured;
          }};
}

}  // namespace

std::vector<Method> event_methods() {
  std::vector<Method> methods;
  for (const auto solver :
       {physics::RootSolver::bracketed, physics::RootSolver::closed_form_polished,
        physics::RootSolver::closed_form}) {
    add_event_method<float>(methods, "float", solver);
    add_event_method<double>(methods, "double", solver);
    add_event_method<double, physics::AdaptiveLoop<double>>(methods, "as simulate", solver);
    add_event_method<double, physics::EventLoop<double, physics::Precise>>(
        methods, "double, balls wider", solver);
    add_event_method<long double>(methods, "long double", solver);
  }
  return methods;
}

std::vector<Method> stepping_methods() {
  std::vector<Method> methods;
  for (const Stepper stepper : {Stepper::paper_discrete, Stepper::semi_implicit_euler,
                                Stepper::verlet, Stepper::runge_kutta_4}) {
    for (const double step : {1e-2, 3e-3, 1e-3, 1e-4, 1e-5}) {
      methods.push_back(stepping_method(name(stepper), cell(step) + " s",
                                        [stepper, step](const physics::Scene<double>& scene) {
                                          return step_through(scene, stepper, step);
                                        }));
    }
  }
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    methods.push_back(stepping_method("Dormand-Prince", "tolerance " + cell(tolerance),
                                      [tolerance](const physics::Scene<double>& scene) {
                                        return integrate_adaptively(scene, tolerance);
                                      }));
  }
  return methods;
}

}  // namespace poolhall::bench
