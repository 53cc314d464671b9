// Games played to the end (or to a number of turns) by two players who shoot at random (softly,
// so that a game lasts), through match::Game and a real database, one turn a transaction.
//
//   PlayedGame played(*database, order_of(GameId{1}), 7);
//   played.play(40);
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "rules/referee.hpp"
#include "server/match/chain.hpp"
#include "server/match/game.hpp"
#include "server/match/sha256.hpp"

namespace poolhall::match {

template <class T>
T must(storage::Expected<T> value) {
  if (!value)
    throw std::runtime_error(value.error().reason);
  if constexpr (!std::is_void_v<T>)
    return std::move(*value);
}

inline GameOrder order_of(std::int64_t id) {
  GameOrder order;
  order.id = protocol::GameId{id};
  order.match = protocol::MatchId{1};
  order.number = static_cast<std::uint32_t>(2 * id);
  order.agents = {storage::AgentId{1}, storage::AgentId{2}};
  order.terms.rack_gap = 1e-4;
  order.terms.increment = storage::Micros{1'000'000};
  order.rack_seed = rack_seed(99, order.number);
  for (std::size_t i = 0; i < order.key.size(); ++i)
    order.key[i] = static_cast<std::uint8_t>(7 * i + static_cast<std::size_t>(id));
  order.created = storage::UnixMicros{1'000};
  return order;
}

// Two agents and a match that the games of order_of belong to.
inline void add_players(storage::Database& database) {
  must(database.begin());
  for (const int id : {1, 2}) {
    storage::AgentRecord agent{.id = storage::AgentId{id}, .name = id == 1 ? "Anna" : "Bob"};
    agent.token_hash[0] = static_cast<std::uint8_t>(id);
    must(database.add_agent(agent));
  }
  storage::MatchRecord match;
  match.id = protocol::MatchId{1};
  match.agents = {storage::AgentId{1}, storage::AgentId{2}};
  match.games = 6;
  match.terms = order_of(1).terms;
  match.seed = 99;
  match.seal = seal(match);
  must(database.add_match(match));
  must(database.commit());
}

// Another match of the same two, nine-ball with mirrored noise, with a pair of games in which both
// agents added their part to the noise and every shot was shared; both went on for so many turns.
inline void add_mirrored_pair(storage::Database& database, std::uint32_t turns);

class PlayedGame {
 public:
  PlayedGame(storage::Database& database, const GameOrder& order, std::uint64_t seed)
      : database_(database), random_(seed), game_(begin(database, order)) {}

  [[nodiscard]] Game& game() { return game_; }

  // From now on every shot has the deviates that this game's pair shares.
  void share_with(const storage::GameRecord& first) { first_ = first; }

  // The agent of this seat reveals what it had committed to.
  void reveal(Seat seat, const storage::Digest& secret) {
    const auto row = game_.reveal(seat, secret);
    must(database_.begin());
    must(database_.update_game(row.value().value()));
    must(database_.commit());
  }

  // At most so many turns; then the player to move concedes.
  void play(std::uint32_t turns) {
    for (std::uint32_t i = 0; i < turns && game_.phase() != Phase::over; ++i)
      one_turn();
    if (game_.phase() != Phase::over)
      carry_out(game_.concede(game_.state().to_move, arrival()));
  }

  // Asks until the turn is over.
  void one_turn() {
    const std::uint32_t turn = game_.state().turn;
    while (game_.phase() != Phase::over && game_.state().turn == turn)
      carry_out(ask());
  }

  void carry_out(Answer answer) {
    if (auto* play_it = std::get_if<Play>(&answer)) {
      if (first_)
        share_deviates(play_it->job, mixed_key(first_->key, first_->agent_secrets), first_->id);
      answer = game_.settle(match::play(play_it->job), now_);
    }
    if (auto* write = std::get_if<Store>(&answer)) {
      must(database_.begin());
      must(database_.append_turn(write->turn));
      if (write->game)
        must(database_.update_game(*write->game));
      must(database_.commit());
      game_.stored();
    }
  }

  [[nodiscard]] Answer ask() {
    const rules::GameState& state = game_.state();
    game_.begin_turn(now_);
    if (state.kind == rules::TurnKind::decision) {
      const auto choice = below(state.options.size());
      return game_.decide(state.to_move, {game_.record().id, state.turn, state.options[choice]},
                          arrival());
    }
    return game_.shot(state.to_move, any_shot(), arrival());
  }

  [[nodiscard]] protocol::Shot any_shot() {
    const rules::GameState& state = game_.state();
    protocol::Shot shot;
    shot.game = game_.record().id;
    shot.turn = state.turn;
    shot.shot_id.json = std::to_string(++shot_id_);
    physics::Vec2<double> from = rules::find_ball(state, physics::cue_ball)->position;
    if (state.kind != rules::TurnKind::shot) {
      const double length = state.kind == rules::TurnKind::ball_in_hand ? 2.1 : 0.5;
      from = {between(0.05, 1.05), between(0.05, length)};
      shot.cue_ball = from;
    }
    const auto balls = rules::callable_balls(state);
    const physics::BallId target = balls.empty() ? physics::BallId{1} : balls[below(balls.size())];
    const physics::Vec2<double> to = rules::find_ball(state, target)->position;
    const double degrees = std::atan2(to.y - from.y, to.x - from.x) * 180 / 3.141592653589793;
    shot.params = {.a = between(-8, 8),
                   .b = between(-8, 8),
                   .theta = between(1, 12),
                   .phi = degrees < 0 ? degrees + 360 : degrees,
                   .v = state.kind == rules::TurnKind::break_shot ? 6 : between(0.8, 2)};
    if (state.kind != rules::TurnKind::break_shot)
      shot.call = {rules::Call::Kind::pocket, target,
                   static_cast<physics::PocketId>(below(physics::pocket_count))};
    return shot;
  }

  [[nodiscard]] Arrival arrival() {
    now_ += Instant{1'000 + static_cast<std::int64_t>(below(2'000'000))};
    return {.at = now_, .lag = storage::Micros{3'000}, .date = storage::UnixMicros{now_.count()}};
  }

 private:
  static Game begin(storage::Database& database, const GameOrder& order) {
    auto record = new_game_record(order);
    if (!record)
      throw std::runtime_error(record.error());
    must(database.begin());
    must(database.add_game(*record));
    must(database.commit());
    return Game::open({.game = std::move(*record)}).value();
  }

  [[nodiscard]] std::size_t below(std::size_t bound) { return random_() % bound; }
  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

  storage::Database& database_;
  std::optional<storage::GameRecord> first_{};
  std::mt19937_64 random_;
  Game game_;
  Instant now_{1'000'000};
  std::uint32_t shot_id_ = 0;
};

inline void add_mirrored_pair(storage::Database& database, std::uint32_t turns) {
  storage::MatchRecord match;
  match.id = protocol::MatchId{2};
  match.agents = {storage::AgentId{1}, storage::AgentId{2}};
  match.games = 2;
  match.terms.rules = rules::RuleSet::nine_ball;
  match.terms.noise = "variable";
  match.terms.shot_cap = storage::Micros{60'000'000};
  match.seed = 0xfedcba9876543210;
  match.mirrored = storage::Mirror::noise;
  match.request = "\"again\"";
  match.created = storage::UnixMicros{2'000};
  match.seal = seal(match);
  must(database.begin());
  must(database.add_match(match));
  must(database.commit());
  const std::array<storage::Digest, 2> secrets{storage::Digest{1, 2}, storage::Digest{3, 4}};
  std::optional<storage::GameRecord> first;
  for (const std::uint32_t number : {0U, 1U}) {
    GameOrder order = order_of(101 + number);
    order.match = match.id;
    order.number = number;
    order.terms = match.terms;
    order.rack_seed = rack_seed(match.seed, rack_number(number, 0, match.mirrored));
    order.shared_from = protocol::GameId{101};
    order.agent_commitments = {sha256(secrets[0]), sha256(secrets[1])};
    PlayedGame played(database, order, 17 + number);
    played.reveal(Seat::first, secrets[0]);
    played.reveal(Seat::second, secrets[1]);
    if (!first)
      first = played.game().record();
    played.share_with(*first);
    played.play(turns);
  }
  must(database.begin());
  must(database.update_match(finished(match, storage::UnixMicros{3'000})));
  must(database.commit());
}

}  // namespace poolhall::match
