#include <algorithm>
#include <cmath>

#include "protocol/json_node.hpp"
#include "protocol/scene_json.hpp"
#include "tests/fuzz/protocol/demand.hpp"
#include "tests/fuzz/simulate/shot_demands.hpp"
#include "tests/fuzz/simulate/simulate_targets.hpp"

namespace poolhall::fuzz {

void simulate(std::string_view input) {
  auto file = protocol::decode_scene(input);
  if (!file) {
    demand(!file.error().reason.empty(), "an error has a reason");
    return;
  }
  // Long shots only take time, elastic springs most of all.
  const bool springs = file->options.contact == physics::ContactModel::hertz;
  file->options.event_limit = std::min(file->options.event_limit, springs ? 8U : 100U);
  const physics::Scene<double> scene = protocol::scene_of(*file);
  const auto result = physics::simulate(scene, file->options);
  if (!result) {
    demand(!protocol::scene_error(result.error()).reason.empty(), "a refusal has a reason");
    return;
  }
  demand_sound(scene, *result);
  const auto answer =
      protocol::parse_json(protocol::encode_simulation(*result), protocol::document_bounds);
  demand(answer.has_value(), "the answer is JSON");
}

}  // namespace poolhall::fuzz
