#include "server/net/notices.hpp"

#include <algorithm>

#include "protocol/table_json.hpp"
#include "rules/referee.hpp"
#include "server/match/chain.hpp"

namespace poolhall::net {

using protocol::RawJson;

namespace {

// Down: what an agent is told that it has, it has.
std::int64_t whole_ms(storage::Micros time) {
  return std::chrono::floor<std::chrono::milliseconds>(time).count();
}

RawJson events_for(const storage::ShotPart& shot, const Side& reader) {
  if (reader.detail == protocol::EventDetail::full && shot.events.size() <= reader.event_bytes) {
    return RawJson{shot.events};
  }
  std::string summary = protocol::summary_of(shot.events);
  return RawJson{summary.size() <= reader.event_bytes ? std::move(summary) : std::string{"[]"}};
}

std::array<std::optional<protocol::Hex256>, 2> hex_pair(
    const std::array<std::optional<storage::Digest>, 2>& digests) {
  std::array<std::optional<protocol::Hex256>, 2> pair;
  for (const std::size_t seat : {0U, 1U}) {
    if (digests[seat]) {
      pair[seat] = protocol::Hex256{match::to_hex(*digests[seat])};
    }
  }
  return pair;
}

protocol::Legal legal_in(const rules::GameState& state) {
  if (state.kind == rules::TurnKind::decision) {
    return protocol::LegalDecisions{state.options};
  }
  return protocol::LegalBalls{rules::callable_balls(state), rules::legal_first_balls(state),
                              rules::legal_calls(state)};
}

// What every message about a turn that is over has.
template <class Message>
Message turn_over(const storage::TurnRecord& row, const Side& reader) {
  Message message;
  message.game = row.game;
  message.turn = row.number;
  message.by = row.seat;
  message.state = RawJson{row.state_after};
  message.clock = clocks_after(row, reader.seat);
  return message;
}

}  // namespace

GameCard card_of(const match::Board& board, std::array<std::string, 2> names,
                 std::optional<protocol::TournamentId> tournament) {
  return {.tournament = tournament,
          .names = std::move(names),
          .table = protocol::encode_table(board.table),
          .materials = protocol::encode_materials(board.materials)};
}

WireTime::WireTime()
    : offset_(std::chrono::duration_cast<std::chrono::microseconds>(
                  std::chrono::system_clock::now().time_since_epoch()) -
              std::chrono::duration_cast<std::chrono::microseconds>(
                  std::chrono::steady_clock::now().time_since_epoch())) {}

std::int64_t WireTime::ms(SteadyTime t) const {
  return whole_ms(std::chrono::floor<std::chrono::microseconds>(t.time_since_epoch()) + offset_);
}

protocol::ClockSettings clock_settings_of(const storage::TermsRecord& terms) {
  protocol::ClockSettings clock;
  clock.game_ms = whole_ms(terms.clock);
  clock.increment_ms = whole_ms(terms.increment);
  if (terms.shot_cap) {
    clock.shot_ms = whole_ms(*terms.shot_cap);
  }
  return clock;
}

protocol::GameTerms<Outgoing> terms_of(const storage::GameRecord& game, const GameCard& card,
                                       Seat reader) {
  protocol::GameTerms<Outgoing> terms;
  terms.game = game.id;
  terms.match = game.match;
  terms.tournament = card.tournament;
  terms.seat = reader;
  terms.opponent = card.names[rules::index(rules::other(reader))];
  terms.rules = game.terms.rules;
  terms.table = RawJson{card.table};
  terms.physics = RawJson{card.materials};
  if (!game.terms.noise_hidden) {
    terms.noise = game.noise;
  }
  terms.clock = clock_settings_of(game.terms);
  terms.max_refusals = game.terms.max_refusals;
  terms.commitment = {match::to_hex(game.commitment)};
  terms.agent_commitments = hex_pair(game.agent_commitments);
  return terms;
}

protocol::ClockReading clocks_of(const match::Game& game, Seat reader, SteadyTime now,
                                 const WireTime& time) {
  const match::Instant at = match::rounded_up(now);
  protocol::ClockReading clocks;
  clocks.own_ms = whole_ms(game.clock().left(reader, at));
  clocks.opponent_ms = whole_ms(game.clock().left(rules::other(reader), at));
  if (const auto expires = game.expires(storage::Micros{0})) {
    clocks.deadline_ms = time.ms(SteadyTime{*expires});
  }
  return clocks;
}

protocol::ClockReading clocks_if_begun(const match::Game& game, Seat reader, SteadyTime now,
                                       const WireTime& time) {
  protocol::ClockReading clocks = clocks_of(game, reader, now, time);
  if (!game.clock().running()) {
    const Seat mover = game.state().to_move;
    storage::Micros left = game.clock().left(mover, match::rounded_up(now));
    left = std::min(left, game.clock().settings().shot_cap.value_or(left));
    clocks.deadline_ms = time.ms(now + left);
  }
  return clocks;
}

protocol::ClockReading clocks_after(const storage::TurnRecord& row, Seat reader) {
  return {.own_ms = whole_ms(row.clock.left[rules::index(reader)]),
          .opponent_ms = whole_ms(row.clock.left[rules::index(rules::other(reader))]),
          .deadline_ms = {}};
}

protocol::GameTurn<Outgoing> turn_of(const match::Game& game,
                                     const protocol::ClockReading& clocks) {
  protocol::GameTurn<Outgoing> turn;
  turn.game = game.record().id;
  turn.turn = game.state().turn;
  turn.kind = game.state().kind;
  turn.state = RawJson{game.state_json()};
  turn.clock = clocks;
  turn.legal = legal_in(game.state());
  turn.refusals = game.refusals();
  return turn;
}

protocol::GameShot<Outgoing> shot_of(const storage::TurnRecord& row, const Side& reader) {
  const storage::ShotPart& played = row.shot.value();
  auto shot = turn_over<protocol::GameShot<Outgoing>>(row, reader);
  shot.shot_id = row.request.value_or(protocol::ShotId{"null"});
  shot.call = played.call;
  shot.cue_ball = played.cue_ball;
  shot.intended = played.intended;
  shot.executed = played.executed;
  shot.moved = played.moved;
  shot.ruling = RawJson{row.ruling.value_or("null")};
  shot.events = events_for(played, reader);
  return shot;
}

protocol::GameDecision<Outgoing> decision_of(const storage::TurnRecord& row, const Side& reader) {
  auto decision = turn_over<protocol::GameDecision<Outgoing>>(row, reader);
  decision.choice = row.decision.value();
  return decision;
}

protocol::GameTurnLost<Outgoing> lost_turn_of(const storage::TurnRecord& row, const Side& reader) {
  auto lost = turn_over<protocol::GameTurnLost<Outgoing>>(row, reader);
  lost.ruling = RawJson{row.ruling.value_or("null")};
  return lost;
}

protocol::GameOver over_of(const storage::GameRecord& game) {
  protocol::GameOver over;
  over.game = game.id;
  over.match = game.match;
  if (game.result) {
    over.winner = game.result->winner;
    over.reason = game.result->reason;
  }
  over.scored = over.reason != rules::EndReason::void_game;
  over.checksum = {match::to_hex(game.head)};
  return over;
}

protocol::GameSeeds seeds_of(const storage::GameRecord& game) {
  protocol::GameSeeds seeds;
  seeds.game = game.id;
  seeds.key = {match::to_hex(game.key)};
  seeds.rack_seed = game.rack_seed;
  seeds.agent_secrets = hex_pair(game.agent_secrets);
  return seeds;
}

}  // namespace poolhall::net
