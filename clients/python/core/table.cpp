#include "clients/python/core/table.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <functional>
#include <memory>

#include "clients/python/core/docs.hpp"
#include "physics/noise_presets.hpp"
#include "physics/version.hpp"
#include "protocol/table_json.hpp"
#include "rules/version.hpp"

namespace poolhall::python {
namespace {

// A JSON document of what Python has: a preset's name or a mapping.
template <class Decode>
auto decoded(py::handle argument, const char* field, const Decode& decode) {
  if (!py::isinstance<py::str>(argument) && !PyDict_Check(argument.ptr())) {
    refuse(field, "expected a preset's name or a dict, got " +
                      std::string(Py_TYPE(argument.ptr())->tp_name));
  }
  auto value = decode(dumps(argument, field));
  if (!value) {
    refuse(field + value.error().field, value.error().reason);
  }
  return *value;
}

std::unique_ptr<PlayTable> make_table(const py::object& table, const py::object& physics) {
  PlayTable made{decoded(table, "/table", protocol::decode_table),
                 decoded(physics, "/physics", protocol::decode_materials)};
  if (const auto fine = physics::check_materials(made.materials); !fine) {
    refuse("/physics" + fine.error().field, fine.error().reason);
  }
  if (const auto fine = physics::check_table(made.table, made.materials.ball_radius); !fine) {
    refuse("/table" + fine.error().field, fine.error().reason);
  }
  return std::make_unique<PlayTable>(std::move(made));
}

// The middles of the mouths, between the noses.
py::dict pocket_places(const PlayTable& play) {
  py::dict places;
  double leg = 0;  // along each rail from the corner to the middle of the mouth
  if (const auto* mouths = std::get_if<physics::MouthLines>(&play.table.pockets)) {
    leg = mouths->corner / std::sqrt(8.0);
  } else if (const auto* jaws = std::get_if<physics::Jaws>(&play.table.pockets)) {
    leg = jaws->corner.width / std::sqrt(8.0);
  } else {
    return places;
  }
  for (std::size_t i = 0; i < physics::pocket_count; ++i) {
    const auto pocket = static_cast<physics::PocketId>(i);
    const bool is_side = i / 2 == 1;
    const double inwards = is_side ? 0 : leg;
    const double x = i % 2 == 0 ? inwards : play.table.width - inwards;
    const double y = is_side ? play.table.length / 2 : i < 2 ? leg : play.table.length - leg;
    places[py::str(std::string(name(pocket)))] = py::make_tuple(x, y);
  }
  return places;
}

py::tuple words(std::size_t count, const std::function<std::string_view(std::size_t)>& word) {
  py::tuple out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = py::str(std::string(word(i)));
  }
  return out;
}

template <class Enum>
py::tuple names(std::size_t count) {
  return words(count, [](std::size_t i) { return name(static_cast<Enum>(i)); });
}

void add_names(py::module_& module) {
  module.attr("STATES") = names<physics::MotionState>(5);
  module.attr("POCKETS") = names<physics::PocketId>(physics::pocket_count);
  module.attr("RAILS") = names<physics::RailId>(physics::rail_count);
  module.attr("EVENT_TYPES") = names<physics::EventType>(6);
  module.attr("physics_version") = std::string(physics::version);
  module.attr("rules_version") = std::string(rules::version);
  module.attr("__version__") = POOLHALL_VERSION;

  py::dict presets;
  presets["tables"] = physics::preset_table_names();
  presets["physics"] = physics::preset_material_names();
  py::list noises;
  for (const physics::NoisePreset& noise : physics::noise_presets()) {
    noises.append(noise.name);
  }
  presets["noise"] = noises;
  module.attr("presets") = presets;

  py::list errors;
  for (const protocol::ErrorEntry& entry : protocol::error_registry()) {
    errors.append(py::make_tuple(static_cast<std::int32_t>(entry.code), std::string(entry.name),
                                 entry.retryable, std::string(entry.meaning)));
  }
  module.attr("error_registry") = py::tuple(errors);
}

}  // namespace

const PlayTable& table_or_default(py::handle argument) {
  static const PlayTable olympiad{*physics::preset_table("olympiad"),
                                  *physics::preset_materials("olympiad")};
  if (argument.is_none()) {
    return olympiad;
  }
  if (!py::isinstance<PlayTable>(argument)) {
    refuse("/table", "expected a poolhall.Table or None, got " +
                         std::string(Py_TYPE(argument.ptr())->tp_name));
  }
  return py::cast<const PlayTable&>(argument);
}

void bind_table(py::module_& module) {
  add_names(module);
  const auto table_dict = [](const PlayTable& t) { return loads(protocol::encode_table(t.table)); };
  const auto physics_dict = [](const PlayTable& t) {
    return loads(protocol::encode_materials(t.materials));
  };
  py::class_<PlayTable>(module, "Table", docs::table)
      .def(py::init(&make_table), py::arg("table") = "olympiad", py::arg("physics") = "olympiad")
      .def_property_readonly("table", table_dict, "The geometry as a dict, SI.")
      .def_property_readonly("physics", physics_dict, "The materials as a dict, SI.")
      .def_property_readonly(
          "width", [](const PlayTable& t) { return t.table.width; }, "m, between the noses")
      .def_property_readonly(
          "length", [](const PlayTable& t) { return t.table.length; }, "m, between the noses")
      .def_property_readonly(
          "head_string", [](const PlayTable& t) { return t.table.head_string; },
          "m, y of the head string")
      .def_property_readonly(
          "foot_spot",
          [](const PlayTable& t) {
            return py::make_tuple(t.table.foot_spot_x, t.table.foot_spot_y);
          },
          "(x, y), m")
      .def_property_readonly("pockets", &pocket_places, docs::table_pockets)
      .def_property_readonly(
          "ball_radius", [](const PlayTable& t) { return t.materials.ball_radius; }, "m")
      .def_property_readonly(
          "ball_mass", [](const PlayTable& t) { return t.materials.ball_mass; }, "kg")
      .def_property_readonly(
          "max_cue_speed", [](const PlayTable& t) { return t.materials.max_cue_speed; }, "m/s")
      .def_property_readonly(
          "miscue_limit", [](const PlayTable& t) { return t.materials.miscue_limit; },
          "how far from the centre a cue may pass, in ball radii")
      .def("__eq__",
           [](const PlayTable& t, const py::object& other) {
             return py::isinstance<PlayTable>(other) &&
                    protocol::encode_table(t.table) ==
                        protocol::encode_table(py::cast<const PlayTable&>(other).table) &&
                    protocol::encode_materials(t.materials) ==
                        protocol::encode_materials(py::cast<const PlayTable&>(other).materials);
           })
      .def("__hash__",
           [](const PlayTable& t) { return py::hash(py::float_(t.table.width + t.table.length)); })
      .def("__reduce__",
           [table_dict, physics_dict](const PlayTable& t) {
             return py::make_tuple(py::type::of<PlayTable>(),
                                   py::make_tuple(table_dict(t), physics_dict(t)));
           })
      .def("__repr__", [](const PlayTable& t) {
        const auto shown = [](const std::string& name) { return name.empty() ? "own" : name; };
        return "<poolhall.Table " + shown(t.table.name) + ", physics " + shown(t.materials.name) +
               ">";
      });
}

}  // namespace poolhall::python
