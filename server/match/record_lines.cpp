#include "server/match/record_lines.hpp"

#include "protocol/json_writer.hpp"
#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"

namespace poolhall::match {
namespace {

using protocol::JsonWriter;
using storage::Digest;

void write_text(JsonWriter& out, const char* key, const std::optional<std::string>& text) {
  out.key(key).string_or_null(text);
}

template <class Integer>
void write_integer(JsonWriter& out, const char* key, const std::optional<Integer>& value) {
  out.key(key).integer_or_null(value);
}

void write_digest(JsonWriter& out, const char* key, const std::optional<Digest>& digest) {
  write_text(out, key, digest ? std::optional(to_hex(*digest)) : std::nullopt);
}

void write_digests(JsonWriter& out, const char* key,
                   const std::array<std::optional<Digest>, 2>& digests) {
  out.key(key).begin_array();
  for (const std::optional<Digest>& digest : digests)
    out.string_or_null(digest ? std::optional(to_hex(*digest)) : std::nullopt);
  out.end_array();
}

void write_date(JsonWriter& out, const char* key, const std::optional<storage::UnixMicros>& date) {
  write_integer(out, key, date ? std::optional(number(*date)) : std::nullopt);
}

std::int64_t count(storage::Micros time) {
  return time.count();
}

void write_result(JsonWriter& out, const std::optional<rules::GameResult>& result) {
  std::optional<std::size_t> winner;
  std::optional<std::string> reason;
  if (result) {
    reason = rules::name(result->reason);
    if (result->winner)
      winner = index(*result->winner);
  }
  write_integer(out, "winner", winner);
  write_text(out, "reason", reason);
}

void write_agents(JsonWriter& out, const std::array<storage::AgentId, 2>& agents) {
  out.key("agents").begin_array();
  out.integer(number(agents[0])).integer(number(agents[1])).end_array();
}

template <class FiveNumbers>
void write_five(JsonWriter& out, const char* key, const FiveNumbers& five) {
  out.key(key).begin_object().key("a").number(five.a).key("b").number(five.b);
  out.key("theta").number(five.theta).key("phi").number(five.phi).key("v").number(five.v);
  out.end_object();
}

void write_terms(JsonWriter& out, const storage::TermsRecord& terms, Secrets secrets) {
  out.key("terms").begin_object().key("rules").string(rules::name(terms.rules));
  out.key("table").string(terms.table).key("materials").string(terms.materials);
  out.key("noise").string(tells_level(terms, secrets) ? terms.noise : "hidden");
  out.key("noise_hidden").boolean(terms.noise_hidden);
  out.key("rack_gap").number(terms.rack_gap).key("rack_jitter").number(terms.rack_jitter);
  out.key("clock_us").integer(count(terms.clock));
  out.key("increment_us").integer(count(terms.increment));
  write_integer(out, "shot_cap_us",
                terms.shot_cap ? std::optional(count(*terms.shot_cap)) : std::nullopt);
  out.key("max_refusals").integer(terms.max_refusals);
  out.key("lag_per_turn_us").integer(count(terms.lag_per_turn));
  out.key("lag_per_game_us").integer(count(terms.lag_per_game)).end_object();
}

void write_entry(JsonWriter& out, const storage::EntryRecord& entry) {
  out.begin_object().key("agent").integer(number(entry.agent)).key("place").integer(entry.place);
  out.key("from_round").integer(entry.from_round).key("until_round");
  out.integer_or_null(entry.until_round);
  write_text(out, "house_bot", entry.house_bot);
  out.key("house_options").begin_array();
  for (const std::string& option : entry.house_options)
    out.string(option);
  out.end_array();
  write_text(out, "command", entry.command);
  out.end_object();
}

void write_shot(JsonWriter& out, const storage::ShotPart& shot) {
  out.begin_object().key("index").integer(shot.index).key("shared").boolean(shot.shared);
  write_five(out, "intended", shot.intended);
  write_five(out, "executed", shot.executed);
  out.key("moved").boolean(shot.moved).key("cue_ball");
  if (shot.cue_ball) {
    out.begin_object().key("x").number(shot.cue_ball->x);
    out.key("y").number(shot.cue_ball->y).end_object();
  } else {
    out.null();
  }
  out.key("call").raw(protocol::encode_call(shot.call)).end_object();
}

void write_clock(JsonWriter& out, const storage::ClockPart& clock) {
  out.key("clock").begin_object().key("used_us").integer(count(clock.used));
  out.key("forgiven_us").integer(count(clock.forgiven)).key("left_us").begin_array();
  out.integer(count(clock.left[0])).integer(count(clock.left[1])).end_array();
  out.key("lag_left_us").begin_array().integer(count(clock.lag_left[0]));
  out.integer(count(clock.lag_left[1])).end_array().end_object();
}

}  // namespace

std::string header_line() {
  JsonWriter out;
  out.begin_object().key("export").begin_object().key("format").integer(export_format);
  return std::move(out.end_object().end_object()).text();
}

std::string line_of(const storage::AgentRecord& agent) {
  JsonWriter out;
  out.begin_object().key("agent").begin_object().key("id").integer(number(agent.id));
  out.key("name").string(agent.name);
  write_text(out, "house_bot", agent.house_bot);
  write_date(out, "created", agent.created);
  return std::move(out.end_object().end_object()).text();
}

// The settings of a tournament that goes on may say what is hidden.
std::string line_of(const TournamentWithEntries& what) {
  const storage::TournamentRecord& tournament = what.tournament;
  JsonWriter out;
  out.begin_object().key("tournament").begin_object().key("id").string(tournament.id);
  out.key("wire_id").integer(protocol::number(tournament.wire_id));
  out.key("title").string(tournament.title).key("status").string(name(tournament.status));
  write_text(out, "settings",
             is_over(tournament.status) ? std::optional(tournament.settings) : std::nullopt);
  write_date(out, "created", tournament.created);
  out.key("entries").begin_array();
  for (const storage::EntryRecord& entry : what.entries)
    write_entry(out, entry);
  return std::move(out.end_array().end_object().end_object()).text();
}

std::string line_of(const storage::MatchRecord& match, Secrets secrets) {
  JsonWriter out;
  out.begin_object().key("match").begin_object().key("id").integer(protocol::number(match.id));
  write_text(out, "tournament", match.tournament);
  write_integer(out, "pairing", match.pairing);
  write_text(out, "request", match.request);
  write_integer(out, "challenge",
                match.challenge ? std::optional(protocol::number(*match.challenge)) : std::nullopt);
  write_agents(out, match.agents);
  out.key("games").integer(match.games);
  write_terms(out, match.terms, secrets);
  write_integer(out, "seed", tells_keys(secrets) ? std::optional(match.seed) : std::nullopt);
  out.key("mirrored").string(name(match.mirrored)).key("over").boolean(match.over);
  write_date(out, "created", match.created);
  write_date(out, "finished", match.finished);
  write_digest(out, "seal", match.seal);
  return std::move(out.end_object().end_object()).text();
}

std::string line_of(const storage::GameRecord& game, Secrets secrets) {
  const bool is_revealed = tells_keys(secrets);
  JsonWriter out;
  out.begin_object().key("game").begin_object().key("id").integer(protocol::number(game.id));
  out.key("match").integer(protocol::number(game.match)).key("number").integer(game.number);
  out.key("attempt").integer(game.attempt);
  write_agents(out, game.agents);
  write_terms(out, game.terms, secrets);
  out.key("breaker").integer(index(game.breaker)).key("rack_seed").integer(game.rack_seed);
  write_digest(out, "key", is_revealed ? std::optional(game.key) : std::nullopt);
  if (tells_level(game.terms, secrets))
    write_five(out, "noise", game.noise);
  else
    out.key("noise").null();
  out.key("commitment").string(to_hex(game.commitment));
  write_digests(out, "agent_commitments", game.agent_commitments);
  write_digests(out, "agent_secrets",
                is_revealed ? game.agent_secrets : std::array<std::optional<Digest>, 2>{});
  write_integer(
      out, "shared_from",
      game.shared_from ? std::optional(protocol::number(*game.shared_from)) : std::nullopt);
  out.key("physics_version").string(game.physics_version);
  out.key("rules_version").string(game.rules_version);
  write_date(out, "created", game.created);
  out.key("over").boolean(game.over);
  write_result(out, game.result);
  out.key("turns").integer(game.turns).key("checksum").string(to_hex(game.head));
  out.key("acknowledged").begin_array().boolean(game.acknowledged[0]);
  out.boolean(game.acknowledged[1]).end_array();
  write_date(out, "finished", game.finished);
  // Before its time the seal would be a hint: it covers the key.
  write_digest(out, "seal", is_revealed ? std::optional(game.seal) : std::nullopt);
  out.key("initial_state").raw(game.initial_state);
  return std::move(out.end_object().end_object()).text();
}

std::string line_of(const storage::TurnRecord& turn) {
  JsonWriter out;
  out.begin_object().key("turn").begin_object().key("game").integer(protocol::number(turn.game));
  out.key("turn").integer(turn.number).key("action").string(name(turn.action));
  out.key("seat").integer(index(turn.seat)).key("shot_id");
  out.raw(turn.request ? turn.request->json : "null").key("shot");
  if (turn.shot)
    write_shot(out, *turn.shot);
  else
    out.null();
  write_text(
      out, "decision",
      turn.decision ? std::optional(std::string(rules::name(*turn.decision))) : std::nullopt);
  out.key("refusals").integer(turn.refusals);
  write_clock(out, turn.clock);
  write_date(out, "stored", turn.stored);
  out.key("physics_version").string(turn.physics_version);
  out.key("rules_version").string(turn.rules_version);
  write_result(out, turn.result);
  out.key("checksum").string(to_hex(turn.checksum)).key("state_before").raw(turn.state_before);
  out.key("ruling").raw(turn.ruling.value_or("null"));
  out.key("events").raw(turn.shot ? turn.shot->events : "null");
  return std::move(out.key("state_after").raw(turn.state_after).end_object().end_object()).text();
}

}  // namespace poolhall::match
