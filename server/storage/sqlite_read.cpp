#include <cmath>
#include <cstring>

#include "server/storage/sqlite_rows.hpp"
#include "server/storage/turn_texts.hpp"

namespace poolhall::storage {

SQLite::Column Columns::take() {
  return statement_.getColumn(next_++);
}

void Columns::fail(const std::string& expected) const {
  const SQLite::Column column = statement_.getColumn(next_ - 1);
  constexpr std::size_t longest = 40;
  std::string value = column.isNull()   ? "null"
                      : column.isBlob() ? std::to_string(column.getBytes()) + " bytes"
                                        : column.getText();
  if (value.size() > longest)
    value = value.substr(0, longest) + "...";
  throw Unreadable(std::string(column.getName()) + ": got " + value + ", expected " + expected);
}

std::int64_t Columns::integer() {
  const SQLite::Column column = take();
  if (!column.isInteger())
    fail("an integer");
  return column.getInt64();
}

double Columns::real() {
  const SQLite::Column column = take();
  if (!column.isFloat() || !std::isfinite(column.getDouble()))
    fail("a finite real number");
  return column.getDouble();
}

std::string Columns::text() {
  const SQLite::Column column = take();
  if (!column.isText())
    fail("a text");
  const char* begin = column.getText();
  return {begin, static_cast<std::size_t>(column.getBytes())};
}

std::string Columns::bytes() {
  const SQLite::Column column = take();
  if (!column.isBlob())
    fail("bytes");
  const auto* begin = static_cast<const char*>(column.getBlob());
  return {begin, static_cast<std::size_t>(column.getBytes())};
}

Digest Columns::digest() {
  const SQLite::Column column = take();
  Digest digest;
  if (!column.isBlob() || static_cast<std::size_t>(column.getBytes()) != digest.size())
    fail("32 bytes");
  std::memcpy(digest.data(), column.getBlob(), digest.size());
  return digest;
}

bool Columns::flag() {
  const std::int64_t value = integer();
  if (value != 0 && value != 1)
    fail("0 or 1");
  return value == 1;
}

std::uint32_t Columns::count() {
  const std::int64_t value = integer();
  if (value < 0 || value > std::int64_t{UINT32_MAX})
    fail("a count");
  return static_cast<std::uint32_t>(value);
}

rules::Seat Columns::seat() {
  return flag() ? rules::Seat::second : rules::Seat::first;
}

bool Columns::skip_null() {
  if (!statement_.getColumn(next_).isNull())
    return false;
  ++next_;
  return true;
}

std::optional<std::string> Columns::optional_text() {
  if (skip_null())
    return std::nullopt;
  return text();
}

std::optional<std::uint32_t> Columns::optional_count() {
  if (skip_null())
    return std::nullopt;
  return count();
}

std::optional<Digest> Columns::optional_digest() {
  if (skip_null())
    return std::nullopt;
  return digest();
}

AgentRecord Columns::agent() {
  AgentRecord agent;
  agent.id = AgentId{integer()};
  agent.name = text();
  agent.token_hash = digest();
  agent.house_bot = optional_text();
  agent.created = date();
  return agent;
}

TournamentRecord Columns::tournament() {
  TournamentRecord tournament;
  tournament.id = text();
  tournament.wire_id = TournamentId{integer()};
  tournament.title = text();
  tournament.settings = text();
  const std::optional<TournamentStatus> status = tournament_status(text());
  if (!status)
    fail("a tournament's status");
  tournament.status = *status;
  tournament.created = date();
  return tournament;
}

EntryRecord Columns::entry() {
  EntryRecord entry;
  entry.tournament = text();
  entry.agent = AgentId{integer()};
  entry.place = count();
  entry.from_round = count();
  entry.until_round = optional_count();
  entry.house_bot = optional_text();
  entry.command = optional_text();
  return entry;
}

TermsRecord Columns::terms() {
  TermsRecord terms;
  const std::optional<rules::RuleSet> rules = rules::rule_set(text());
  if (!rules)
    fail("the name of a rule set");
  terms.rules = *rules;
  terms.table = text();
  terms.materials = text();
  terms.noise = text();
  terms.noise_hidden = flag();
  terms.rack_gap = real();
  terms.rack_jitter = real();
  terms.clock = micros();
  terms.increment = micros();
  if (!skip_null())
    terms.shot_cap = micros();
  terms.max_refusals = count();
  terms.lag_per_turn = micros();
  terms.lag_per_game = micros();
  return terms;
}

std::optional<rules::GameResult> Columns::result() {
  std::optional<rules::Seat> winner;
  if (!skip_null())
    winner = seat();
  const std::optional<std::string> reason = optional_text();
  if (!reason) {
    if (winner)
      fail("a reason beside the winner");
    return std::nullopt;
  }
  const std::optional<rules::EndReason> known = rules::end_reason(*reason);
  if (!known)
    fail("the name of an end reason");
  return rules::GameResult{winner, *known};
}

MatchRecord Columns::match() {
  MatchRecord match;
  match.id = MatchId{integer()};
  match.tournament = optional_text();
  if (!skip_null())
    match.pairing = count();
  match.request = optional_text();
  match.agents[0] = AgentId{integer()};
  match.agents[1] = AgentId{integer()};
  match.games = count();
  match.terms = terms();
  match.seed = static_cast<std::uint64_t>(integer());
  const std::int64_t mirrored = integer();
  if (mirrored < 0 || mirrored > static_cast<std::int64_t>(Mirror::noise))
    fail("0, 1 or 2");
  match.mirrored = static_cast<Mirror>(mirrored);
  match.over = flag();
  match.created = date();
  if (!skip_null())
    match.finished = date();
  if (!skip_null())
    match.challenge = protocol::ChallengeId{integer()};
  match.seal = optional_digest();
  return match;
}

FinalStanding Columns::final_standing() {
  FinalStanding standing;
  standing.rank = count();
  standing.agent = text();
  standing.points = real();
  standing.games = count();
  standing.wins = count();
  standing.losses = count();
  standing.draws = count();
  return standing;
}

GameRecord Columns::game() {
  GameRecord game;
  game.id = GameId{integer()};
  game.match = MatchId{integer()};
  game.number = count();
  game.attempt = count();
  game.agents[0] = AgentId{integer()};
  game.agents[1] = AgentId{integer()};
  game.terms = terms();
  game.breaker = seat();
  game.rack_seed = static_cast<std::uint64_t>(integer());
  game.key = digest();
  for (double* sigma :
       {&game.noise.a, &game.noise.b, &game.noise.theta, &game.noise.phi, &game.noise.v})
    *sigma = real();
  game.commitment = digest();
  game.initial_state = text();
  game.physics_version = text();
  game.rules_version = text();
  game.created = date();
  game.over = flag();
  game.result = result();
  game.turns = count();
  game.head = digest();
  game.acknowledged[0] = flag();
  game.acknowledged[1] = flag();
  if (!skip_null())
    game.finished = date();
  game.seal = digest();
  for (std::optional<Digest>& commitment : game.agent_commitments)
    commitment = optional_digest();
  if (!skip_null())
    game.shared_from = GameId{integer()};
  for (std::optional<Digest>& secret : game.agent_secrets)
    secret = optional_digest();
  return game;
}

ResultRecord Columns::result_row() {
  ResultRecord row;
  row.game = GameId{integer()};
  row.match = MatchId{integer()};
  row.agents[0] = AgentId{integer()};
  row.agents[1] = AgentId{integer()};
  const std::optional<rules::RuleSet> rules = rules::rule_set(text());
  if (!rules)
    fail("the name of a rule set");
  row.rules = *rules;
  row.breaker = seat();
  const std::optional<rules::GameResult> ended = result();
  if (!ended)
    fail("a result");
  row.result = *ended;
  row.finished = date();
  return row;
}

protocol::ShotParams Columns::stroke() {
  protocol::ShotParams stroke;
  for (double* value : {&stroke.a, &stroke.b, &stroke.theta, &stroke.phi, &stroke.v})
    *value = real();
  return stroke;
}

rules::Call Columns::call() {
  const std::optional<rules::Call::Kind> kind = rules::call_kind(text());
  if (!kind)
    fail("none, pocket, safety or push_out");
  if (*kind == rules::Call::Kind::pocket) {
    const std::uint32_t ball = count();
    if (ball >= physics::max_balls)
      fail("a ball's number");
    const std::optional<physics::PocketId> pocket = physics::pocket_id(text());
    if (!pocket)
      fail("the name of a pocket");
    return {rules::Call::Kind::pocket, physics::BallId{static_cast<std::uint8_t>(ball)}, *pocket};
  }
  for (int i = 0; i < 2; ++i) {
    if (!skip_null()) {
      ++next_;
      fail("null beside this kind of call");
    }
  }
  return {*kind, {}, {}};
}

std::optional<ShotPart> Columns::shot() {
  if (skip_null()) {
    constexpr int columns_after_the_index = 16;
    for (int i = 0; i < columns_after_the_index; ++i) {
      if (!skip_null()) {
        ++next_;
        fail("null in a turn without a shot");
      }
    }
    return std::nullopt;
  }
  ShotPart shot;
  shot.index = count();
  shot.intended = stroke();
  shot.executed = stroke();
  shot.moved = flag();
  if (!skip_null()) {
    const double x = real();
    shot.cue_ball = physics::Vec2<double>{x, real()};
  } else if (!skip_null()) {
    ++next_;
    fail("null beside cue_ball_x");
  }
  shot.call = call();
  return shot;
}

ClockPart Columns::clock() {
  ClockPart clock;
  clock.used = micros();
  clock.forgiven = micros();
  clock.left[0] = micros();
  clock.left[1] = micros();
  clock.lag_left[0] = micros();
  clock.lag_left[1] = micros();
  return clock;
}

TurnRecord Columns::turn() {
  TurnRecord turn;
  turn.game = GameId{integer()};
  turn.number = count();
  const std::optional<TurnAction> action = turn_action(text());
  if (!action)
    fail("the name of a turn's action");
  turn.action = *action;
  turn.seat = seat();
  if (!skip_null())
    turn.request = protocol::ShotId{text()};
  turn.shot = shot();
  if (!skip_null()) {
    turn.decision = rules::decision(text());
    if (!turn.decision)
      fail("the name of a decision");
  }
  turn.result = result();
  turn.refusals = count();
  turn.clock = clock();
  turn.stored = date();
  turn.physics_version = text();
  turn.rules_version = text();
  turn.checksum = digest();
  texts(turn);
  return turn;
}

// As they are, or all of them in the last column.
void Columns::texts(TurnRecord& turn) {
  turn.state_before = text();
  turn.state_after = text();
  turn.ruling = optional_text();
  const std::optional<std::string> events = optional_text();
  if (!skip_null()) {
    if (integer() != 1 || !turn.shot)
      fail("1 in a shot with shared deviates, else null");
    turn.shot->shared = true;
  }
  if (skip_null()) {
    if (events.has_value() != turn.shot.has_value())
      fail("the turn's texts, here or each in its own column");
    if (turn.shot)
      turn.shot->events = *events;
    return;
  }
  const bool is_alone =
      turn.state_before.empty() && turn.state_after.empty() && !turn.ruling && !events;
  const std::string packed = bytes();
  if (!is_alone || !unpack_texts(packed, turn))
    fail("the turn's texts, and nothing in their own columns");
}

}  // namespace poolhall::storage
