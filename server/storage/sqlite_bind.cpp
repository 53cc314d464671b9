#include <algorithm>

#include "server/storage/sqlite_rows.hpp"

namespace poolhall::storage {

std::string insert_sql(std::string_view table, std::string_view columns) {
  std::string sql = "INSERT INTO " + std::string(table) + "(" + std::string(columns) + ") VALUES(?";
  for (auto commas = std::count(columns.begin(), columns.end(), ','); commas > 0; --commas)
    sql += ",?";
  return sql + ")";
}

Binder& Binder::operator<<(std::int64_t value) {
  statement_.bind(next_++, value);
  return *this;
}

Binder& Binder::operator<<(double value) {
  statement_.bind(next_++, value);
  return *this;
}

Binder& Binder::operator<<(std::string_view text) {
  statement_.bind(next_++, std::string(text));
  return *this;
}

Binder& Binder::operator<<(const std::string& text) {
  statement_.bindNoCopy(next_++, text);
  return *this;
}

Binder& Binder::operator<<(const Digest& digest) {
  statement_.bindNoCopy(next_++, digest.data(), static_cast<int>(digest.size()));
  return *this;
}

Binder& Binder::bytes(std::string_view value) {
  statement_.bindNoCopy(next_++, value.data(), static_cast<int>(value.size()));
  return *this;
}

Binder& Binder::operator<<(std::nullopt_t) {
  statement_.bind(next_++);
  return *this;
}

Binder& Binder::operator<<(const AgentRecord& agent) {
  return *this << number(agent.id) << agent.name << agent.token_hash << agent.house_bot
               << agent.created;
}

Binder& Binder::operator<<(const TournamentRecord& tournament) {
  return *this << tournament.id << number(tournament.wire_id) << tournament.title
               << tournament.settings << name(tournament.status) << tournament.created;
}

Binder& Binder::operator<<(const EntryRecord& entry) {
  return *this << entry.tournament << number(entry.agent) << std::int64_t{entry.place}
               << std::int64_t{entry.from_round}
               << (entry.until_round ? std::optional<std::int64_t>(*entry.until_round)
                                     : std::nullopt)
               << entry.house_bot << entry.command;
}

void Binder::put(const TermsRecord& terms) {
  *this << rules::name(terms.rules) << terms.table << terms.materials << terms.noise
        << std::int64_t{terms.noise_hidden} << terms.rack_gap << terms.rack_jitter << terms.clock
        << terms.increment << terms.shot_cap << std::int64_t{terms.max_refusals}
        << terms.lag_per_turn << terms.lag_per_game;
}

void Binder::put(const std::optional<rules::GameResult>& result) {
  if (!result) {
    *this << std::nullopt << std::nullopt;
    return;
  }
  if (result->winner)
    *this << std::int64_t{index(*result->winner)};
  else
    *this << std::nullopt;
  *this << rules::name(result->reason);
}

Binder& Binder::operator<<(const MatchRecord& match) {
  *this << number(match.id) << match.tournament;
  if (match.pairing)
    *this << std::int64_t{*match.pairing};
  else
    *this << std::nullopt;
  *this << match.request << number(match.agents[0]) << number(match.agents[1])
        << std::int64_t{match.games};
  put(match.terms);
  return *this << static_cast<std::int64_t>(match.seed) << static_cast<std::int64_t>(match.mirrored)
               << std::int64_t{match.over} << match.created << match.finished
               << (match.challenge ? std::optional{protocol::number(*match.challenge)}
                                   : std::nullopt)
               << match.seal;
}

Binder& Binder::operator<<(const GameRecord& game) {
  *this << number(game.id) << number(game.match) << std::int64_t{game.number}
        << std::int64_t{game.attempt} << number(game.agents[0]) << number(game.agents[1]);
  put(game.terms);
  *this << std::int64_t{index(game.breaker)} << static_cast<std::int64_t>(game.rack_seed)
        << game.key << game.noise.a << game.noise.b << game.noise.theta << game.noise.phi
        << game.noise.v << game.commitment << game.initial_state << game.physics_version
        << game.rules_version << game.created << std::int64_t{game.over};
  put(game.result);
  *this << std::int64_t{game.turns} << game.head << std::int64_t{game.acknowledged[0]}
        << std::int64_t{game.acknowledged[1]} << game.finished << game.seal
        << game.agent_commitments[0] << game.agent_commitments[1];
  if (game.shared_from)
    *this << number(*game.shared_from);
  else
    *this << std::nullopt;
  return *this << game.agent_secrets[0] << game.agent_secrets[1];
}

void Binder::put(const ShotPart& shot) {
  *this << std::int64_t{shot.index};
  for (const protocol::ShotParams* stroke : {&shot.intended, &shot.executed})
    *this << stroke->a << stroke->b << stroke->theta << stroke->phi << stroke->v;
  *this << std::int64_t{shot.moved};
  if (shot.cue_ball)
    *this << shot.cue_ball->x << shot.cue_ball->y;
  else
    *this << std::nullopt << std::nullopt;
  *this << rules::name(shot.call.kind);
  if (shot.call.kind == rules::Call::Kind::pocket)
    *this << std::int64_t{physics::number(shot.call.ball)} << physics::name(shot.call.pocket);
  else
    *this << std::nullopt << std::nullopt;
}

Binder& Binder::turn(const TurnRecord& turn, const std::optional<std::string>& texts) {
  *this << number(turn.game) << std::int64_t{turn.number} << name(turn.action)
        << std::int64_t{index(turn.seat)};
  if (turn.request)
    *this << turn.request->json;
  else
    *this << std::nullopt;
  if (turn.shot) {
    put(*turn.shot);
  } else {
    constexpr int columns_of_a_shot = 17;
    for (int i = 0; i < columns_of_a_shot; ++i)
      *this << std::nullopt;
  }
  if (turn.decision)
    *this << rules::name(*turn.decision);
  else
    *this << std::nullopt;
  put(turn.result);
  const ClockPart& clock = turn.clock;
  *this << std::int64_t{turn.refusals} << clock.used << clock.forgiven << clock.left[0]
        << clock.left[1] << clock.lag_left[0] << clock.lag_left[1] << turn.stored
        << turn.physics_version << turn.rules_version << turn.checksum;
  if (texts) {
    *this << std::string_view() << std::string_view() << std::nullopt << std::nullopt;
  } else {
    *this << turn.state_before << turn.state_after << turn.ruling;
    turn.shot ? *this << turn.shot->events : *this << std::nullopt;
  }
  // Null unless shared: as in rows that were written before there was such a thing.
  if (turn.shot && turn.shot->shared)
    *this << std::int64_t{1};
  else
    *this << std::nullopt;
  return texts ? bytes(*texts) : *this << std::nullopt;
}

}  // namespace poolhall::storage
