#include "protocol/events_json.hpp"

#include <algorithm>
#include <string>

#include "protocol/events_text.hpp"
#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

physics::Ball<double> read_ball_after(const JsonNode& node) {
  physics::Ball<double> ball;
  ball.id = read_ball_id(node.at("id"));
  ball.state = node.at("state").one_of(
      physics::motion_state,
      "\"stationary\", \"spinning\", \"rolling\", \"sliding\" or \"pocketed\"");
  ball.position = read_point(node);
  ball.velocity = {node.at("vx").number(), node.at("vy").number()};
  ball.angular_velocity = {node.at("wx").number(), node.at("wy").number(), node.at("wz").number()};
  return ball;
}

void read_participants(const JsonNode& node, physics::Event<double>& event) {
  const std::vector<physics::BallId> ids = read_ball_ids(node.at("balls"));
  if (ids.empty() || ids.size() > event.after.size()) {
    node.at("balls").refuse_expecting("one or two balls");
    return;
  }
  event.ball_count = static_cast<std::uint8_t>(ids.size());
  const auto after = node.find("after");
  const std::vector<JsonNode> states =
      after ? after->elements(ids.size()) : std::vector<JsonNode>();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    event.after[i].id = ids[i];
    if (!states.empty()) {
      event.after[i] = read_ball_after(states[i]);
      if (event.after[i].id != ids[i]) {
        states[i].at("id").refuse_expecting(std::to_string(physics::number(ids[i])) +
                                            " as in balls");
      }
    }
    if (event.after[i].state == physics::MotionState::pocketed) {
      event.after[i].pocket = event.pocket;
    }
  }
}

physics::Event<double> read_event(const JsonNode& node) {
  physics::Event<double> event;
  event.t = node.at("t").number();
  event.type = node.at("type").one_of(
      physics::event_type,
      "\"cue_strike\", \"ball_collision\", \"rail_collision\", \"pocketed\", \"transition\" or "
      "\"off_table\"");
  if (const auto rail = node.find("rail")) {
    event.rail = rail->one_of(physics::rail_id,
                              "\"head\", \"head_left\", \"head_right\", \"foot_left\", "
                              "\"foot_right\" or \"foot\"");
  }
  if (const auto pocket = node.find("pocket")) {
    event.pocket = read_pocket(*pocket);
  }
  if (const auto count = node.find("count")) {
    event.count = count->integer<std::uint32_t>(1);
  }
  if (const auto until = node.find("until")) {
    event.until = until->number();
  }
  read_participants(node, event);
  return event;
}

}  // namespace

physics::EventLog<double> read_events(const JsonNode& node) {
  physics::EventLog<double> events;
  for (const JsonNode& element : node.elements()) {
    events.push_back(read_event(element));
  }
  return events;
}

std::string encode_events(const physics::EventLog<double>& events, EventDetail detail) {
  JsonWriter out;
  // A ball's numbers take about 180 bytes, and most events have one ball.
  out.reserve(events.size() * (detail == EventDetail::full ? 320 : 80) + 2);
  write_events(out, events, detail);
  return std::move(out).text();
}

std::string summary_of(std::string_view full) {
  // Each event ends with its `after`, whose objects have no arrays in them.
  constexpr std::string_view opening = ",\"after\":[";
  std::string summary;
  for (std::size_t at = 0; at < full.size();) {
    const std::size_t start = std::min(full.find(opening, at), full.size());
    summary += full.substr(at, start - at);
    at = start == full.size() ? start : full.find(']', start) + 1;
  }
  return summary;
}

Expected<physics::EventLog<double>> decode_events(std::string_view text) {
  return read_document(text, document_bounds, read_events);
}

}  // namespace poolhall::protocol
