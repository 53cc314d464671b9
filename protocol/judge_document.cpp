#include "protocol/judge_document.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "physics/simulator.hpp"
#include "protocol/events_json.hpp"
#include "protocol/json_parts.hpp"
#include "protocol/state_json.hpp"

namespace poolhall::protocol {
namespace {

struct Document {
  physics::Table table;
  physics::Materials materials;
  rules::GameState state;
  rules::Call call;
  std::optional<physics::Vec2<double>> cue_ball{};
  std::optional<physics::EventLog<double>> events{};
  std::optional<ShotParams> shot{};
  std::optional<rules::Decision> decision{};
  std::optional<rules::FoulCode> lost_turn{};
};

JsonValue whole(std::int64_t value) {
  return JsonValue{value};
}

JsonValue list(const std::vector<JsonValue>& items) {
  return JsonValue{JsonArray(items)};
}

// The kind of a turn that is not named, from where the ball is in hand.
JsonValue kind_of(const JsonValue& state) {
  const JsonValue* in_hand = state.member("ball_in_hand");
  const std::string* place = in_hand == nullptr ? nullptr : in_hand->as<std::string>();
  if (place != nullptr && *place == "anywhere") {
    return JsonValue{std::string("ball_in_hand")};
  }
  if (place != nullptr && *place == "behind_head_string") {
    return JsonValue{std::string("ball_in_hand_behind_head_string")};
  }
  return JsonValue{std::string("shot")};
}

// What a state may leave out, with what is meant then.
JsonObject state_defaults(const JsonValue& state) {
  const JsonValue none{};
  const JsonObject settings{{"breaker", whole(0)},
                            {"rack_seed", whole(0)},
                            {"rack_gap", JsonValue{0.0}},
                            {"rack_jitter", JsonValue{0.0}}};
  return {{"rules", JsonValue{std::string("8-ball")}},
          {"turn", whole(1)},
          {"kind", kind_of(state)},
          {"to_move", whole(0)},
          {"groups", list({none, none})},
          {"fouls_in_a_row", list({whole(0), whole(0)})},
          {"push_out_allowed", JsonValue{false}},
          {"breaker", whole(0)},
          {"rack", whole(1)},
          {"options", list({})},
          {"turns_without_pocket", whole(0)},
          {"stalemates", whole(0)},
          {"settings", JsonValue{settings}},
          {"result", none}};
}

JsonValue with_defaults(JsonValue state) {
  JsonObject defaults = state_defaults(state);
  auto* members = std::get_if<JsonObject>(&state.data);
  if (members == nullptr) {
    return state;
  }
  for (auto& [key, value] : defaults) {
    const auto found = std::find_if(members->begin(), members->end(),
                                    [&key](const auto& member) { return member.first == key; });
    if (found == members->end()) {
      members->emplace_back(key, std::move(value));
    } else if (found->second.is_null()) {
      found->second = std::move(value);
    }
  }
  return state;
}

JsonValue with_state_defaults(JsonValue document) {
  if (auto* members = std::get_if<JsonObject>(&document.data)) {
    for (auto& [key, value] : *members) {
      if (key == "state") {
        value = with_defaults(std::move(value));
      }
    }
  }
  return document;
}

// The groups of a state twice told: of both seats, and whether the table is open.
void check_groups(const JsonNode& state, const rules::GameState& read) {
  const auto* memory = std::get_if<rules::EightBallMemory>(&read.memory);
  if (memory == nullptr) {
    return;
  }
  const JsonNode groups = state.at("groups");
  const JsonNode second = groups.elements(2)[1];
  const auto expected = rules::group_of(*memory, rules::Seat::second);
  const bool is_null = second.value() == nullptr || second.value()->is_null();
  if (expected ? !second.is_string(rules::name(*expected)) : !is_null) {
    groups.refuse(
        "the players' groups do not fit each other, expected [null, null], "
        "[\"solids\", \"stripes\"] or [\"stripes\", \"solids\"]");
  }
  if (const auto open = state.find("open_table");
      open && open->boolean() == memory->first_seat_group.has_value()) {
    open->refuse_expecting(memory->first_seat_group ? "false, as there are groups"
                                                    : "true, as there are no groups");
  }
}

std::optional<rules::FoulCode> lost_turn_code(std::string_view name) {
  const auto code = rules::foul_code(name);
  const bool fits =
      code == rules::FoulCode::shot_time_exceeded || code == rules::FoulCode::too_many_refusals;
  return fits ? code : std::nullopt;
}

void read_what_happened(const JsonNode& root, Document& document) {
  const std::array<std::optional<JsonNode>, 4> given{root.find("events"), root.find("shot"),
                                                     root.find("decision"), root.find("lost_turn")};
  if (std::count_if(given.begin(), given.end(), [](const auto& node) { return !!node; }) != 1) {
    root.refuse("expected one of \"events\", \"shot\", \"decision\" and \"lost_turn\"");
    return;
  }
  if (given[0]) {
    document.events = read_events(*given[0]);
  } else if (given[1]) {
    given[1]->only({"a", "b", "theta", "phi", "v"});
    document.shot = read_shot_params(*given[1]);
  } else if (given[2]) {
    document.decision = read_decision(*given[2]);
  } else {
    document.lost_turn =
        given[3]->one_of(lost_turn_code, "\"shot_time_exceeded\" or \"too_many_refusals\"");
  }
}

Document read(const JsonNode& root) {
  root.only(
      {"table", "physics", "state", "call", "cue_ball", "events", "shot", "decision", "lost_turn"});
  Document document;
  const auto table = root.find("table");
  document.table =
      table ? read_table(*table, UnknownKeys::refused) : physics::preset_table("olympiad").value();
  const auto materials = root.find("physics");
  document.materials = materials ? read_materials(*materials, UnknownKeys::refused)
                                 : physics::preset_materials("olympiad").value();
  document.state = read_state(root.at("state"));
  check_groups(root.at("state"), document.state);
  if (const auto call = root.find("call")) {
    document.call = read_call(*call);
  }
  if (const auto cue_ball = root.find("cue_ball")) {
    document.cue_ball = read_point(*cue_ball);
  }
  read_what_happened(root, document);
  return document;
}

// A refusal's field is a pointer into the state, the call or the log. `state` is where the state
// or its part stands that was checked; table and materials stand beside the state.
Error refused(const rules::Refusal& refusal, std::string_view state = "/state") {
  const std::string& field = refusal.field;
  switch (refusal.code) {
    case rules::RefusalCode::bad_state:
      return error_from(refusal,
                        field.starts_with("/table") || field.starts_with("/physics") ? "" : state);
    case rules::RefusalCode::bad_shot:
      return error_from({refusal.code, "/kind", refusal.reason}, "/state");
    case rules::RefusalCode::bad_decision:
      return error_from({refusal.code, "/decision", refusal.reason}, "");
    case rules::RefusalCode::bad_call:
    case rules::RefusalCode::bad_cue_ball_position:
    case rules::RefusalCode::bad_event_log:
      break;
  }
  return error_from(refusal, "");
}

std::string answer(const rules::Ruling& ruling,
                   const std::optional<physics::EventLog<double>>& events) {
  JsonWriter out;
  out.begin_object().key("ruling").raw(encode_ruling(ruling));
  out.key("state").raw(encode_state(ruling.next));
  if (events) {
    out.key("events").raw(encode_events(*events, EventDetail::full));
  }
  out.end_object();
  return std::move(out).text();
}

Expected<physics::EventLog<double>> simulated(const Document& document,
                                              const rules::GameState& ready) {
  const physics::Scene<double> scene{document.table, document.materials,
                                     rules::balls_on_table(ready), to_physics(*document.shot)};
  auto simulation = physics::simulate<double>(scene, {});
  if (!simulation) {
    return tl::unexpected(error_from(simulation.error(), ""));
  }
  return std::move(simulation->events);
}

// Where the log has the cue ball struck: in hand, it was placed there.
std::optional<physics::Vec2<double>> placed_by_log(const Document& document) {
  using rules::TurnKind;
  const TurnKind kind = document.state.kind;
  if (!document.events || document.events->empty() || kind == TurnKind::shot ||
      kind == TurnKind::decision) {
    return std::nullopt;
  }
  const physics::Event<double>& first = document.events->front();
  const physics::Ball<double>& ball = first.after[0];
  const bool placed = first.type == physics::EventType::cue_strike &&
                      ball.id == physics::cue_ball && ball.position != physics::Vec2<double>{};
  return placed ? std::optional{ball.position} : std::nullopt;
}

Expected<std::string> judged_shot(const Document& document) {
  const auto ready =
      rules::prepare_shot(document.state, document.call,
                          document.cue_ball ? document.cue_ball : placed_by_log(document),
                          document.table, document.materials);
  if (!ready) {
    return tl::unexpected(refused(ready.error()));
  }
  Expected<physics::EventLog<double>> events =
      document.events ? *document.events : simulated(document, *ready);
  if (!events) {
    return tl::unexpected(events.error());
  }
  const auto ruling =
      rules::judge(*ready, document.call, *events, document.table, document.materials);
  if (!ruling) {
    return tl::unexpected(refused(ruling.error()));
  }
  return answer(*ruling, document.shot ? std::optional{std::move(*events)} : std::nullopt);
}

Expected<std::string> decided(const Document& document) {
  const auto next =
      rules::decide(document.state, *document.decision, document.table, document.materials);
  if (!next) {
    return tl::unexpected(refused(next.error()));
  }
  JsonWriter out;
  out.begin_object().key("state").raw(encode_state(*next)).end_object();
  return std::move(out).text();
}

Expected<std::string> judged(const Document& document) {
  if (const auto settings =
          rules::check_settings(document.state.settings, document.table, document.materials);
      !settings) {
    return tl::unexpected(refused(settings.error(), "/state/settings"));
  }
  if (const auto possible = rules::check_state(document.state, document.table, document.materials);
      !possible) {
    return tl::unexpected(refused(possible.error()));
  }
  if (document.decision) {
    return decided(document);
  }
  if (document.lost_turn && document.state.result) {
    return tl::unexpected(
        refused({rules::RefusalCode::bad_shot, "", "the game is over, no turn can be lost"}));
  }
  if (document.lost_turn) {
    return answer(rules::judge_lost_turn(document.state, *document.lost_turn, document.table,
                                         document.materials),
                  std::nullopt);
  }
  return judged_shot(document);
}

}  // namespace

Expected<std::string> judge_document(std::string_view text) {
  Expected<JsonValue> parsed = parse_json(text, document_bounds);
  if (!parsed) {
    return tl::unexpected(parsed.error());
  }
  const JsonValue filled = with_state_defaults(std::move(*parsed));
  Reading reading(filled);
  const Document document = read(reading.root());
  if (!reading.ok()) {
    return tl::unexpected(reading.error());
  }
  return judged(document);
}

}  // namespace poolhall::protocol
