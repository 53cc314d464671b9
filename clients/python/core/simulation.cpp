#include "clients/python/core/simulation.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clients/python/core/docs.hpp"
#include "clients/python/core/workers.hpp"
#include "protocol/events_json.hpp"
#include "protocol/scene_json.hpp"

namespace poolhall::python {
namespace {

using physics::Ball;
using physics::Event;

struct SceneArguments {
  py::object balls;
  py::object shot;
  py::object table;
};

PlayedScene read_scene(const SceneArguments& arguments, const OptionArguments& options) {
  const PlayTable& play = table_or_default(arguments.table);
  PlayedScene scene{arguments.table, {}, {}, read_options(options)};
  scene.balls = read_balls(arguments.balls, play.materials.ball_radius, "/balls");
  if (!arguments.shot.is_none()) {
    scene.shot = read_shot(arguments.shot, "/shot");
  }
  return scene;
}

[[noreturn]] void raise_scene_error(const physics::Error& error, const Balls& balls) {
  raise(scene_error(error, balls), name(error.fault));
}

std::unique_ptr<SimulationResult> played(PlayedScene scene) {
  auto done = physics::simulate(scene_of(scene), scene.options);
  if (!done) {
    raise_scene_error(done.error(), scene.balls);
  }
  return std::make_unique<SimulationResult>(std::move(scene), std::move(*done));
}

// One shot takes microseconds: less than handing the interpreter's lock over would cost.
std::unique_ptr<SimulationResult> simulate(py::object balls, py::object shot, py::object table,
                                           py::object t_max, std::uint32_t event_limit,
                                           std::string_view contact, std::string_view solver) {
  PlayedScene scene = read_scene({std::move(balls), std::move(shot), std::move(table)},
                                 {std::move(t_max), event_limit, contact, solver});
  return played(std::move(scene));
}

py::list simulate_many(const py::object& balls, const py::object& shots, const py::object& table,
                       unsigned threads, py::object t_max, std::uint32_t event_limit,
                       std::string_view contact, std::string_view solver) {
  const PlayTable& play = table_or_default(table);
  const Shots given = read_shots(shots);
  const auto scenes = read_many_balls(balls, play.materials.ball_radius, given.list.size());
  const auto options = read_options({std::move(t_max), event_limit, contact, solver});
  using Done = physics::Expected<physics::Simulation<double>>;
  std::vector<std::optional<Done>> results(given.list.size());
  const auto job = [&](std::size_t i, const Stop&) {
    const physics::Scene<double> scene{play.table, play.materials, scenes[i].set,
                                       physics::cue_shot(given.list[i])};
    results[i] = physics::simulate(scene, options);
  };
  for_each_index(results.size(), thread_count(threads), job);
  py::list out;
  for (std::size_t i = 0; i < results.size(); ++i) {
    Done& done = *results[i];
    if (!done) {
      protocol::Error error = scene_error(done.error(), scenes[i]);
      error.field = "/shots/" + std::to_string(i) +
                    (error.field.starts_with("/shot/") ? error.field.substr(5) : error.field);
      raise(error, name(done.error().fault));
    }
    out.append(std::make_unique<SimulationResult>(
        PlayedScene{table, scenes[i], given.list[i], options}, std::move(*done)));
  }
  return out;
}

EventRow event_row(const Event<double>& event) {
  EventRow row{};
  row.t = event.t;
  row.until = event.until.value_or(event.t);
  row.after[0] = row_of(event.after[0]);
  row.balls[0] = row.after[0].id;
  row.balls[1] = 255;
  row.after[1].id = 255;
  row.after[1].pocket = -1;
  if (event.ball_count == 2) {
    row.after[1] = row_of(event.after[1]);
    row.balls[1] = row.after[1].id;
  }
  row.count = event.count;
  row.type = static_cast<std::uint8_t>(event.type);
  row.rail = event.rail ? static_cast<std::int8_t>(*event.rail) : std::int8_t{-1};
  row.pocket = event.pocket ? static_cast<std::int8_t>(*event.pocket) : std::int8_t{-1};
  return row;
}

py::array_t<EventRow> event_rows(const SimulationResult& result) {
  const physics::EventLog<double>& log = result.done().events;
  py::array_t<EventRow> rows(static_cast<py::ssize_t>(log.size()));
  std::transform(log.begin(), log.end(), rows.mutable_data(),
                 [](const Event<double>& event) { return event_row(event); });
  return rows;
}

// (ball, pocket) in the order of the log.
py::list pocketed_in_log(const SimulationResult& result) {
  py::list out;
  for (const Event<double>& event : result.done().events) {
    if (event.type == physics::EventType::pocketed && event.pocket) {
      out.append(
          py::make_tuple(physics::number(event.after[0].id), std::string(name(*event.pocket))));
    }
  }
  return out;
}

std::optional<unsigned> first_contact(const SimulationResult& result) {
  for (const Event<double>& event : result.done().events) {
    if (event.type == physics::EventType::ball_collision && event.involves(physics::cue_ball)) {
      return physics::number(event.after[event.after[0].id == physics::cue_ball ? 1 : 0].id);
    }
  }
  return std::nullopt;
}

double instant(double t, const std::string& field) {
  if (!(t >= 0)) {
    refuse(field, "expected seconds since the strike, at least 0, got " + std::to_string(t));
  }
  return t;
}

py::array positions_at(const SimulationResult& result, const py::object& t) {
  py::object given;
  try {
    given = py::module_::import("numpy").attr("asarray")(t, "float64");
  } catch (const py::error_already_set&) {
    refuse("/t", "expected one instant or a list of instants, in seconds");
  }
  const auto times = py::cast<py::array_t<double, py::array::c_style>>(given);
  if (times.ndim() > 1) {
    refuse("/t", "expected one instant or a list of instants");
  }
  const auto rows = static_cast<py::ssize_t>(result.scene().balls.row_count);
  py::array_t<double> out({times.size(), rows, py::ssize_t{2}});
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const auto balls = result.balls_at(instant(times.data()[i], "/t"));
    const auto places = positions_of(result.scene().balls, balls.data());
    std::copy_n(places.data(), places.size(), out.mutable_data() + i * 2 * rows);
  }
  return times.ndim() == 0 ? py::array(out.attr("reshape")(rows, 2)) : py::array(out);
}

py::tuple reduced(const SimulationResult& result) {
  const PlayedScene& scene = result.scene();
  py::object shot = py::none();
  if (scene.shot) {
    shot = py::make_tuple(scene.shot->a, scene.shot->b, scene.shot->theta, scene.shot->phi,
                          scene.shot->v);
  }
  const physics::BallSet<double>& balls = scene.balls.set;
  const py::object again = py::module_::import("poolhall.pickles").attr("played_again");
  py::list rows;
  for (std::size_t i = 0; i < balls.count; ++i) {
    rows.append(scene.balls.rows[i]);
  }
  return py::make_tuple(
      again,
      py::make_tuple(rows_of({balls.begin(), balls.end()}), shot, scene.table, scene.options.t_max,
                     scene.options.event_limit, std::string(name(scene.options.contact)),
                     std::string(name(scene.options.solver)), rows, scene.balls.row_count));
}

// A pickled result is its scene, which gives the same bits again.
std::unique_ptr<SimulationResult> played_again(py::object balls, py::object shot, py::object table,
                                               py::object t_max, std::uint32_t event_limit,
                                               std::string_view contact, std::string_view solver,
                                               const std::vector<std::uint8_t>& rows,
                                               std::size_t row_count) {
  PlayedScene scene = read_scene({std::move(balls), std::move(shot), std::move(table)},
                                 {std::move(t_max), event_limit, contact, solver});
  if (rows.size() != scene.balls.set.count || row_count > physics::max_balls) {
    refuse("/rows", "expected one row a ball");
  }
  std::copy(rows.begin(), rows.end(), scene.balls.rows.begin());
  scene.balls.row_count = row_count;
  for (const std::uint8_t row : rows) {
    if (row >= row_count) {
      refuse("/rows", "expected rows below " + std::to_string(row_count));
    }
  }
  return played(std::move(scene));
}

py::tuple energy_of(const physics::EnergyAccount<double>& energy) {
  return py::make_tuple(energy.start, energy.end, energy.added_by_separation);
}

void bind_result(py::module_& module) {
  using Result = SimulationResult;
  py::class_<Result>(module, "Simulation", docs::simulation)
      .def_property_readonly(
          "duration", [](const Result& r) { return r.done().duration; },
          "s, time of the last event")
      .def_property_readonly("end", &Result::end, "s, the last instant that is known")
      .def_property_readonly(
          "ending", [](const Result& r) { return std::string(name(r.done().ending)); },
          "\"at_rest\", \"t_max\" or \"event_limit\"")
      .def_property_readonly(
          "energy", [](const Result& r) { return energy_of(r.done().energy); },
          "J: after the strike, at the end, added by the separation speed")
      .def_property_readonly(
          "positions",
          [](const Result& r) {
            return positions_of(r.scene().balls, r.done().balls.balls.data());
          },
          "(n, 2), m: where each ball of the argument is at the end; NaN: nowhere")
      .def_property_readonly(
          "balls",
          [](const Result& r) {
            const auto& balls = r.done().balls;
            return rows_of({balls.begin(), balls.end()});
          },
          "Records of poolhall.BALL at the end")
      .def_property_readonly("events", &event_rows, "The event log as records of poolhall.EVENT")
      .def_property_readonly("pocketed", &pocketed_in_log, "[(ball, pocket)] in their order")
      .def_property_readonly(
          "first_contact",
          [](const Result& r) -> py::object {
            const auto ball = first_contact(r);
            return ball ? py::object(py::int_(*ball)) : py::object(py::none());
          },
          "The ball that the cue ball touched first, or None")
      .def(
          "log",
          [](const Result& r) {
            return loads(protocol::encode_events(r.done().events, protocol::EventDetail::full));
          },
          "The event log as on the wire: a list of dicts")
      .def(
          "to_json", [](const Result& r) { return protocol::encode_simulation(r.done()); },
          "The line that `poolhall simulate` prints")
      .def("positions_at", &positions_at, py::arg("t"),
           "(n, 2) at t seconds after the strike, or (k, n, 2) at k instants; m, NaN: not there")
      .def(
          "balls_at",
          [](const Result& r, double t) { return rows_of(r.balls_at(instant(t, "/t"))); },
          py::arg("t"), "Records of poolhall.BALL at t seconds after the strike")
      .def("__reduce__", &reduced)
      .def("__repr__", [](const Result& r) {
        return "<poolhall.Simulation " + std::to_string(r.done().events.size()) + " events, " +
               std::to_string(r.done().duration) + " s, " + std::string(name(r.done().ending)) +
               ">";
      });
}

}  // namespace

physics::Scene<double> scene_of(const PlayedScene& scene) {
  const PlayTable& play = table_or_default(scene.table);
  physics::Scene<double> out{play.table, play.materials, scene.balls.set, {}};
  if (scene.shot) {
    out.shot = physics::cue_shot(*scene.shot);
  }
  return out;
}

py::array_t<double> positions_of(const Balls& balls, const Ball<double>* begin) {
  const auto rows = static_cast<py::ssize_t>(balls.row_count);
  py::array_t<double> out({rows, py::ssize_t{2}});
  double* data = out.mutable_data();
  std::fill_n(data, 2 * rows, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < balls.set.count; ++i) {
    if (!begin[i].pocket) {
      const auto row = static_cast<std::size_t>(balls.rows[i]);
      data[2 * row] = begin[i].position.x;
      data[2 * row + 1] = begin[i].position.y;
    }
  }
  return out;
}

py::array_t<BallRow> rows_of(const std::vector<Ball<double>>& balls) {
  py::array_t<BallRow> out(static_cast<py::ssize_t>(balls.size()));
  std::transform(balls.begin(), balls.end(), out.mutable_data(),
                 [](const Ball<double>& ball) { return row_of(ball); });
  return out;
}

void bind_simulation(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(BallRow, id, state, pocket, x, y, vx, vy, wx, wy, wz);
  PYBIND11_NUMPY_DTYPE(EventRow, t, until, type, balls, rail, pocket, count, after);
  module.attr("BALL") = py::dtype::of<BallRow>();
  module.attr("EVENT") = py::dtype::of<EventRow>();
  bind_result(module);
  constexpr std::uint32_t event_limit = physics::SimulationOptions{}.event_limit;
  module.def("simulate", &simulate, py::arg("balls"), py::arg("shot") = py::none(),
             py::arg("table") = py::none(), py::kw_only(), py::arg("t_max") = py::none(),
             py::arg("event_limit") = event_limit, py::arg("contact") = "cluster",
             py::arg("solver") = "bracketed", docs::simulate);
  module.def("simulate_many", &simulate_many, py::arg("balls"), py::arg("shots"),
             py::arg("table") = py::none(), py::kw_only(), py::arg("threads") = 1,
             py::arg("t_max") = py::none(), py::arg("event_limit") = event_limit,
             py::arg("contact") = "cluster", py::arg("solver") = "bracketed", docs::simulate_many);
  module.def("_played_again", &played_again);
}

}  // namespace poolhall::python
