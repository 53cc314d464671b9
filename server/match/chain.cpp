#include "server/match/chain.hpp"

#include <charconv>

#include "server/match/sha256.hpp"

namespace poolhall::match {
namespace {

void add(Bytes& bytes, const std::optional<storage::Micros>& value) {
  bytes.presence(value.has_value());
  if (value)
    bytes.integer(value->count());
}

void add(Bytes& bytes, const std::optional<rules::GameResult>& result) {
  bytes.presence(result.has_value());
  if (!result)
    return;
  bytes.presence(result->winner.has_value());
  if (result->winner)
    bytes.integer(index(*result->winner));
  bytes.text(rules::name(result->reason));
}

void add(Bytes& bytes, const storage::TermsRecord& terms) {
  bytes.text(rules::name(terms.rules)).text(terms.table).text(terms.materials).text(terms.noise);
  bytes.integer(terms.noise_hidden).real(terms.rack_gap).real(terms.rack_jitter);
  bytes.integer(terms.clock.count()).integer(terms.increment.count());
  add(bytes, terms.shot_cap);
  bytes.integer(terms.max_refusals).integer(terms.lag_per_turn.count());
  bytes.integer(terms.lag_per_game.count());
}

void add(Bytes& bytes, const std::optional<Digest>& digest) {
  bytes.presence(digest.has_value());
  if (digest)
    bytes.raw(*digest);
}

// Nothing for a game without such parts, so that its checksums are those of before there were any.
// What follows a beginning never begins with this number.
void add_parts_of_others(Bytes& bytes, const storage::GameRecord& game) {
  constexpr std::int64_t parts_follow = 2;
  const bool has_any = game.agent_commitments[0] || game.agent_commitments[1] ||
                       game.shared_from.has_value() || game.agent_secrets[0] ||
                       game.agent_secrets[1];
  if (!has_any)
    return;
  bytes.integer(parts_follow);
  for (const std::size_t seat : {0U, 1U})
    add(bytes, game.agent_commitments[seat]);
  bytes.presence(game.shared_from.has_value());
  if (game.shared_from)
    bytes.integer(number(*game.shared_from));
  for (const std::size_t seat : {0U, 1U})
    add(bytes, game.agent_secrets[seat]);
}

void add_beginning(Bytes& bytes, const storage::GameRecord& game) {
  bytes.integer(number(game.id)).integer(number(game.match)).integer(game.number);
  bytes.integer(game.attempt).integer(number(game.agents[0])).integer(number(game.agents[1]));
  add(bytes, game.terms);
  bytes.integer(index(game.breaker)).fixed(game.rack_seed).raw(game.key);
  const protocol::NoiseParams& noise = game.noise;
  for (const double sigma : {noise.a, noise.b, noise.theta, noise.phi, noise.v})
    bytes.real(sigma);
  bytes.raw(game.commitment).text(game.initial_state);
  bytes.text(game.physics_version).text(game.rules_version).integer(number(game.created));
  add_parts_of_others(bytes, game);
}

void add(Bytes& bytes, const storage::ShotPart& shot) {
  bytes.integer(shot.index);
  for (const protocol::ShotParams* stroke : {&shot.intended, &shot.executed}) {
    for (const double value : {stroke->a, stroke->b, stroke->theta, stroke->phi, stroke->v})
      bytes.real(value);
  }
  bytes.integer(shot.moved).presence(shot.cue_ball.has_value());
  if (shot.cue_ball)
    bytes.real(shot.cue_ball->x).real(shot.cue_ball->y);
  bytes.integer(static_cast<std::int64_t>(shot.call.kind));
  if (shot.call.kind == rules::Call::Kind::pocket)
    bytes.integer(physics::number(shot.call.ball)).text(physics::name(shot.call.pocket));
  bytes.text(shot.events);
  if (shot.shared)
    bytes.text("shared");  // a ruling's presence never looks like this text's length
}

void add(Bytes& bytes, const storage::ClockPart& clock) {
  bytes.integer(clock.used.count()).integer(clock.forgiven.count());
  for (const storage::Micros value :
       {clock.left[0], clock.left[1], clock.lag_left[0], clock.lag_left[1]})
    bytes.integer(value.count());
}

}  // namespace

Digest first_link(const storage::GameRecord& game) {
  Bytes bytes;
  add_beginning(bytes, game);
  return sha256(bytes.bytes());
}

Digest chained(const Digest& previous, const storage::TurnRecord& turn) {
  Bytes bytes;
  bytes.raw(previous).integer(number(turn.game)).integer(turn.number);
  bytes.text(name(turn.action)).integer(index(turn.seat)).presence(turn.request.has_value());
  if (turn.request)
    bytes.text(turn.request->json);
  bytes.text(turn.state_before).presence(turn.shot.has_value());
  if (turn.shot)
    add(bytes, *turn.shot);
  bytes.presence(turn.decision.has_value());
  if (turn.decision)
    bytes.text(rules::name(*turn.decision));
  bytes.presence(turn.ruling.has_value());
  if (turn.ruling)
    bytes.text(*turn.ruling);
  bytes.text(turn.state_after);
  add(bytes, turn.result);
  bytes.integer(turn.refusals);
  add(bytes, turn.clock);
  bytes.integer(number(turn.stored)).text(turn.physics_version).text(turn.rules_version);
  return sha256(bytes.bytes());
}

Digest seal(const storage::GameRecord& game) {
  Bytes bytes;
  add_beginning(bytes, game);
  bytes.integer(game.over);
  add(bytes, game.result);
  bytes.integer(game.turns).raw(game.head);
  bytes.integer(game.acknowledged[0]).integer(game.acknowledged[1]);
  bytes.presence(game.finished.has_value());
  if (game.finished)
    bytes.integer(number(*game.finished));
  return sha256(bytes.bytes());
}

Digest seal(const storage::MatchRecord& match) {
  Bytes bytes;
  bytes.integer(number(match.id)).presence(match.tournament.has_value());
  if (match.tournament)
    bytes.text(*match.tournament);
  bytes.presence(match.pairing.has_value());
  if (match.pairing)
    bytes.integer(*match.pairing);
  bytes.presence(match.request.has_value());
  if (match.request)
    bytes.text(*match.request);
  bytes.integer(number(match.agents[0])).integer(number(match.agents[1])).integer(match.games);
  add(bytes, match.terms);
  bytes.fixed(match.seed).integer(static_cast<std::int64_t>(match.mirrored));
  bytes.integer(match.over).integer(number(match.created)).presence(match.finished.has_value());
  if (match.finished)
    bytes.integer(number(*match.finished));
  bytes.presence(match.challenge.has_value());
  if (match.challenge)
    bytes.integer(number(*match.challenge));
  return sha256(bytes.bytes());
}

std::string to_hex(const Digest& digest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

Digest digest_of(std::string_view hex) {
  Digest digest{};
  for (std::size_t i = 0; i < digest.size() && 2 * i + 1 < hex.size(); ++i)
    std::from_chars(hex.data() + 2 * i, hex.data() + 2 * i + 2, digest[i], 16);
  return digest;
}

}  // namespace poolhall::match
