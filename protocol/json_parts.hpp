// The parts that several messages and files share, each written and read in one place. For the
// sources of this room; other rooms use the typed headers.
//
//   write_ball_places(out, state.balls);
//   shot.params = read_shot_params(params.at("params"));
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "protocol/json_node.hpp"
#include "protocol/json_writer.hpp"
#include "protocol/state_json.hpp"
#include "protocol/units.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::protocol {

// Ids and seats.
template <class Id>
[[nodiscard]] Id read_id(const JsonNode& node) {
  return Id{node.integer<std::int64_t>(1)};
}
[[nodiscard]] std::uint32_t read_turn(const JsonNode& node);
[[nodiscard]] physics::BallId read_ball_id(const JsonNode& node);
[[nodiscard]] rules::Seat read_seat(const JsonNode& node);
[[nodiscard]] physics::PocketId read_pocket(const JsonNode& node);
[[nodiscard]] rules::Decision read_decision(const JsonNode& node);
[[nodiscard]] std::vector<rules::Decision> read_decisions(const JsonNode& node);
[[nodiscard]] std::vector<physics::BallId> read_ball_ids(const JsonNode& node);
void write_seat(JsonWriter& out, rules::Seat seat);
void write_seat(JsonWriter& out, const std::optional<rules::Seat>& seat);  // null if unset
void write_decisions(JsonWriter& out, const std::vector<rules::Decision>& decisions);
void write_ball_ids(JsonWriter& out, const std::vector<physics::BallId>& balls);

// {"x": m, "y": m}
[[nodiscard]] physics::Vec2<double> read_point(const JsonNode& node);
void write_point(JsonWriter& out, const physics::Vec2<double>& point);

[[nodiscard]] ShotParams read_shot_params(const JsonNode& node);
void write_shot_params(JsonWriter& out, const ShotParams& params);
[[nodiscard]] NoiseParams read_noise(const JsonNode& node);
void write_noise(JsonWriter& out, const NoiseParams& noise);

[[nodiscard]] rules::Call read_call(const JsonNode& node);
void write_call(JsonWriter& out, const rules::Call& call);

[[nodiscard]] rules::GameState read_state(const JsonNode& node);
[[nodiscard]] RulingReport read_ruling(const JsonNode& node);
[[nodiscard]] physics::EventLog<double> read_events(const JsonNode& node);

// Messages may carry members that this version does not know; files may not.
enum class UnknownKeys : std::uint8_t { ignored, refused };
[[nodiscard]] physics::Table read_table(const JsonNode& node, UnknownKeys unknown);
[[nodiscard]] physics::Materials read_materials(const JsonNode& node, UnknownKeys unknown);

}  // namespace poolhall::protocol
