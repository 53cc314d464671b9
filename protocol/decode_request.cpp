// An agent's line to a request: the JSON-RPC frame first, then the parameters of its method.
#include <array>
#include <limits>

#include "protocol/codec.hpp"
#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

constexpr std::int64_t day_ms = 24LL * 60 * 60 * 1000;

// Characters, not bytes, of valid UTF-8.
std::size_t characters(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) {
    count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  }
  return count;
}

std::string read_name(const JsonNode& node, const Limits& limits) {
  std::string name = node.string();
  if (!is_agent_name(name, limits)) {
    node.refuse_as(ErrorCode::bad_name,
                   "expected 1 to " + std::to_string(limits.name_length) +
                       " of A-Z a-z 0-9 . _ -, not . or .. alone, got a string of " +
                       std::to_string(name.size()) + " bytes");
  }
  return name;
}

// Never says what came: it may be a token.
Hex256 read_hex(const JsonNode& node) {
  Hex256 hex{node.string()};
  bool well_formed = hex.text.size() == 64;
  for (char& c : hex.text) {
    if (c >= 'A' && c <= 'F') {
      c = static_cast<char>(c - 'A' + 'a');
    }
    well_formed = well_formed && ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'));
  }
  if (!well_formed) {
    node.refuse("expected 64 hexadecimal digits, got a string of " +
                std::to_string(hex.text.size()) + " bytes");
  }
  return hex;
}

ShotId read_shot_id(const JsonNode& node, const Limits& limits) {
  const std::string expected =
      "an integer or a string of 1 to " + std::to_string(limits.shot_id_length) + " characters";
  if (node.value() == nullptr) {
    return {};
  }
  if (const auto* text = node.value()->as<std::string>()) {
    const std::size_t length = characters(*text);
    if (length == 0 || length > limits.shot_id_length) {
      node.refuse_expecting(expected);
    }
    return {canonical_text(*node.value())};
  }
  return {std::to_string(node.integer<std::int64_t>())};
}

std::string read_short_text(const JsonNode& node, const Limits& limits) {
  std::string text = node.string();
  if (text.size() > limits.client_name_length) {
    node.refuse_expecting("at most " + std::to_string(limits.client_name_length) + " bytes");
  }
  return text;
}

Hello read_hello(const JsonNode& params, const Limits& limits) {
  Hello hello;
  const std::vector<JsonNode> range = params.at("protocol").elements(2);
  hello.least_protocol = range[0].integer<int>(0);
  hello.most_protocol = range[1].integer<int>(hello.least_protocol);
  hello.name = read_name(params.at("name"), limits);
  if (const auto client = params.find("client")) {
    hello.client = ClientInfo{read_short_text(client->at("name"), limits), {}};
    if (const auto version = client->find("version")) {
      hello.client->version = read_short_text(*version, limits);
    }
  }
  if (const auto detail = params.find("detail")) {
    hello.detail = detail->one_of(
        [](std::string_view name) -> std::optional<EventDetail> {
          if (name == "full") {
            return EventDetail::full;
          }
          return name == "summary" ? std::optional(EventDetail::summary) : std::nullopt;
        },
        "\"full\" or \"summary\"");
  }
  return hello;
}

Register read_register(const JsonNode& params, const Limits& limits) {
  Register request{read_name(params.at("name"), limits), {}};
  if (const auto token = params.find("token")) {
    request.token = read_hex(*token);
  }
  return request;
}

ClockSettings read_asked_clock(const JsonNode& node) {
  ClockSettings clock;
  clock.game_ms = node.at("game_ms").integer<std::int64_t>(1, day_ms);
  if (const auto increment = node.find("increment_ms")) {
    clock.increment_ms = increment->integer<std::int64_t>(0, day_ms);
  }
  if (const auto shot = node.find("shot_ms")) {
    clock.shot_ms = shot->integer<std::int64_t>(1, day_ms);
  }
  return clock;
}

std::string read_opponent(const JsonNode& node, const Limits& limits) {
  constexpr std::string_view house = "house:";
  std::string opponent = node.string();
  std::string_view bare = opponent;
  if (bare.starts_with(house)) {
    bare.remove_prefix(house.size());
  }
  if (!is_agent_name(bare, limits)) {
    node.refuse_as(ErrorCode::bad_name, "expected an agent's name, or \"house:NAME\"");
  }
  return opponent;
}

Challenge read_challenge(const JsonNode& params, const Limits& limits) {
  Challenge challenge{.opponent = read_opponent(params.at("opponent"), limits),
                      .rules = {},
                      .noise = {},
                      .clock = {},
                      .challenge_id = {}};
  if (const auto rules = params.find("rules")) {
    challenge.rules = rules->one_of(rules::rule_set, "\"8-ball\" or \"9-ball\"");
  }
  if (const auto noise = params.find("noise")) {
    challenge.noise = noise->string();
    if (!is_noise_name(*challenge.noise)) {
      noise->refuse_expecting("\"none\", \"low\", \"olympiad\", \"high\" or \"variable\"");
    }
  }
  if (const auto clock = params.find("clock")) {
    challenge.clock = read_asked_clock(*clock);
  }
  if (const auto id = params.find("challenge_id")) {
    challenge.challenge_id = read_shot_id(*id, limits);
  }
  return challenge;
}

Shot read_shot(const JsonNode& params, const Limits& limits) {
  Shot shot;
  shot.game = read_id<GameId>(params.at("game"));
  shot.turn = read_turn(params.at("turn"));
  shot.shot_id = read_shot_id(params.at("shot_id"), limits);
  shot.params = read_shot_params(params.at("params"));
  if (const auto place = params.find("cue_ball")) {
    shot.cue_ball = read_point(*place);
  }
  if (const auto call = params.find("call")) {
    shot.call = read_call(*call);
  }
  return shot;
}

Decide read_decide(const JsonNode& params) {
  return {read_id<GameId>(params.at("game")), read_turn(params.at("turn")),
          read_decision(params.at("choice"))};
}

Ping read_ping(const JsonNode& params) {
  const auto t = params.find("t");
  if (!t) {
    return {};
  }
  if (t->value()->as<bool>() != nullptr || t->value()->as<JsonArray>() != nullptr ||
      t->is_object()) {
    t->refuse_expecting("a number, a string or null");
  }
  return {RawJson{canonical_text(*t->value())}};
}

// The first of game, match and tournament that is there.
Ack read_ack(const JsonNode& params) {
  if (!params.find("game")) {
    if (const auto match = params.find("match")) {
      return {read_id<MatchId>(*match)};
    }
    if (const auto tournament = params.find("tournament")) {
      return {read_id<TournamentId>(*tournament)};
    }
  }
  return {read_id<GameId>(params.at("game"))};
}

Request read_params(Method method, const JsonNode& params, const Limits& limits) {
  switch (method) {
    case Method::hello:
      return read_hello(params, limits);
    case Method::register_agent:
      return read_register(params, limits);
    case Method::login:
      return Login{read_hex(params.at("token"))};
    case Method::tournament_list:
      static_cast<void>(params.find("tournament"));  // nothing is read, but an object it is
      return TournamentList{};
    case Method::tournament_join:
      return TournamentJoin{read_id<TournamentId>(params.at("tournament"))};
    case Method::tournament_leave:
      return TournamentLeave{read_id<TournamentId>(params.at("tournament"))};
    case Method::challenge:
      return read_challenge(params, limits);
    case Method::challenge_accept:
      return ChallengeAccept{read_id<ChallengeId>(params.at("challenge"))};
    case Method::challenge_decline:
      return ChallengeDecline{read_id<ChallengeId>(params.at("challenge"))};
    case Method::shot:
      return read_shot(params, limits);
    case Method::decide:
      return read_decide(params);
    case Method::concede:
      return Concede{read_id<GameId>(params.at("game"))};
    case Method::sync:
      return Sync{read_id<GameId>(params.at("game"))};
    case Method::ack:
      return read_ack(params);
    case Method::ping:
      return read_ping(params);
    case Method::lag:
      return Lag{params.at("t").integer<std::int64_t>()};
    case Method::game_ready:
      return GameReady{read_hex(params.at("commitment"))};
    case Method::game_reveal:
      return GameReveal{read_id<GameId>(params.at("game")), read_hex(params.at("secret"))};
  }
  return TournamentList{};  // not reached: every method has its case
}

Error refused_request(std::string field, std::string reason) {
  return {ErrorCode::invalid_request, std::move(field), std::move(reason), {}, false};
}

// What stands around the parameters.
struct Frame {
  std::optional<RequestId> id;
  Method method{};
};

Expected<std::optional<RequestId>> read_request_id(const JsonValue& document) {
  const JsonValue* id = document.member("id");
  if (id == nullptr) {
    return std::nullopt;
  }
  if (id->as<bool>() != nullptr || id->as<JsonArray>() != nullptr ||
      id->as<JsonObject>() != nullptr) {
    return tl::unexpected(
        refused_request("/id", "expected a number, a string or null, got " + described(*id)));
  }
  return RequestId{canonical_text(*id)};
}

Expected<Method> read_method(const JsonValue& document) {
  const JsonValue* version = document.member("jsonrpc");
  const auto* version_text = version == nullptr ? nullptr : version->as<std::string>();
  if (version_text == nullptr || *version_text != "2.0") {
    return tl::unexpected(refused_request(
        "/jsonrpc", version == nullptr ? "is missing; expected \"2.0\""
                                       : "expected \"2.0\", got " + described(*version)));
  }
  const JsonValue* name = document.member("method");
  const auto* text = name == nullptr ? nullptr : name->as<std::string>();
  if (text == nullptr) {
    return tl::unexpected(refused_request(
        "/method", name == nullptr ? "is missing" : "expected a string, got " + described(*name)));
  }
  const auto known = method(*text);
  if (!known) {
    return tl::unexpected(Error{ErrorCode::method_not_found,
                                "/method",
                                "there is no method " + described(*name),
                                {},
                                false});
  }
  return *known;
}

Error no_request(const JsonValue& document) {
  return refused_request(
      "", document.as<JsonArray>() != nullptr
              ? "batches are not taken: expected one request, got " + described(document)
              : "expected an object, got " + described(document));
}

// The game that a bad request is about, so that the answer can name it.
std::optional<GameId> game_of(const JsonValue& document) {
  const JsonValue* params = document.member("params");
  const JsonValue* game = params == nullptr ? nullptr : params->member("game");
  if (game == nullptr) {
    return std::nullopt;
  }
  Reading reading(*game);
  const auto id = read_id<GameId>(reading.root());
  return reading.ok() ? std::optional(id) : std::nullopt;
}

Expected<Request> read_request(const JsonValue& document, Method method, const Limits& limits) {
  Reading reading(document);
  const bool needs_params = method != Method::tournament_list && method != Method::ping;
  const bool has_params = document.member("params") != nullptr;
  const JsonNode params =
      needs_params || has_params ? reading.root().at("params") : JsonNode(reading);
  Request request = read_params(method, params, limits);
  if (!reading.ok()) {
    Error error = reading.error();
    error.game = game_of(document);
    return tl::unexpected(std::move(error));
  }
  return request;
}

}  // namespace

tl::expected<Incoming, BadLine> decode_request(std::string_view line, const Limits& limits) {
  const Expected<JsonValue> document = parse_json(line, json_bounds(limits));
  if (!document) {
    return tl::unexpected(BadLine{{}, document.error()});
  }
  if (document->as<JsonObject>() == nullptr) {
    return tl::unexpected(BadLine{{}, no_request(*document)});
  }
  const auto id = read_request_id(*document);
  if (!id) {
    return tl::unexpected(BadLine{{}, id.error()});
  }
  const RequestId answer_under = id->value_or(RequestId{});
  const auto method = read_method(*document);
  if (!method) {
    return tl::unexpected(BadLine{answer_under, method.error()});
  }
  if (!*id && *method != Method::lag) {
    return tl::unexpected(
        BadLine{answer_under, refused_request("/id", "is missing; only `lag` goes without")});
  }
  auto request = read_request(*document, *method, limits);
  if (!request) {
    return tl::unexpected(BadLine{answer_under, request.error()});
  }
  return Incoming{*id, std::move(*request)};
}

}  // namespace poolhall::protocol
