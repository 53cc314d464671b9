// What a client reads of what the server sent. Members that are not known are passed over.
#include <cmath>

#include "protocol/json_messages.hpp"
#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

std::optional<TournamentId> read_tournament(const JsonNode& node) {
  const auto id = node.find("tournament");
  return id ? std::optional(read_id<TournamentId>(*id)) : std::nullopt;
}

std::optional<std::int64_t> read_milliseconds(const JsonNode& node, std::string_view key) {
  const auto value = node.find(key);
  return value ? std::optional(value->integer<std::int64_t>()) : std::nullopt;
}

std::array<std::optional<Hex256>, 2> read_hex_pair(const JsonNode& node) {
  std::array<std::optional<Hex256>, 2> pair;
  const std::vector<JsonNode> elements = node.elements(2);
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (elements[i].value() != nullptr && !elements[i].value()->is_null()) {
      pair[i] = Hex256{elements[i].string()};
    }
  }
  return pair;
}

ClockSettings read_clock_settings(const JsonNode& node) {
  return {node.at("game_ms").integer<std::int64_t>(),
          node.at("increment_ms").integer<std::int64_t>(), read_milliseconds(node, "shot_ms")};
}

ClockReading read_clock(const JsonNode& node) {
  return {node.at("own_ms").integer<std::int64_t>(), node.at("opponent_ms").integer<std::int64_t>(),
          read_milliseconds(node, "deadline_ms")};
}

rules::RuleSet read_rules(const JsonNode& node) {
  return node.one_of(rules::rule_set, "\"8-ball\" or \"9-ball\"");
}

rules::TurnKind read_turn_kind(const JsonNode& node) {
  return node.one_of(rules::turn_kind, "the name of a kind of turn");
}

GameTerms<Received> read_terms(const JsonNode& node) {
  GameTerms<Received> terms;
  terms.game = read_id<GameId>(node.at("game"));
  terms.match = read_id<MatchId>(node.at("match"));
  terms.tournament = read_tournament(node);
  terms.seat = read_seat(node.at("seat"));
  terms.opponent = node.at("opponent").string();
  terms.rules = read_rules(node.at("rules"));
  terms.table = read_table(node.at("table"), UnknownKeys::ignored);
  terms.physics = read_materials(node.at("physics"), UnknownKeys::ignored);
  if (!node.at("noise").is_string("hidden")) {
    terms.noise = read_noise(node.at("noise"));
  }
  terms.clock = read_clock_settings(node.at("clock"));
  terms.max_refusals = node.at("max_refusals").integer<std::uint32_t>();
  terms.commitment.text = node.at("commitment").string();
  terms.agent_commitments = read_hex_pair(node.at("agent_commitments"));
  return terms;
}

Legal read_legal(const JsonNode& node) {
  if (const auto decisions = node.find("decisions")) {
    return LegalDecisions{read_decisions(*decisions)};
  }
  LegalBalls legal;
  legal.balls = read_ball_ids(node.at("balls"));
  legal.first_balls = read_ball_ids(node.at("first_balls"));
  for (const JsonNode& call : node.at("calls").elements()) {
    legal.calls.push_back(call.one_of(rules::call_kind, "the name of a kind of call"));
  }
  return legal;
}

template <class Message>
void read_move(const JsonNode& node, Message& message) {
  message.game = read_id<GameId>(node.at("game"));
  message.turn = read_turn(node.at("turn"));
  message.by = read_seat(node.at("by"));
}

ChallengeOffer read_offer(const JsonNode& node) {
  return {read_id<ChallengeId>(node.at("challenge")),
          node.at("from").string(),
          read_rules(node.at("rules")),
          node.at("noise").string(),
          read_clock_settings(node.at("clock")),
          node.at("expires_ms").integer<std::int64_t>()};
}

ChallengeOver read_challenge_over(const JsonNode& node) {
  return {
      read_id<ChallengeId>(node.at("challenge")),
      node.at("outcome").one_of(challenge_outcome, "\"accepted\", \"declined\" or \"expired\"")};
}

GameStart<Received> read_start(const JsonNode& node) {
  return {read_terms(node), read_state(node.at("state"))};
}

GameSnapshot<Received> read_snapshot(const JsonNode& node) {
  return {read_terms(node), read_state(node.at("state")), read_clock(node.at("clocks"))};
}

GameTurn<Received> read_game_turn(const JsonNode& node) {
  GameTurn<Received> turn;
  turn.game = read_id<GameId>(node.at("game"));
  turn.turn = read_turn(node.at("turn"));
  turn.kind = read_turn_kind(node.at("kind"));
  turn.state = read_state(node.at("state"));
  turn.clock = read_clock(node.at("clock"));
  turn.legal = read_legal(node.at("legal"));
  turn.refusals = node.at("refusals").integer<std::uint32_t>();
  return turn;
}

GameShot<Received> read_game_shot(const JsonNode& node) {
  GameShot<Received> shot;
  read_move(node, shot);
  const JsonNode id = node.at("shot_id");
  shot.shot_id.json = id.value() == nullptr ? "" : canonical_text(*id.value());
  if (const auto call = node.find("call")) {
    shot.call = read_call(*call);
  }
  if (const auto place = node.find("cue_ball")) {
    shot.cue_ball = read_point(*place);
  }
  shot.intended = read_shot_params(node.at("intended"));
  shot.executed = read_shot_params(node.at("executed"));
  shot.moved = node.at("moved").boolean();
  shot.ruling = read_ruling(node.at("ruling"));
  shot.events = read_events(node.at("events"));
  shot.state = read_state(node.at("state"));
  shot.clock = read_clock(node.at("clock"));
  return shot;
}

GameDecision<Received> read_game_decision(const JsonNode& node) {
  GameDecision<Received> decision;
  read_move(node, decision);
  decision.choice = read_decision(node.at("choice"));
  decision.state = read_state(node.at("state"));
  decision.clock = read_clock(node.at("clock"));
  return decision;
}

GameTurnLost<Received> read_turn_lost(const JsonNode& node) {
  GameTurnLost<Received> lost;
  read_move(node, lost);
  lost.ruling = read_ruling(node.at("ruling"));
  lost.state = read_state(node.at("state"));
  lost.clock = read_clock(node.at("clock"));
  return lost;
}

GameOver read_game_over(const JsonNode& node) {
  GameOver over;
  over.game = read_id<GameId>(node.at("game"));
  over.match = read_id<MatchId>(node.at("match"));
  if (const auto winner = node.find("winner")) {
    over.winner = read_seat(*winner);
  }
  over.reason = node.at("reason").one_of(rules::end_reason, "the name of an end reason");
  over.scored = node.at("scored").boolean();
  over.checksum.text = node.at("checksum").string();
  return over;
}

MatchOver read_match_over(const JsonNode& node) {
  MatchOver over;
  over.match = read_id<MatchId>(node.at("match"));
  over.tournament = read_tournament(node);
  over.opponent = node.at("opponent").string();
  over.own_points = node.at("own_points").number();
  over.opponent_points = node.at("opponent_points").number();
  for (const JsonNode& seeds : node.at("seeds").elements()) {
    over.seeds.push_back({read_id<GameId>(seeds.at("game")), Hex256{seeds.at("key").string()},
                          seeds.at("rack_seed").integer<std::uint64_t>(),
                          read_hex_pair(seeds.at("agent_secrets"))});
  }
  return over;
}

StandingRow read_standing(const JsonNode& node) {
  return {node.at("rank").integer<std::uint32_t>(),
          node.at("agent").string(),
          node.at("points").number(),
          node.at("games").integer<std::uint32_t>(),
          node.at("wins").integer<std::uint32_t>(),
          node.at("losses").integer<std::uint32_t>(),
          node.at("draws").integer<std::uint32_t>()};
}

TournamentOver read_tournament_over(const JsonNode& node) {
  TournamentOver over{read_id<TournamentId>(node.at("tournament")), node.at("name").string(), {}};
  for (const JsonNode& row : node.at("standings").elements()) {
    over.standings.push_back(read_standing(row));
  }
  return over;
}

Limits read_limits(const JsonNode& node) {
  Limits limits;
  const auto bytes = [&](std::string_view key) { return node.at(key).integer<std::size_t>(); };
  const auto count = [&](std::string_view key) { return node.at(key).integer<std::uint32_t>(); };
  const auto time = [&](std::string_view key) {
    return std::chrono::milliseconds(node.at(key).integer<std::int64_t>(0, 1'000'000'000'000));
  };
  limits.line_bytes = bytes("line_bytes");
  limits.line_bytes_before_login = bytes("line_bytes_before_login");
  limits.server_line_bytes = bytes("server_line_bytes");
  limits.nesting = bytes("nesting");
  limits.keys = bytes("keys");
  limits.login_deadline = time("login_ms");
  limits.line_deadline = time("line_ms");
  limits.messages_per_second = node.at("messages_per_second").number();
  limits.message_burst = node.at("message_burst").number();
  limits.bad_lines_in_a_row = count("bad_lines_in_a_row");
  limits.connections_per_address = count("connections_per_address");
  limits.output_queue_bytes = bytes("output_queue_bytes");
  limits.name_length = bytes("name_length");
  limits.shot_id_length = bytes("shot_id_length");
  limits.max_refusals = count("max_refusals");
  limits.challenge_expiry = time("challenge_expiry_ms");
  limits.reveal_deadline = time("reveal_ms");
  limits.lag_credit_per_turn = time("lag_credit_per_turn_ms");
  limits.lag_credit_per_game = time("lag_credit_per_game_ms");
  return limits;
}

HelloReply read_hello_reply(const JsonNode& node) {
  HelloReply reply;
  reply.protocol = node.at("protocol").integer<int>(0);
  reply.server = {node.at("server").at("name").string(), node.at("server").at("version").string()};
  reply.session = node.at("session").string();
  reply.limits = read_limits(node.at("limits"));
  reply.rules_version = node.at("rules_version").string();
  reply.physics_version = node.at("physics_version").string();
  reply.time_ms = node.at("time_ms").integer<std::int64_t>();
  return reply;
}

LoginReply read_login_reply(const JsonNode& node) {
  LoginReply reply{node.at("agent").string(), {}, {}};
  if (const auto token = node.find("token")) {
    reply.token = Hex256{token->string()};
  }
  for (const JsonNode& game : node.at("games").elements()) {
    reply.games.push_back({read_id<GameId>(game.at("game")), read_id<MatchId>(game.at("match")),
                           read_tournament(game), read_seat(game.at("seat")),
                           game.at("opponent").string(),
                           game.at("status").one_of(game_status, "\"running\" or \"over\"")});
  }
  return reply;
}

TournamentListReply read_tournament_list(const JsonNode& node) {
  TournamentListReply reply;
  for (const JsonNode& entry : node.at("tournaments").elements()) {
    TournamentListing& listing = reply.tournaments.emplace_back();
    listing.tournament = read_id<TournamentId>(entry.at("tournament"));
    listing.name = entry.at("name").string();
    listing.status = entry.at("status").one_of(
        tournament_status, "\"open\", \"running\", \"paused\", \"over\" or \"aborted\"");
    listing.rules = read_rules(entry.at("rules"));
    listing.format = entry.at("format").string();
    for (const JsonNode& agent : entry.at("agents").elements()) {
      listing.agents.push_back(agent.string());
    }
  }
  return reply;
}

TournamentReply read_tournament_reply(const JsonNode& node) {
  return {read_id<TournamentId>(node.at("tournament")),
          node.at("membership").one_of(membership, "\"joined\" or \"left\"")};
}

ChallengeReply read_challenge_reply(const JsonNode& node) {
  ChallengeReply reply{
      read_id<ChallengeId>(node.at("challenge")),
      node.at("status").one_of(challenge_status, "\"offered\", \"accepted\" or \"declined\""),
      {}};
  if (const auto match = node.find("match")) {
    reply.match = read_id<MatchId>(*match);
  }
  return reply;
}

Repetition read_repetition(const JsonNode& node) {
  return node.at("duplicate").boolean() ? Repetition::duplicate : Repetition::first_time;
}

SyncReply<Received> read_sync_reply(const JsonNode& node) {
  SyncReply<Received> reply{read_snapshot(node), {}, {}};
  if (const auto pending = node.find("pending")) {
    reply.pending = read_game_turn(*pending);
  }
  if (const auto over = node.find("over")) {
    reply.over = read_game_over(*over);
  }
  return reply;
}

PingReply read_ping_reply(const JsonNode& node) {
  const auto t = node.find("t");
  return {RawJson{t ? canonical_text(*t->value()) : "null"},
          node.at("time_ms").integer<std::int64_t>()};
}

// One reader for each alternative of Notification, in their order.
using ReadNotification = Notification<Received> (*)(const JsonNode&);
template <auto read>
constexpr ReadNotification as_notification =
    [](const JsonNode& node) -> Notification<Received> { return read(node); };
Superseded read_superseded(const JsonNode&) {
  return {};
}
LagProbe read_lag_probe(const JsonNode& node) {
  return {node.at("t").integer<std::int64_t>()};
}
ShuttingDown read_shutting_down(const JsonNode& node) {
  return {node.at("reason").string()};
}

constexpr std::array<ReadNotification, notification_count> notification_readers{
    as_notification<read_offer>,           as_notification<read_challenge_over>,
    as_notification<read_start>,           as_notification<read_snapshot>,
    as_notification<read_game_turn>,       as_notification<read_game_shot>,
    as_notification<read_game_decision>,   as_notification<read_turn_lost>,
    as_notification<read_game_over>,       as_notification<read_match_over>,
    as_notification<read_tournament_over>, as_notification<read_superseded>,
    as_notification<read_lag_probe>,       as_notification<read_shutting_down>};

AckReply read_ack_reply(const JsonNode& node) {
  if (const auto match = node.find("match")) {
    return {read_id<MatchId>(*match)};
  }
  if (const auto tournament = node.find("tournament")) {
    return {read_id<TournamentId>(*tournament)};
  }
  return {read_id<GameId>(node.at("game"))};
}

}  // namespace

Notification<Received> read_notification(std::size_t index, const JsonNode& params) {
  return notification_readers[index](params);
}

Reply<Received> read_reply(Method method, const JsonNode& result) {
  switch (method) {
    case Method::hello:
      return read_hello_reply(result);
    case Method::register_agent:
    case Method::login:
      return read_login_reply(result);
    case Method::tournament_list:
      return read_tournament_list(result);
    case Method::tournament_join:
    case Method::tournament_leave:
      return read_tournament_reply(result);
    case Method::challenge:
    case Method::challenge_accept:
    case Method::challenge_decline:
      return read_challenge_reply(result);
    case Method::shot:
      return ShotReply<Received>{read_game_shot(result), read_repetition(result)};
    case Method::decide:
      return DecideReply<Received>{read_game_decision(result), read_repetition(result)};
    case Method::ack:
      return read_ack_reply(result);
    case Method::concede:
    case Method::game_reveal:
      return GameReply{read_id<GameId>(result.at("game"))};
    case Method::sync:
      return read_sync_reply(result);
    case Method::ping:
      return read_ping_reply(result);
    case Method::lag:
    case Method::game_ready:
      break;
  }
  return EmptyReply{};
}

}  // namespace poolhall::protocol
