#include "tests/bench/methods.hpp"

#include <algorithm>
#include <cmath>

#include "physics/adaptive_loop.hpp"
#include "physics/watch.hpp"
#include "protocol/scene_json.hpp"
#include "tests/bench/dormand_prince.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/time_stepping.hpp"
#include "tests/bench/timing.hpp"

namespace poolhall::bench {

namespace {

using physics::reference::Number;
using physics::reference::ReferenceSimulation;
using test_support::RandomShot;

template <class Real>
physics::Scene<Real> scene_in(const RandomShot& shot) {
  protocol::SceneFile file;
  file.table = shot.table;
  file.materials = shot.materials;
  file.balls = shot.balls;
  file.shot = shot.shot;
  return protocol::scene_of<Real>(file);
}

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
  physics::SimulationOptions options;
  options.contact = physics::ContactModel::sequential;
  options.solver = solver;
  Measured measured;
  Loop loop(scene.table, scene.materials);
  measured.microseconds = least_microseconds(3, [&] {
    physics::Unwatched none;
    static_cast<void>(loop.run(scene.balls, scene.shot, options, none));
  });
  physics::Recorder<Real> recorder;
  static_cast<void>(loop.run(scene.balls, scene.shot, options, recorder));
  physics::Simulation<Real> result;
  result.events = recorder.take();
  result.balls = loop.balls();
  const Difference d = difference(result, truth);
  measured.same_sequence = d.sequence.same;
  measured.time_error = d.sequence.time_error;
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
    measured.time_error = std::max(measured.time_error, std::abs(e.t - times[i]));
  }
  compare_balls(run.balls, truth, measured);
}

template <class Real, class Loop = physics::EventLoop<Real>>
void add_event_method(std::vector<Method>& methods, const std::string& precision,
                      physics::RootSolver solver) {
  const std::string family = "event method, " + std::string(physics::name(solver));
  methods.push_back({family, family + ", " + precision,
                     [solver](const RandomShot& shot, const ReferenceSimulation& truth) {
                       return run_event_method<Real, Loop>(solver, shot, truth);
                     }});
}

template <class Step>
Method stepping_method(const std::string& family, const std::string& step, const Step& run) {
  return {family, family + ", " + step,
          [run](const RandomShot& shot, const ReferenceSimulation& truth) {
            const physics::Scene<double> scene = scene_in<double>(shot);
            Measured measured;
            SteppedShot result;
            measured.microseconds = least_microseconds(3, [&] { result = run(scene); });
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
    add_event_method<double, physics::AdaptiveLoop<double>>(methods, "as simulate", solver);
    add_event_method<double, physics::EventLoop<double, physics::Precise>>(
        methods, "double, balls kept wider", solver);
    add_event_method<double>(methods, "double", solver);
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

physics::reference::ReferenceScene reference_scene(const RandomShot& shot) {
  return {shot.table, shot.materials, shot.balls,
          physics::reference::ReferenceShot{shot.shot.a, shot.shot.b, shot.shot.theta,
                                            shot.shot.phi, shot.shot.v}};
}

}  // namespace poolhall::bench
