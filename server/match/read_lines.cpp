// The reading half of record_lines.hpp.
#include <algorithm>
#include <initializer_list>
#include <utility>

#include "protocol/json_node.hpp"
#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"
#include "server/match/record_lines.hpp"
#include "server/match/secrets.hpp"

namespace poolhall::match {
namespace {

using protocol::JsonNode;
using storage::Digest;

// The text of each member of the one object in a line that is known to be JSON. Texts are part of
// checksums, so they are taken as they stand, not written anew.
class RawMembers {
 public:
  explicit RawMembers(std::string_view line) : line_(line) {
    std::size_t at = line_.find('{', line_.find('{') + 1);
    while (at < line_.size() && line_[at] != '}') {
      const std::size_t key = line_.find('"', at + 1);
      const std::size_t key_end = end_of_value(key);
      const std::size_t value = line_.find_first_not_of(" \t\r\n:", key_end);
      const std::size_t value_end = end_of_value(value);
      members_.emplace_back(line_.substr(key + 1, key_end - key - 2),
                            line_.substr(value, value_end - value));
      at = line_.find_first_of(",}", value_end);
    }
  }

  [[nodiscard]] std::string text(std::string_view key) const {
    const auto member = std::find_if(members_.begin(), members_.end(),
                                     [key](const auto& entry) { return entry.first == key; });
    return member == members_.end() ? "null" : std::string(member->second);
  }

 private:
  // Behind a string, a number, a word, or a whole array or object.
  [[nodiscard]] std::size_t end_of_value(std::size_t at) const {
    int depth = 0;
    bool in_string = false;
    for (; at < line_.size(); ++at) {
      const char c = line_[at];
      if (in_string) {
        at += c == '\\' ? 1 : 0;
        in_string = c != '"';
        if (!in_string && depth == 0)
          return at + 1;
      } else if (c == '"') {
        in_string = true;
      } else if (c == '{' || c == '[') {
        ++depth;
      } else if (c == '}' || c == ']') {
        if (depth == 0)
          return at;
        if (--depth == 0)
          return at + 1;
      } else if (depth == 0 && (c == ',' || c == ' ')) {
        return at;
      }
    }
    return at;
  }

  std::string_view line_;
  std::vector<std::pair<std::string_view, std::string_view>> members_;
};

bool is_hex_digit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

Digest read_digest(const JsonNode& node) {
  const std::string text = node.string();
  if (text.size() != 64 || !std::all_of(text.begin(), text.end(), is_hex_digit))
    node.refuse("expected 64 hexadecimal digits");
  return digest_of(text);
}

std::optional<Digest> read_optional_digest(const JsonNode& parent, const char* key) {
  const auto node = parent.nullable(key);
  return node ? std::optional(read_digest(*node)) : std::nullopt;
}

std::array<std::optional<Digest>, 2> read_digests(const JsonNode& node) {
  std::array<std::optional<Digest>, 2> digests;
  const std::vector<JsonNode> elements = node.elements(2);
  for (std::size_t i = 0; i < elements.size() && i < 2; ++i) {
    if (elements[i].value() != nullptr && !elements[i].value()->is_null())
      digests[i] = read_digest(elements[i]);
  }
  return digests;
}

std::optional<std::string> read_optional_text(const JsonNode& parent, const char* key) {
  const auto node = parent.nullable(key);
  return node ? std::optional(node->string()) : std::nullopt;
}

template <class Id>
Id read_id(const JsonNode& node) {
  return Id{node.integer<std::int64_t>(1)};
}

storage::UnixMicros read_date(const JsonNode& node) {
  return storage::UnixMicros{node.integer<std::int64_t>()};
}

std::optional<storage::UnixMicros> read_optional_date(const JsonNode& parent, const char* key) {
  const auto node = parent.nullable(key);
  return node ? std::optional(read_date(*node)) : std::nullopt;
}

storage::Micros read_micros(const JsonNode& node) {
  return storage::Micros{node.integer<std::int64_t>()};
}

std::array<storage::Micros, 2> read_two_micros(const JsonNode& node) {
  const std::vector<JsonNode> elements = node.elements(2);
  if (elements.size() != 2)
    return {};
  return {read_micros(elements[0]), read_micros(elements[1])};
}

rules::Seat read_seat(const JsonNode& node) {
  return node.integer<int>(0, 1) == 1 ? rules::Seat::second : rules::Seat::first;
}

std::array<storage::AgentId, 2> read_agents(const JsonNode& node) {
  const std::vector<JsonNode> elements = node.elements(2);
  if (elements.size() != 2)
    return {};
  return {read_id<storage::AgentId>(elements[0]), read_id<storage::AgentId>(elements[1])};
}

std::optional<rules::GameResult> read_result(const JsonNode& node) {
  const auto reason = node.nullable("reason");
  const auto winner = node.nullable("winner");
  if (!reason) {
    if (winner)
      winner->refuse("expected null, since there is no reason of an end");
    return std::nullopt;
  }
  rules::GameResult result;
  result.reason = reason->one_of(rules::end_reason, "the name of an end reason");
  if (winner)
    result.winner = read_seat(*winner);
  return result;
}

template <class FiveNumbers>
FiveNumbers read_five(const JsonNode& node) {
  FiveNumbers five{};
  five.a = node.at("a").number();
  five.b = node.at("b").number();
  five.theta = node.at("theta").number();
  five.phi = node.at("phi").number();
  five.v = node.at("v").number();
  return five;
}

storage::TermsRecord read_terms(const JsonNode& node) {
  storage::TermsRecord terms;
  terms.rules = node.at("rules").one_of(rules::rule_set, "the name of a rule set");
  terms.table = node.at("table").string();
  terms.materials = node.at("materials").string();
  terms.noise = node.at("noise").string();
  if (terms.noise == "hidden")
    node.at("noise").refuse("got \"hidden\": the level was not told yet when this was exported");
  terms.noise_hidden = node.at("noise_hidden").boolean();
  terms.rack_gap = node.at("rack_gap").number();
  terms.rack_jitter = node.at("rack_jitter").number();
  terms.clock = read_micros(node.at("clock_us"));
  terms.increment = read_micros(node.at("increment_us"));
  if (const auto cap = node.nullable("shot_cap_us"))
    terms.shot_cap = read_micros(*cap);
  terms.max_refusals = node.at("max_refusals").integer<std::uint32_t>();
  terms.lag_per_turn = read_micros(node.at("lag_per_turn_us"));
  terms.lag_per_game = read_micros(node.at("lag_per_game_us"));
  return terms;
}

storage::AgentRecord read_agent(const JsonNode& node) {
  storage::AgentRecord agent;
  agent.id = read_id<storage::AgentId>(node.at("id"));
  agent.name = node.at("name").string();
  agent.house_bot = read_optional_text(node, "house_bot");
  agent.created = read_date(node.at("created"));
  return agent;
}

storage::EntryRecord read_entry(const JsonNode& node, const std::string& tournament) {
  storage::EntryRecord entry;
  entry.tournament = tournament;
  entry.agent = read_id<storage::AgentId>(node.at("agent"));
  entry.place = node.at("place").integer<std::uint32_t>();
  entry.from_round = node.at("from_round").integer<std::uint32_t>();
  if (const auto until = node.nullable("until_round"))
    entry.until_round = until->integer<std::uint32_t>();
  entry.house_bot = read_optional_text(node, "house_bot");
  for (const JsonNode& option : node.at("house_options").elements())
    entry.house_options.push_back(option.string());
  entry.command = read_optional_text(node, "command");
  return entry;
}

TournamentWithEntries read_tournament(const JsonNode& node) {
  TournamentWithEntries what;
  what.tournament.id = node.at("id").string();
  what.tournament.wire_id = read_id<protocol::TournamentId>(node.at("wire_id"));
  what.tournament.title = node.at("title").string();
  what.tournament.status =
      node.at("status").one_of(storage::tournament_status, "a tournament's status");
  if (!is_over(what.tournament.status))
    node.at("status").refuse("tournament \"" + what.tournament.id + "\" is unfinished (" +
                             std::string(name(what.tournament.status)) +
                             "), expected one that is over");
  what.tournament.settings = node.at("settings").string();
  what.tournament.created = read_date(node.at("created"));
  for (const JsonNode& entry : node.at("entries").elements())
    what.entries.push_back(read_entry(entry, what.tournament.id));
  return what;
}

// Seeds of matches use all 64 bits.
std::uint64_t read_seed(const JsonNode& node) {
  if (node.value() != nullptr) {
    if (const auto* large = node.value()->as<std::uint64_t>())
      return *large;
  }
  return static_cast<std::uint64_t>(node.integer<std::int64_t>(0));
}

storage::MatchRecord read_match(const JsonNode& node) {
  storage::MatchRecord match;
  match.id = read_id<protocol::MatchId>(node.at("id"));
  match.tournament = read_optional_text(node, "tournament");
  if (const auto pairing = node.nullable("pairing"))
    match.pairing = pairing->integer<std::uint32_t>();
  match.request = read_optional_text(node, "request");
  if (const auto challenge = node.nullable("challenge"))
    match.challenge = read_id<protocol::ChallengeId>(*challenge);
  match.agents = read_agents(node.at("agents"));
  match.games = node.at("games").integer<std::uint32_t>();
  match.terms = read_terms(node.at("terms"));
  match.seed = read_seed(node.at("seed"));
  match.mirrored = node.at("mirrored").one_of(storage::mirror, "none, rack or noise");
  match.over = node.at("over").boolean();
  if (!match.over)
    node.at("over").refuse("got false: matches that go on cannot be imported");
  match.created = read_date(node.at("created"));
  match.finished = read_optional_date(node, "finished");
  match.seal = read_optional_digest(node, "seal");
  return match;
}

storage::GameRecord read_game(const JsonNode& node, const RawMembers& raw) {
  storage::GameRecord game;
  game.id = read_id<protocol::GameId>(node.at("id"));
  game.match = read_id<protocol::MatchId>(node.at("match"));
  game.number = node.at("number").integer<std::uint32_t>();
  game.attempt = node.at("attempt").integer<std::uint32_t>();
  game.agents = read_agents(node.at("agents"));
  game.terms = read_terms(node.at("terms"));
  game.breaker = read_seat(node.at("breaker"));
  game.rack_seed = read_seed(node.at("rack_seed"));
  game.key = read_digest(node.at("key"));
  game.noise = read_five<protocol::NoiseParams>(node.at("noise"));
  game.commitment = read_digest(node.at("commitment"));
  game.agent_commitments = read_digests(node.at("agent_commitments"));
  game.agent_secrets = read_digests(node.at("agent_secrets"));
  if (const auto first = node.nullable("shared_from"))
    game.shared_from = read_id<protocol::GameId>(*first);
  game.physics_version = node.at("physics_version").string();
  game.rules_version = node.at("rules_version").string();
  game.created = read_date(node.at("created"));
  game.over = node.at("over").boolean();
  game.result = read_result(node);
  game.turns = node.at("turns").integer<std::uint32_t>();
  game.head = read_digest(node.at("checksum"));
  const std::vector<JsonNode> acknowledged = node.at("acknowledged").elements(2);
  for (std::size_t i = 0; i < acknowledged.size() && i < 2; ++i)
    game.acknowledged[i] = acknowledged[i].boolean();
  game.finished = read_optional_date(node, "finished");
  game.seal = read_digest(node.at("seal"));
  if (node.at("initial_state").is_object())
    game.initial_state = raw.text("initial_state");
  else
    node.at("initial_state").refuse_expecting("an object");
  return game;
}

rules::Call read_call(const JsonNode& node) {
  if (node.value() == nullptr)
    return {};
  const auto call = protocol::decode_call(canonical_text(*node.value()));
  if (!call)
    node.refuse(call.error().reason);
  return call.value_or(rules::Call{});
}

storage::ShotPart read_shot(const JsonNode& node) {
  storage::ShotPart shot;
  shot.index = node.at("index").integer<std::uint32_t>();
  shot.shared = node.at("shared").boolean();
  shot.intended = read_five<protocol::ShotParams>(node.at("intended"));
  shot.executed = read_five<protocol::ShotParams>(node.at("executed"));
  shot.moved = node.at("moved").boolean();
  if (const auto cue_ball = node.nullable("cue_ball"))
    shot.cue_ball = physics::Vec2<double>{cue_ball->at("x").number(), cue_ball->at("y").number()};
  shot.call = read_call(node.at("call"));
  return shot;
}

storage::ClockPart read_clock(const JsonNode& node) {
  return {.used = read_micros(node.at("used_us")),
          .forgiven = read_micros(node.at("forgiven_us")),
          .left = read_two_micros(node.at("left_us")),
          .lag_left = read_two_micros(node.at("lag_left_us"))};
}

storage::TurnRecord read_turn(const JsonNode& node, const RawMembers& raw) {
  storage::TurnRecord turn;
  turn.game = read_id<protocol::GameId>(node.at("game"));
  turn.number = node.at("turn").integer<std::uint32_t>();
  turn.action = node.at("action").one_of(storage::turn_action, "the name of a turn's action");
  turn.seat = read_seat(node.at("seat"));
  if (node.nullable("shot_id"))
    turn.request = protocol::ShotId{raw.text("shot_id")};
  if (const auto shot = node.nullable("shot")) {
    turn.shot = read_shot(*shot);
    turn.shot->events = raw.text("events");
    static_cast<void>(node.at("events").elements());
  }
  if (const auto decision = node.nullable("decision"))
    turn.decision = decision->one_of(rules::decision, "the name of a decision");
  turn.refusals = node.at("refusals").integer<std::uint32_t>();
  turn.clock = read_clock(node.at("clock"));
  turn.stored = read_date(node.at("stored"));
  turn.physics_version = node.at("physics_version").string();
  turn.rules_version = node.at("rules_version").string();
  turn.result = read_result(node);
  turn.checksum = read_digest(node.at("checksum"));
  for (const char* state : {"state_before", "state_after"}) {
    if (!node.at(state).is_object())
      node.at(state).refuse_expecting("an object");
  }
  turn.state_before = raw.text("state_before");
  turn.state_after = raw.text("state_after");
  if (node.nullable("ruling"))
    turn.ruling = raw.text("ruling");
  return turn;
}

LineRecord read_record(const JsonNode& root, std::string_view line) {
  if (const auto node = root.find("turn"))
    return read_turn(*node, RawMembers(line));
  if (const auto node = root.find("game"))
    return read_game(*node, RawMembers(line));
  if (const auto node = root.find("match"))
    return read_match(*node);
  if (const auto node = root.find("tournament"))
    return read_tournament(*node);
  if (const auto node = root.find("agent"))
    return read_agent(*node);
  if (const auto node = root.find("export"))
    return ExportHeader{node->at("format").integer<std::int64_t>(export_format, export_format)};
  root.refuse_expecting("an object named export, agent, tournament, match, game or turn");
  return ExportHeader{};
}

}  // namespace

protocol::Expected<LineRecord> read_line(std::string_view line) {
  return protocol::read_document(line, protocol::document_bounds, [line](const JsonNode& root) {
    root.only({"export", "agent", "tournament", "match", "game", "turn"});
    return read_record(root, line);
  });
}

}  // namespace poolhall::match
