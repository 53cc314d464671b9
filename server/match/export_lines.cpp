#include "server/match/export_lines.hpp"

#include <algorithm>

#include "protocol/json_writer.hpp"
#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"

namespace poolhall::match {
namespace {

using protocol::JsonWriter;
using storage::Expected;

enum class Secrets : std::uint8_t { kept, revealed };

void write_optional(JsonWriter& out, const char* key, const std::optional<std::string>& text) {
  out.key(key);
  if (text)
    out.string(*text);
  else
    out.null();
}

void write_result(JsonWriter& out, const std::optional<rules::GameResult>& result) {
  out.key("winner");
  if (result && result->winner)
    out.integer(index(*result->winner));
  else
    out.null();
  out.key("reason");
  if (result)
    out.string(rules::name(result->reason));
  else
    out.null();
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
  const bool is_told = secrets == Secrets::revealed || !terms.noise_hidden;
  out.key("noise").string(is_told ? terms.noise : "hidden");
  out.key("noise_hidden").boolean(terms.noise_hidden);
  out.key("rack_gap").number(terms.rack_gap).key("rack_jitter").number(terms.rack_jitter);
  out.key("clock_us").integer(std::int64_t{terms.clock.count()});
  out.key("increment_us").integer(std::int64_t{terms.increment.count()}).key("shot_cap_us");
  if (terms.shot_cap)
    out.integer(std::int64_t{terms.shot_cap->count()});
  else
    out.null();
  out.key("max_refusals").integer(terms.max_refusals).end_object();
}

std::string tournament_line(const storage::TournamentRecord& tournament,
                            const std::vector<storage::EntryRecord>& entries) {
  JsonWriter out;
  out.begin_object().key("tournament").begin_object().key("id").string(tournament.id);
  out.key("title").string(tournament.title).key("status").string(name(tournament.status));
  out.key("settings").string(tournament.settings).key("entries").begin_array();
  for (const storage::EntryRecord& entry : entries) {
    out.begin_object().key("agent").integer(number(entry.agent)).key("place").integer(entry.place);
    out.key("withdrawn").boolean(entry.withdrawn).end_object();
  }
  out.end_array().end_object().end_object();
  return std::move(out).text();
}

std::string match_line(const storage::MatchRecord& match, Secrets secrets) {
  JsonWriter out;
  out.begin_object().key("match").begin_object().key("id").integer(protocol::number(match.id));
  write_optional(out, "tournament", match.tournament);
  out.key("pairing");
  if (match.pairing)
    out.integer(*match.pairing);
  else
    out.null();
  write_agents(out, match.agents);
  out.key("games").integer(match.games).key("over").boolean(match.over);
  write_terms(out, match.terms, secrets);
  out.end_object().end_object();
  return std::move(out).text();
}

std::string game_line(const storage::GameRecord& game, Secrets secrets) {
  const bool is_revealed = secrets == Secrets::revealed;
  JsonWriter out;
  out.begin_object().key("game").begin_object().key("id").integer(protocol::number(game.id));
  out.key("match").integer(protocol::number(game.match)).key("number").integer(game.number);
  out.key("attempt").integer(game.attempt);
  write_agents(out, game.agents);
  out.key("breaker").integer(index(game.breaker));
  write_terms(out, game.terms, secrets);
  out.key("rack_seed").integer(game.rack_seed);
  if (is_revealed || !game.terms.noise_hidden)
    write_five(out, "noise", game.noise);
  else
    out.key("noise").null();
  write_optional(out, "key", is_revealed ? std::optional(to_hex(game.key)) : std::nullopt);
  out.key("commitment").string(to_hex(game.commitment));
  out.key("initial_state").raw(game.initial_state);
  out.key("physics_version").string(game.physics_version);
  out.key("rules_version").string(game.rules_version).key("over").boolean(game.over);
  write_result(out, game.result);
  out.key("turns").integer(game.turns).key("checksum").string(to_hex(game.head));
  out.end_object().end_object();
  return std::move(out).text();
}

void write_shot(JsonWriter& out, const storage::ShotPart& shot) {
  out.begin_object().key("index").integer(shot.index);
  write_five(out, "intended", shot.intended);
  write_five(out, "executed", shot.executed);
  out.key("moved").boolean(shot.moved).key("cue_ball");
  if (shot.cue_ball)
    out.begin_object()
        .key("x")
        .number(shot.cue_ball->x)
        .key("y")
        .number(shot.cue_ball->y)
        .end_object();
  else
    out.null();
  out.key("call").raw(protocol::encode_call(shot.call)).end_object();
}

void write_clock(JsonWriter& out, const storage::ClockPart& clock) {
  out.key("clock").begin_object().key("used_us").integer(std::int64_t{clock.used.count()});
  out.key("forgiven_us").integer(std::int64_t{clock.forgiven.count()}).key("left_us");
  out.begin_array().integer(std::int64_t{clock.left[0].count()});
  out.integer(std::int64_t{clock.left[1].count()}).end_array().end_object();
}

std::string turn_line(const storage::TurnRecord& turn) {
  JsonWriter out;
  out.begin_object().key("turn").begin_object().key("game").integer(protocol::number(turn.game));
  out.key("turn").integer(turn.number).key("action").string(name(turn.action));
  out.key("seat").integer(index(turn.seat)).key("shot_id");
  out.raw(turn.request ? turn.request->json : "null").key("shot");
  if (turn.shot)
    write_shot(out, *turn.shot);
  else
    out.null();
  write_optional(
      out, "decision",
      turn.decision ? std::optional(std::string(rules::name(*turn.decision))) : std::nullopt);
  out.key("refusals").integer(turn.refusals);
  write_clock(out, turn.clock);
  out.key("physics_version").string(turn.physics_version);
  out.key("rules_version").string(turn.rules_version);
  write_result(out, turn.result);
  out.key("checksum").string(to_hex(turn.checksum)).key("state_before").raw(turn.state_before);
  out.key("ruling").raw(turn.ruling.value_or("null"));
  out.key("events").raw(turn.shot ? turn.shot->events : "null");
  out.key("state_after").raw(turn.state_after).end_object().end_object();
  return std::move(out).text();
}

using Line = std::function<void(const std::string&)>;

Expected<void> export_agents_and_tournaments(storage::Reader& reader, const Line& line) {
  const auto agents = reader.agents();
  if (!agents)
    return tl::unexpected(agents.error());
  for (const storage::AgentRecord& agent : *agents) {
    JsonWriter out;
    out.begin_object().key("agent").begin_object().key("id").integer(number(agent.id));
    line(std::move(out.key("name").string(agent.name).end_object().end_object()).text());
  }
  const auto tournaments = reader.tournaments();
  if (!tournaments)
    return tl::unexpected(tournaments.error());
  for (const storage::TournamentRecord& tournament : *tournaments) {
    const auto entries = reader.entries(tournament.id);
    if (!entries)
      return tl::unexpected(entries.error());
    line(tournament_line(tournament, *entries));
  }
  return {};
}

Expected<void> export_match(storage::Reader& reader, const storage::MatchRecord& match,
                            const Line& line) {
  const Secrets secrets = match.over ? Secrets::revealed : Secrets::kept;
  line(match_line(match, secrets));
  const auto games = reader.games_of(match.id);
  if (!games)
    return tl::unexpected(games.error());
  for (const storage::GameRecord& game : *games) {
    line(game_line(game, secrets));
    const auto done = reader.each_turn(game.id, [&](const storage::TurnRecord& turn) {
      line(turn_line(turn));
      return true;
    });
    if (!done)
      return done;
  }
  return {};
}

}  // namespace

Expected<void> export_lines(storage::Reader& reader, const Line& line) {
  line(R"({"export":{"format":1}})");
  if (auto done = export_agents_and_tournaments(reader, line); !done)
    return done;
  const auto counters = reader.counters();
  if (!counters)
    return tl::unexpected(counters.error());
  for (std::int64_t id = 1; id < protocol::number(counters->match); ++id) {
    const auto match = reader.match(protocol::MatchId{id});
    if (!match)
      return tl::unexpected(match.error());
    if (!*match)
      continue;
    Expected<void> done;
    const auto read = reader.consistently([&] { done = export_match(reader, **match, line); });
    if (!read || !done)
      return read ? done : read;
  }
  return {};
}

}  // namespace poolhall::match
