// Scene files (physics.md 10): reading what `poolhall simulate` is given, writing what it prints.
//
//   Expected<SceneFile> file = decode_scene(text);
//   physics::Expected<physics::Simulation<double>> done =
//       physics::simulate(scene_of<double>(*file), file->options);
//   std::string out = encode_simulation(*done);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "physics/simulator.hpp"
#include "protocol/errors.hpp"
#include "protocol/units.hpp"

namespace poolhall::protocol {

enum class Precision : std::uint8_t { double_precision, long_double, float128, mp100 };
// "double", "long_double", "float128", "mp100".
[[nodiscard]] std::string_view name(Precision precision);

struct SceneFile {
  physics::Table table;
  physics::Materials materials;
  physics::BallSet<double> balls{};
  std::optional<ShotParams> shot{};  // in the wire's units, converted in the precision asked for
  physics::SimulationOptions options;
  Precision precision = Precision::double_precision;
};

// Unknown keys are errors that name the key. Checks the form; what makes a scene impossible is
// physics::check_scene's answer.
[[nodiscard]] Expected<SceneFile> decode_scene(std::string_view text);

// The scene in SI, in double.
[[nodiscard]] physics::Scene<double> scene_of(const SceneFile& file);

}  // namespace poolhall::protocol
