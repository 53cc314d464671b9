#include "clients/python/core/arguments.hpp"

#include <cmath>

#include "physics/math.hpp"
#include "physics/motion.hpp"
#include "physics/noise.hpp"
#include "protocol/state_json.hpp"

namespace poolhall::python {
namespace {

using physics::ShotParameters;
using DenseNumbers = py::array_t<double, py::array::c_style>;

constexpr std::array<const char*, 5> shot_keys{"a", "b", "theta", "phi", "v"};

std::string type_of(py::handle value) {
  return Py_TYPE(value.ptr())->tp_name;
}

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape"));
}

bool is_record_array(const py::array& array) {
  return !array.dtype().attr("names").is_none();
}

// Whole and floating numbers of any size as doubles; whatever else numpy takes for an array is
// refused, so that a mistake does not become a number.
DenseNumbers numbers(py::handle argument, const std::string& field) {
  if (DenseNumbers::check_(argument)) {
    return py::reinterpret_borrow<DenseNumbers>(argument);
  }
  py::array array;
  try {
    array = py::module_::import("numpy").attr("asarray")(argument);
  } catch (const py::error_already_set&) {
    refuse(field, "expected an array of numbers, got " + type_of(argument));
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    refuse(field, "expected real numbers, got an array of " +
                      std::string(py::str(py::handle(array.dtype()))));
  }
  return py::cast<DenseNumbers>(array.attr("astype")("float64", "C"));
}

double number(py::handle value, const std::string& field) {
  if (PyFloat_CheckExact(value.ptr())) {
    return PyFloat_AS_DOUBLE(value.ptr());
  }
  if (PyBool_Check(value.ptr()) == 0) {
    const double result = PyFloat_AsDouble(value.ptr());
    if (result != -1 || PyErr_Occurred() == nullptr) {
      return result;
    }
    PyErr_Clear();
  }
  refuse(field, "expected a number, got " + type_of(value));
}

std::optional<std::string> text(py::handle value) {
  return py::isinstance<py::str>(value) ? std::optional(py::cast<std::string>(value))
                                        : std::nullopt;
}

bool is_mapping(py::handle value) {
  return PyDict_Check(value.ptr()) != 0;
}

void only_keys(py::handle mapping, std::initializer_list<const char*> keys,
               const std::string& field) {
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(mapping)) {
    bool is_known = false;
    for (const char* known : keys) {
      is_known = is_known || py::str(known).equal(key);
    }
    if (!is_known) {
      refuse(field, "unknown key " + std::string(py::repr(key)));
    }
  }
}

py::object member(py::handle mapping, const char* key, const std::string& field) {
  PyObject* found = PyDict_GetItemString(mapping.ptr(), key);
  if (found == nullptr) {
    refuse(field + "/" + key, "is missing");
  }
  return py::reinterpret_borrow<py::object>(found);
}

// Five numbers of a shot or of a noise level.
std::array<double, 5> five(py::handle argument, const std::string& field) {
  std::array<double, 5> out{};
  if (is_mapping(argument)) {
    only_keys(argument, {"a", "b", "theta", "phi", "v"}, field);
    for (std::size_t i = 0; i < 5; ++i) {
      out[i] = number(member(argument, shot_keys[i], field), field + "/" + shot_keys[i]);
    }
    return out;
  }
  if (PyTuple_Check(argument.ptr()) != 0 || PyList_Check(argument.ptr()) != 0) {
    const Py_ssize_t size = PySequence_Fast_GET_SIZE(argument.ptr());
    if (size != 5) {
      refuse(field, "expected the five numbers a, b, theta, phi, v, got " + std::to_string(size));
    }
    for (std::size_t i = 0; i < 5; ++i) {
      PyObject* item = PySequence_Fast_GET_ITEM(argument.ptr(), static_cast<Py_ssize_t>(i));
      out[i] = PyFloat_CheckExact(item) ? PyFloat_AS_DOUBLE(item)
                                        : number(item, field + "/" + shot_keys[i]);
    }
    return out;
  }
  if (!py::isinstance<py::array>(argument)) {
    refuse(field,
           "expected a, b, theta, phi, v (five numbers or a dict), got " + type_of(argument));
  }
  const DenseNumbers array = numbers(argument, field);
  if (array.ndim() != 1 || array.shape(0) != 5) {
    refuse(field, "expected shape (5,), got " + shape_of(array));
  }
  std::copy_n(array.data(), 5, out.begin());
  return out;
}

physics::Ball<double> ball_of(const BallRow& row, const std::string& field) {
  const auto member_field = [&](const char* name) { return field + "/" + name; };
  if (row.state > static_cast<unsigned>(physics::MotionState::pocketed)) {
    refuse(member_field("state"), "expected 0 to 4, got " + std::to_string(row.state));
  }
  if (row.pocket < -1 || row.pocket >= static_cast<int>(physics::pocket_count)) {
    refuse(member_field("pocket"), "expected -1 to 5, got " + std::to_string(row.pocket));
  }
  physics::Ball<double> ball;
  ball.id = physics::BallId{row.id};
  ball.state = static_cast<physics::MotionState>(row.state);
  ball.position = {row.x, row.y};
  ball.velocity = {row.vx, row.vy};
  ball.angular_velocity = {row.wx, row.wy, row.wz};
  if (row.pocket >= 0) {
    ball.pocket = static_cast<physics::PocketId>(row.pocket);
  }
  return ball;
}

void check_count(py::ssize_t count, const std::string& field) {
  if (count < 0 || count > static_cast<py::ssize_t>(physics::max_balls)) {
    refuse(field, "expected at most 16 balls, got " + std::to_string(count));
  }
}

Balls balls_of_records(const py::array& array, const std::string& field) {
  if (!array.dtype().equal(py::dtype::of<BallRow>())) {
    refuse(field, "expected records of poolhall.BALL, got " +
                      std::string(py::str(py::handle(array.dtype()))));
  }
  if (array.ndim() != 1) {
    refuse(field, "expected shape (n,), got " + shape_of(array));
  }
  check_count(array.shape(0), field);
  const auto dense = py::array_t<BallRow, py::array::c_style | py::array::forcecast>(array);
  Balls balls;
  balls.row_count = static_cast<std::size_t>(dense.shape(0));
  for (std::size_t i = 0; i < balls.row_count; ++i) {
    balls.rows[i] = static_cast<std::uint8_t>(i);
    balls.set[i] = ball_of(dense.data()[i], field + "/" + std::to_string(i));
  }
  balls.set.count = balls.row_count;
  return balls;
}

Balls balls_of_rows(const double* data, std::size_t count, std::size_t columns, double radius) {
  Balls balls;
  balls.row_count = count;
  for (std::size_t i = 0; i < count; ++i) {
    const double* row = data + i * columns;
    if (std::isnan(row[0]) && std::isnan(row[1])) {
      continue;
    }
    physics::Ball<double>& ball = balls.set[balls.set.count];
    balls.rows[balls.set.count++] = static_cast<std::uint8_t>(i);
    ball.id = physics::BallId{static_cast<std::uint8_t>(i)};
    ball.position = {row[0], row[1]};
    if (columns == 7) {
      ball.velocity = {row[2], row[3]};
      ball.angular_velocity = {row[4], row[5], row[6]};
      ball.state = physics::motion_state_of(ball.velocity, ball.angular_velocity, radius);
    }
  }
  return balls;
}

void check_columns(const DenseNumbers& array, py::ssize_t dimensions, const std::string& field) {
  const py::ssize_t last = array.ndim() == 0 ? 0 : array.shape(array.ndim() - 1);
  if (array.ndim() != dimensions || (last != 2 && last != 7)) {
    refuse(field, "expected " + std::string(dimensions == 3 ? "(scenes, n, 2)" : "(n, 2)") +
                      " for x, y or 7 columns for x, y, vx, vy, wx, wy, wz, got shape " +
                      shape_of(array));
  }
  check_count(array.shape(dimensions - 2), field);
}

}  // namespace

py::object error_object(const protocol::Error& error, std::string_view fault) {
  const py::object type = py::module_::import("poolhall.errors").attr("Error");
  return type(py::str(std::string(name(error.code))), py::str(error.reason),
              py::arg("field") = error.field,
              py::arg("fault") =
                  fault.empty() ? py::object(py::none()) : py::object(py::str(std::string(fault))));
}

void raise(const protocol::Error& error, std::string_view fault) {
  const py::object object = error_object(error, fault);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(object.ptr())), object.ptr());
  throw py::error_already_set();
}

void refuse(std::string_view field, std::string reason) {
  raise({protocol::ErrorCode::invalid_params, std::string(field), std::move(reason), {}, false});
}

BallRow row_of(const physics::Ball<double>& ball) {
  return {ball.position.x,
          ball.position.y,
          ball.velocity.x,
          ball.velocity.y,
          ball.angular_velocity.x,
          ball.angular_velocity.y,
          ball.angular_velocity.z,
          static_cast<std::uint8_t>(physics::number(ball.id)),
          static_cast<std::uint8_t>(ball.state),
          ball.pocket ? static_cast<std::int8_t>(*ball.pocket) : std::int8_t{-1},
          0};
}

Balls read_balls(py::handle argument, double ball_radius, const std::string& field) {
  if (py::isinstance<py::array>(argument)) {
    const auto array = py::reinterpret_borrow<py::array>(argument);
    if (!DenseNumbers::check_(argument) && is_record_array(array)) {
      return balls_of_records(array, field);
    }
  }
  const DenseNumbers array = numbers(argument, field);
  check_columns(array, 2, field);
  return balls_of_rows(array.data(), static_cast<std::size_t>(array.shape(0)),
                       static_cast<std::size_t>(array.shape(1)), ball_radius);
}

std::vector<Balls> read_many_balls(py::handle argument, double ball_radius, std::size_t count) {
  const bool is_array = py::isinstance<py::array>(argument);
  const bool is_stack = is_array && !is_record_array(py::reinterpret_borrow<py::array>(argument)) &&
                        py::reinterpret_borrow<py::array>(argument).ndim() == 3;
  if (!is_stack) {
    return std::vector<Balls>(count, read_balls(argument, ball_radius, "/balls"));
  }
  const DenseNumbers array = numbers(argument, "/balls");
  check_columns(array, 3, "/balls");
  if (static_cast<std::size_t>(array.shape(0)) != count) {
    refuse("/balls", "expected as many scenes as shots, " + std::to_string(count) + ", got " +
                         std::to_string(array.shape(0)));
  }
  const auto rows = static_cast<std::size_t>(array.shape(1));
  const auto columns = static_cast<std::size_t>(array.shape(2));
  std::vector<Balls> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(balls_of_rows(array.data() + i * rows * columns, rows, columns, ball_radius));
  }
  return all;
}

ShotParameters<double> read_shot(py::handle argument, const std::string& field) {
  const std::array<double, 5> given = five(argument, field);
  return {given[0], given[1], given[2], given[3], given[4]};
}

Shots read_shots(py::handle argument) {
  Shots shots;
  const bool is_sequence = PyTuple_Check(argument.ptr()) || PyList_Check(argument.ptr());
  if (is_sequence) {
    const auto list = py::reinterpret_borrow<py::sequence>(argument);
    shots.is_single = list.size() == 5 && PyNumber_Check(py::object(list[0]).ptr()) &&
                      !py::isinstance<py::array>(list[0]);
    if (!shots.is_single) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        shots.list.push_back(read_shot(list[i], "/shots/" + std::to_string(i)));
      }
      return shots;
    }
  }
  const bool is_table = py::isinstance<py::array>(argument) &&
                        py::reinterpret_borrow<py::array>(argument).ndim() != 1;
  if (!is_table) {
    shots.is_single = true;
    shots.list.push_back(read_shot(argument, "/shot"));
    return shots;
  }
  const DenseNumbers array = numbers(argument, "/shots");
  if (array.ndim() != 2 || array.shape(1) != 5) {
    refuse("/shots", "expected shape (shots, 5) for a, b, theta, phi, v, got " + shape_of(array));
  }
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const double* row = array.data() + 5 * i;
    shots.list.push_back({row[0], row[1], row[2], row[3], row[4]});
  }
  return shots;
}

protocol::NoiseParams read_noise(py::handle argument) {
  if (argument.is_none()) {
    return {};
  }
  if (const auto preset = text(argument)) {
    const auto noise = protocol::noise_preset(*preset);
    if (!noise) {
      refuse("/noise",
             "expected \"none\", \"low\", \"olympiad\", \"high\" or five standard "
             "deviations, got \"" +
                 *preset + "\"");
    }
    return *noise;
  }
  const std::array<double, 5> given = five(argument, "/noise");
  for (std::size_t i = 0; i < 5; ++i) {
    if (!(given[i] >= 0 && given[i] <= 1e3)) {
      refuse(std::string("/noise/") + shot_keys[i],
             "expected a standard deviation from 0 to 1000, got " + std::to_string(given[i]));
    }
  }
  return {given[0], given[1], given[2], given[3], given[4]};
}

physics::NoiseLevel in_si(const protocol::NoiseParams& noise) {
  const double degree = physics::pi<double>() / 180;
  return {noise.a / 1000, noise.b / 1000, noise.theta * degree, noise.phi * degree, noise.v};
}

std::optional<physics::Vec2<double>> read_place(py::handle argument, const std::string& field) {
  if (argument.is_none()) {
    return std::nullopt;
  }
  if (is_mapping(argument)) {
    only_keys(argument, {"x", "y"}, field);
    return physics::Vec2<double>{number(member(argument, "x", field), field + "/x"),
                                 number(member(argument, "y", field), field + "/y")};
  }
  const DenseNumbers array = numbers(argument, field);
  if (array.ndim() != 1 || array.shape(0) != 2) {
    refuse(field, "expected x, y, got shape " + shape_of(array));
  }
  return physics::Vec2<double>{array.data()[0], array.data()[1]};
}

rules::Call read_call(py::handle argument, const std::string& field) {
  py::object call = py::reinterpret_borrow<py::object>(argument);
  if (py::isinstance<py::tuple>(call) || py::isinstance<py::list>(call)) {
    if (py::len(call) != 2) {
      refuse(field, "expected (ball, pocket), got " + std::string(py::repr(call)));
    }
    py::dict named;
    named["ball"] = call[py::int_(0)];
    named["pocket"] = call[py::int_(1)];
    call = named;
  }
  if (is_mapping(call)) {
    // NumPy's whole numbers are none of JSON's.
    const py::object ball = member(call, "ball", field);
    py::dict plain = call.attr("copy")();
    if (PyIndex_Check(ball.ptr()) != 0 && PyBool_Check(ball.ptr()) == 0) {
      plain["ball"] = py::int_(ball);
    }
    call = plain;
  }
  const auto decoded = protocol::decode_call(dumps(call, field));
  if (!decoded) {
    refuse(field + decoded.error().field, decoded.error().reason);
  }
  return *decoded;
}

physics::SimulationOptions read_options(const OptionArguments& arguments) {
  physics::SimulationOptions options;
  if (!arguments.t_max.is_none()) {
    options.t_max = number(arguments.t_max, "/t_max");
  }
  if (arguments.event_limit == 0) {
    refuse("/event_limit", "expected at least 1, got 0");
  }
  options.event_limit = arguments.event_limit;
  if (arguments.contact != "cluster") {
    const auto contact = physics::contact_model(arguments.contact);
    if (!contact) {
      refuse("/contact", "expected \"cluster\", \"sequential\" or \"hertz\", got \"" +
                             std::string(arguments.contact) + "\"");
    }
    options.contact = *contact;
  }
  if (arguments.solver != "bracketed") {
    const auto solver = physics::root_solver(arguments.solver);
    if (!solver) {
      refuse("/solver",
             "expected \"bracketed\", \"closed_form\" or \"closed_form_polished\", got \"" +
                 std::string(arguments.solver) + "\"");
    }
    options.solver = *solver;
  }
  return options;
}

protocol::Error scene_error(const physics::Error& error, const Balls& balls) {
  constexpr std::string_view of_balls = "/balls/";
  protocol::Error out{protocol::ErrorCode::invalid_params, error.field, error.reason, {}, false};
  if (error.field.starts_with("/shot")) {
    out.code = protocol::ErrorCode::bad_shot;
  } else if (error.field.starts_with(of_balls)) {
    std::size_t digits = 0;
    const std::size_t index = std::stoul(error.field.substr(of_balls.size()), &digits);
    out.field = std::string(of_balls) + std::to_string(balls.rows[index]) +
                error.field.substr(of_balls.size() + digits);
  }
  return out;
}

py::object loads(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

std::string dumps(py::handle value, std::string_view field) {
  try {
    return py::cast<std::string>(
        py::module_::import("json").attr("dumps")(value, py::arg("allow_nan") = false));
  } catch (const py::error_already_set& error) {
    if (error.matches(PyExc_ValueError) || error.matches(PyExc_TypeError)) {
      refuse(field, "cannot be read: " + std::string(py::str(error.value())));
    }
    throw;
  }
}

}  // namespace poolhall::python
