#include "protocol/state_json.hpp"

#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

using rules::TurnKind;
using rules::Whereabouts;

// 2^53: beyond it some JSON readers lose digits.
constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 53U) - 1;

void write_ball_places(JsonWriter& out, const std::vector<rules::BallPlace>& balls) {
  out.begin_array();
  for (const rules::BallPlace& ball : balls) {
    out.begin_object().key("id").integer(physics::number(ball.id));
    if (ball.where == Whereabouts::on_table) {
      out.key("x").number(ball.position.x).key("y").number(ball.position.y);
    } else if (ball.where == Whereabouts::pocketed) {
      out.key("pocket").string(physics::name(ball.pocket));
    } else {
      out.key("off_table").boolean(true);
    }
    out.end_object();
  }
  out.end_array();
}

rules::BallPlace read_ball_place(const JsonNode& node) {
  rules::BallPlace ball;
  ball.id = read_ball_id(node.at("id"));
  if (const auto pocket = node.find("pocket")) {
    ball.where = Whereabouts::pocketed;
    ball.pocket = read_pocket(*pocket);
  } else if (const auto off = node.find("off_table"); off && off->boolean()) {
    ball.where = Whereabouts::off_table;
  } else {
    ball.position = read_point(node);
  }
  return ball;
}

void write_ball_in_hand(JsonWriter& out, TurnKind kind) {
  switch (kind) {
    case TurnKind::ball_in_hand:
      out.string("anywhere");
      return;
    case TurnKind::break_shot:
    case TurnKind::ball_in_hand_behind_head_string:
      out.string("behind_head_string");
      return;
    case TurnKind::shot:
    case TurnKind::decision:
      out.null();
  }
}

void write_memory(JsonWriter& out, const rules::EightBallMemory& memory) {
  out.key("open_table").boolean(!memory.first_seat_group).key("groups").begin_array();
  for (const rules::Seat seat : {rules::Seat::first, rules::Seat::second}) {
    if (const auto group = rules::group_of(memory, seat)) {
      out.string(rules::name(*group));
    } else {
      out.null();
    }
  }
  out.end_array();
}

void write_memory(JsonWriter& out, const rules::NineBallMemory& memory) {
  out.key("fouls_in_a_row").begin_array();
  out.integer(memory.fouls_in_a_row[0]).integer(memory.fouls_in_a_row[1]).end_array();
  out.key("push_out_allowed").boolean(memory.push_out_allowed);
}

rules::EightBallMemory read_eight_ball_memory(const JsonNode& node) {
  rules::EightBallMemory memory;
  const std::vector<JsonNode> groups = node.at("groups").elements(2);
  if (groups[0].value() != nullptr && !groups[0].value()->is_null()) {
    memory.first_seat_group = groups[0].one_of(
        [](std::string_view name) { return rules::group(name); }, "\"solids\" or \"stripes\"");
  }
  return memory;
}

rules::NineBallMemory read_nine_ball_memory(const JsonNode& node) {
  rules::NineBallMemory memory;
  const std::vector<JsonNode> fouls = node.at("fouls_in_a_row").elements(2);
  for (std::size_t seat = 0; seat < 2; ++seat) {
    memory.fouls_in_a_row[seat] = fouls[seat].integer<std::uint8_t>(0, 3);
  }
  memory.push_out_allowed = node.at("push_out_allowed").boolean();
  return memory;
}

void write_settings(JsonWriter& out, const rules::GameSettings& settings) {
  out.begin_object().key("breaker");
  write_seat(out, settings.breaker);
  out.key("rack_seed").integer(settings.rack_seed);
  out.key("rack_gap").number(settings.rack_gap);
  out.key("rack_jitter").number(settings.rack_jitter).end_object();
}

rules::GameSettings read_settings(const JsonNode& node) {
  rules::GameSettings settings;
  settings.breaker = read_seat(node.at("breaker"));
  settings.rack_seed = node.at("rack_seed").integer<std::uint64_t>(0, largest_seed);
  settings.rack_gap = node.at("rack_gap").number();
  settings.rack_jitter = node.at("rack_jitter").number();
  return settings;
}

void write_result(JsonWriter& out, const std::optional<rules::GameResult>& result) {
  if (!result) {
    out.null();
    return;
  }
  out.begin_object().key("winner");
  write_seat(out, result->winner);
  out.key("reason").string(rules::name(result->reason)).end_object();
}

std::optional<rules::GameResult> read_result(const JsonNode& parent) {
  const auto node = parent.nullable("result");
  if (!node) {
    return std::nullopt;
  }
  rules::GameResult result;
  if (const auto winner = node->nullable("winner")) {
    result.winner = read_seat(*winner);
  }
  result.reason = node->at("reason").one_of(rules::end_reason, "the name of an end reason");
  return result;
}

rules::TurnKind read_kind(const JsonNode& node) {
  return node.one_of(rules::turn_kind,
                     "\"break\", \"shot\", \"ball_in_hand\", "
                     "\"ball_in_hand_behind_head_string\" or \"decision\"");
}

void write_state(JsonWriter& out, const rules::GameState& state) {
  out.begin_object().key("rules").string(rules::name(state.settings.rules));
  out.key("turn").integer(state.turn).key("kind").string(rules::name(state.kind));
  out.key("to_move");
  write_seat(out, state.to_move);
  out.key("ball_in_hand");
  write_ball_in_hand(out, state.kind);
  std::visit([&](const auto& memory) { write_memory(out, memory); }, state.memory);
  out.key("balls");
  write_ball_places(out, state.balls);
  out.key("breaker");
  write_seat(out, state.breaker);
  out.key("rack").integer(state.rack).key("options");
  write_decisions(out, state.options);
  out.key("turns_without_pocket").integer(state.turns_without_pocket);
  out.key("stalemates").integer(state.stalemates).key("settings");
  write_settings(out, state.settings);
  out.key("result");
  write_result(out, state.result);
  out.end_object();
}

template <class Clause>
void write_clause(JsonWriter& out, const Clause& clause) {
  out.key("rule").string(clause.rule).key("text").string(clause.text).key("event");
  if (clause.event) {
    out.integer(*clause.event);
  } else {
    out.null();
  }
}

template <class Clause>
void read_clause(const JsonNode& node, Clause& clause) {
  clause.rule = node.at("rule").string();
  clause.text = node.at("text").string();
  if (const auto event = node.nullable("event")) {
    clause.event = event->integer<std::size_t>();
  }
}

void write_fouls(JsonWriter& out, const std::vector<rules::FoulRecord>& fouls) {
  out.begin_array();
  for (const rules::FoulRecord& foul : fouls) {
    out.begin_object().key("code").string(rules::name(foul.code));
    write_clause(out, foul);
    out.end_object();
  }
  out.end_array();
}

std::vector<rules::FoulRecord> read_fouls(const JsonNode& node) {
  std::vector<rules::FoulRecord> fouls;
  for (const JsonNode& element : node.elements()) {
    rules::FoulRecord& foul = fouls.emplace_back();
    foul.code = element.at("code").one_of(rules::foul_code, "the name of a foul");
    read_clause(element, foul);
  }
  return fouls;
}

void write_pocketed(JsonWriter& out, const std::vector<rules::PocketedBall>& pocketed) {
  out.begin_array();
  for (const rules::PocketedBall& ball : pocketed) {
    out.begin_object().key("ball").integer(physics::number(ball.ball));
    out.key("pocket").string(physics::name(ball.pocket));
    out.key("event").integer(ball.event).end_object();
  }
  out.end_array();
}

std::vector<rules::PocketedBall> read_pocketed(const JsonNode& node) {
  std::vector<rules::PocketedBall> pocketed;
  for (const JsonNode& element : node.elements()) {
    pocketed.push_back({read_ball_id(element.at("ball")), read_pocket(element.at("pocket")),
                        element.at("event").integer<std::size_t>()});
  }
  return pocketed;
}

void write_next(JsonWriter& out, const rules::GameState& next) {
  out.begin_object().key("turn").integer(next.turn).key("to_move");
  write_seat(out, next.to_move);
  out.key("kind").string(rules::name(next.kind)).key("options");
  write_decisions(out, next.options);
  out.key("result");
  write_result(out, next.result);
  out.end_object();
}

NextTurn read_next(const JsonNode& node) {
  NextTurn next;
  next.turn = node.at("turn").integer<std::uint32_t>();
  next.to_move = read_seat(node.at("to_move"));
  next.kind = read_kind(node.at("kind"));
  next.options = read_decisions(node.at("options"));
  next.result = read_result(node);
  return next;
}

void write_notes(JsonWriter& out, const std::vector<rules::Finding>& notes) {
  out.begin_array();
  for (const rules::Finding& note : notes) {
    out.begin_object();
    write_clause(out, note);
    out.end_object();
  }
  out.end_array();
}

}  // namespace

rules::GameState read_state(const JsonNode& node) {
  rules::GameState state;
  state.settings = read_settings(node.at("settings"));
  state.settings.rules = node.at("rules").one_of(rules::rule_set, "\"8-ball\" or \"9-ball\"");
  for (const JsonNode& ball : node.at("balls").elements()) {
    state.balls.push_back(read_ball_place(ball));
  }
  state.to_move = read_seat(node.at("to_move"));
  state.turn = node.at("turn").integer<std::uint32_t>(1);
  state.kind = read_kind(node.at("kind"));
  state.breaker = read_seat(node.at("breaker"));
  state.rack = node.at("rack").integer<std::uint32_t>(1);
  state.options = read_decisions(node.at("options"));
  state.turns_without_pocket = node.at("turns_without_pocket").integer<std::uint32_t>();
  state.stalemates = node.at("stalemates").integer<std::uint32_t>();
  if (state.settings.rules == rules::RuleSet::eight_ball) {
    state.memory = read_eight_ball_memory(node);
  } else {
    state.memory = read_nine_ball_memory(node);
  }
  state.result = read_result(node);
  return state;
}

RulingReport read_ruling(const JsonNode& node) {
  RulingReport ruling;
  ruling.legal = node.at("legal").boolean();
  ruling.fouls = read_fouls(node.at("fouls"));
  ruling.pocketed = read_pocketed(node.at("pocketed"));
  ruling.driven_off = read_ball_ids(node.at("driven_off"));
  if (const auto first = node.nullable("first_contact")) {
    ruling.first_contact = read_ball_id(*first);
  }
  for (const JsonNode& note : node.at("notes").elements()) {
    read_clause(note, ruling.notes.emplace_back());
  }
  ruling.next = read_next(node.at("next"));
  return ruling;
}

std::string encode_state(const rules::GameState& state) {
  JsonWriter out;
  out.reserve(1536);
  write_state(out, state);
  return std::move(out).text();
}

Expected<rules::GameState> decode_state(std::string_view text) {
  return read_document(text, document_bounds, read_state);
}

std::string encode_call(const rules::Call& call) {
  JsonWriter out;
  write_call(out, call);
  return std::move(out).text();
}

Expected<rules::Call> decode_call(std::string_view text) {
  return read_document(text, document_bounds, read_call);
}

std::string encode_ruling(const rules::Ruling& ruling) {
  JsonWriter out;
  out.begin_object().key("legal").boolean(ruling.legal).key("fouls");
  write_fouls(out, ruling.fouls);
  out.key("pocketed");
  write_pocketed(out, ruling.pocketed);
  out.key("driven_off");
  write_ball_ids(out, ruling.driven_off);
  out.key("first_contact");
  if (ruling.first_contact) {
    out.integer(physics::number(*ruling.first_contact));
  } else {
    out.null();
  }
  out.key("notes");
  write_notes(out, ruling.notes);
  out.key("next");
  write_next(out, ruling.next);
  out.end_object();
  return std::move(out).text();
}

Expected<RulingReport> decode_ruling(std::string_view text) {
  return read_document(text, document_bounds, read_ruling);
}

}  // namespace poolhall::protocol
