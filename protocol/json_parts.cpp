#include "protocol/json_parts.hpp"

namespace poolhall::protocol {

std::uint32_t read_turn(const JsonNode& node) {
  return node.integer<std::uint32_t>(1);
}

physics::BallId read_ball_id(const JsonNode& node) {
  return physics::BallId{node.integer<std::uint8_t>(0, physics::max_balls - 1)};
}

rules::Seat read_seat(const JsonNode& node) {
  return static_cast<rules::Seat>(node.integer<std::uint8_t>(0, 1));
}

physics::PocketId read_pocket(const JsonNode& node) {
  return node.one_of(physics::pocket_id,
                     "\"head_left\", \"head_right\", \"side_left\", \"side_right\", \"foot_left\" "
                     "or \"foot_right\"");
}

rules::Decision read_decision(const JsonNode& node) {
  return node.one_of(rules::decision,
                     "\"accept\", \"accept_ball_in_hand\", \"rerack_chooser_breaks\", "
                     "\"rerack_breaker_breaks\", \"spot_eight\", \"shoot\" or \"pass_back\"");
}

std::vector<rules::Decision> read_decisions(const JsonNode& node) {
  std::vector<rules::Decision> decisions;
  for (const JsonNode& element : node.elements()) {
    decisions.push_back(read_decision(element));
  }
  return decisions;
}

std::vector<physics::BallId> read_ball_ids(const JsonNode& node) {
  std::vector<physics::BallId> balls;
  for (const JsonNode& element : node.elements()) {
    balls.push_back(read_ball_id(element));
  }
  return balls;
}

void write_seat(JsonWriter& out, rules::Seat seat) {
  out.integer(rules::index(seat));
}

void write_seat(JsonWriter& out, const std::optional<rules::Seat>& seat) {
  if (seat) {
    write_seat(out, *seat);
  } else {
    out.null();
  }
}

void write_decisions(JsonWriter& out, const std::vector<rules::Decision>& decisions) {
  out.begin_array();
  for (const rules::Decision decision : decisions) {
    out.string(rules::name(decision));
  }
  out.end_array();
}

void write_ball_ids(JsonWriter& out, const std::vector<physics::BallId>& balls) {
  out.begin_array();
  for (const physics::BallId ball : balls) {
    out.integer(physics::number(ball));
  }
  out.end_array();
}

physics::Vec2<double> read_point(const JsonNode& node) {
  return {node.at("x").number(), node.at("y").number()};
}

void write_point(JsonWriter& out, const physics::Vec2<double>& point) {
  out.begin_object().key("x").number(point.x).key("y").number(point.y).end_object();
}

ShotParams read_shot_params(const JsonNode& node) {
  return {node.at("a").number(), node.at("b").number(), node.at("theta").number(),
          node.at("phi").number(), node.at("v").number()};
}

void write_shot_params(JsonWriter& out, const ShotParams& params) {
  out.begin_object();
  out.key("a").number(params.a).key("b").number(params.b).key("theta").number(params.theta);
  out.key("phi").number(params.phi).key("v").number(params.v);
  out.end_object();
}

NoiseParams read_noise(const JsonNode& node) {
  return {node.at("a").number(), node.at("b").number(), node.at("theta").number(),
          node.at("phi").number(), node.at("v").number()};
}

void write_noise(JsonWriter& out, const NoiseParams& noise) {
  write_shot_params(out, {noise.a, noise.b, noise.theta, noise.phi, noise.v});
}

rules::Call read_call(const JsonNode& node) {
  using Kind = rules::Call::Kind;
  if (node.value() == nullptr || node.value()->is_null()) {
    return {};
  }
  if (node.is_string("safety")) {
    return {Kind::safety, {}, {}};
  }
  if (node.is_string("push_out")) {
    return {Kind::push_out, {}, {}};
  }
  if (!node.is_object()) {
    node.refuse_expecting("\"safety\", \"push_out\" or {\"ball\", \"pocket\"}");
    return {};
  }
  return {Kind::pocket, read_ball_id(node.at("ball")), read_pocket(node.at("pocket"))};
}

void write_call(JsonWriter& out, const rules::Call& call) {
  using Kind = rules::Call::Kind;
  switch (call.kind) {
    case Kind::none:
      out.null();
      return;
    case Kind::safety:
      out.string("safety");
      return;
    case Kind::push_out:
      out.string("push_out");
      return;
    case Kind::pocket:
      out.begin_object().key("ball").integer(physics::number(call.ball));
      out.key("pocket").string(physics::name(call.pocket)).end_object();
  }
}

}  // namespace poolhall::protocol
