// What Python hands over, read strictly: shapes, kinds of numbers, names. Whatever is wrong is
// thrown as poolhall.Error with the wire's code and a field that names the argument.
//
//   const Balls balls = read_balls(argument, radius, "/balls");
//   const physics::ShotParameters<double> shot = read_shot(argument, "/shot");
//
// Everything here needs the interpreter's lock.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "physics/simulator.hpp"
#include "protocol/errors.hpp"
#include "protocol/units.hpp"
#include "rules/referee.hpp"

namespace poolhall::python {

namespace py = pybind11;

// poolhall.Error as a value, to be raised later or handed back.
[[nodiscard]] py::object error_object(const protocol::Error& error, std::string_view fault = {});
[[noreturn]] void raise(const protocol::Error& error, std::string_view fault = {});
// invalid_params: `field` is a JSON Pointer that begins with the argument's name.
[[noreturn]] void refuse(std::string_view field, std::string reason);

// A ball as a NumPy record (poolhall.BALL).
struct BallRow {
  double x;   // m
  double y;   // m
  double vx;  // m/s
  double vy;  // m/s
  double wx;  // rad/s
  double wy;  // rad/s
  double wz;  // rad/s
  std::uint8_t id;
  std::uint8_t state;   // index into poolhall.STATES
  std::int8_t pocket;   // index into poolhall.POCKETS, -1: none
  std::uint8_t unused;  // fills the record up
};
[[nodiscard]] BallRow row_of(const physics::Ball<double>& ball);

// The balls of an argument, and where they stood in it.
struct Balls {
  physics::BallSet<double> set{};
  std::array<std::uint8_t, physics::max_balls> rows{};  // of the argument, by index into `set`
  std::size_t row_count = 0;
};

// (n, 2) x, y or (n, 7) x, y, vx, vy, wx, wy, wz: row i is ball i, and a row whose x and y are NaN
// is a ball that is not on the table. Or an array of poolhall.BALL.
[[nodiscard]] Balls read_balls(py::handle argument, double ball_radius, const std::string& field);
// The same for each of `count` scenes: one for all of them, or one more dimension in front.
[[nodiscard]] std::vector<Balls> read_many_balls(py::handle argument, double ball_radius,
                                                 std::size_t count);

// (a, b, theta, phi, v) in mm, degrees and m/s: a sequence, an array of five, or a mapping.
[[nodiscard]] physics::ShotParameters<double> read_shot(py::handle argument,
                                                        const std::string& field);
struct Shots {
  std::vector<physics::ShotParameters<double>> list;
  bool is_single = false;  // one shot was given, not a list of one
};
[[nodiscard]] Shots read_shots(py::handle argument);

// None is no noise; a preset's name, five numbers, or a mapping.
[[nodiscard]] protocol::NoiseParams read_noise(py::handle argument);
[[nodiscard]] physics::NoiseLevel in_si(const protocol::NoiseParams& noise);

// None, (x, y) or {"x": m, "y": m}.
[[nodiscard]] std::optional<physics::Vec2<double>> read_place(py::handle argument,
                                                              const std::string& field);
// None, "safety", "push_out", (ball, pocket) or {"ball": n, "pocket": name}.
[[nodiscard]] rules::Call read_call(py::handle argument, const std::string& field);

struct OptionArguments {
  py::object t_max;
  std::uint32_t event_limit = 1'000'000;
  std::string_view contact;
  std::string_view solver;
};
[[nodiscard]] physics::SimulationOptions read_options(const OptionArguments& arguments);

// A scene that the simulator refused: balls by the rows of the argument.
[[nodiscard]] protocol::Error scene_error(const physics::Error& error, const Balls& balls);

// Text to Python values, and back.
[[nodiscard]] py::object loads(const std::string& json);
[[nodiscard]] std::string dumps(py::handle value, std::string_view field);

}  // namespace poolhall::python
