// Records with every field set to something of its own, so that a mixed-up column shows.
#pragma once

#include <ostream>

#include "server/storage/database.hpp"

namespace poolhall::storage {

inline Digest digest_of(std::uint8_t byte) {
  Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i)
    digest[i] = static_cast<std::uint8_t>(byte + i);
  return digest;
}

inline AgentRecord sample_agent(std::int64_t id, const std::string& name) {
  return {.id = AgentId{id},
          .name = name,
          .token_hash = digest_of(static_cast<std::uint8_t>(id)),
          .created = UnixMicros{1'700'000'000'000'000 + id}};
}

inline TermsRecord sample_terms() {
  return {.rules = rules::RuleSet::nine_ball,
          .table = "bar7",
          .materials = "modern",
          .noise = "variable",
          .noise_hidden = true,
          .rack_gap = 1e-4,
          .rack_jitter = 3e-5,
          .clock = Micros{123},
          .increment = Micros{45},
          .shot_cap = Micros{67},
          .max_refusals = 8,
          .lag_per_turn = Micros{9},
          .lag_per_game = Micros{10}};
}

inline MatchRecord sample_match(std::int64_t id) {
  return {.id = MatchId{id},
          .tournament = "demo",
          .pairing = 3,
          .request = "\"again\"",
          .agents = {AgentId{1}, AgentId{2}},
          .games = 4,
          .terms = sample_terms(),
          .seed = 0xfedcba9876543210,
          .mirrored = Mirror::noise,
          .created = UnixMicros{11},
          .challenge = protocol::ChallengeId{77},
          .seal = digest_of(60)};
}

inline GameRecord sample_game(std::int64_t id, std::uint32_t number) {
  GameRecord game;
  game.id = GameId{id};
  game.match = MatchId{1};
  game.number = number;
  game.attempt = 2;
  game.agents = {AgentId{2}, AgentId{1}};
  game.terms = sample_terms();
  game.breaker = rules::Seat::second;
  game.rack_seed = (std::uint64_t{1} << 53) - 1;
  game.key = digest_of(40);
  game.noise = {.a = 0.1, .b = 0.2, .theta = 0.3, .phi = 0.4, .v = 0.5};
  game.commitment = digest_of(80);
  game.initial_state = "{\"balls\":[]}";
  game.physics_version = "p1";
  game.rules_version = "r1";
  game.created = UnixMicros{12};
  game.seal = digest_of(100);
  game.agent_commitments = {std::nullopt, digest_of(140)};
  game.agent_secrets = {digest_of(160), std::nullopt};
  if (id == 2)
    game.shared_from = GameId{1};
  return game;
}

inline TurnRecord sample_turn(std::int64_t game, std::uint32_t number) {
  TurnRecord turn;
  turn.game = GameId{game};
  turn.number = number;
  turn.seat = rules::Seat::second;
  turn.request = protocol::ShotId{"\"shot 7\""};
  turn.state_before = "{\"before\":1}";
  turn.shot = ShotPart{
      .index = 5,
      .intended = {1.5, -2.5, 3.5, 4.5, 5.5},
      .executed = {0.1, 1e-300, 5e-324, 0.30000000000000004, 7},
      .moved = true,
      .cue_ball = physics::Vec2<double>{0.25, 0.125},
      .call = {rules::Call::Kind::pocket, physics::BallId{9}, physics::PocketId::side_right},
      .events = "[{\"t\":0}]",
      .shared = true};
  turn.ruling = "{\"legal\":true}";
  turn.state_after = "{\"after\":1}";
  turn.refusals = 2;
  turn.clock = {.used = Micros{20},
                .forgiven = Micros{3},
                .left = {Micros{100}, Micros{200}},
                .lag_left = {Micros{300}, Micros{400}}};
  turn.stored = UnixMicros{13};
  turn.physics_version = "p2";
  turn.rules_version = "r2";
  turn.checksum = digest_of(120);
  return turn;
}

inline TurnRecord sample_ending(std::int64_t game, std::uint32_t number) {
  TurnRecord turn = sample_turn(game, number);
  turn.action = TurnAction::concession;
  turn.request.reset();
  turn.shot.reset();
  turn.ruling.reset();
  turn.result = rules::GameResult{rules::Seat::first, rules::EndReason::conceded};
  return turn;
}

// Two agents, a tournament, a match and two games, in a transaction of their own.
inline void add_samples(Database& database) {
  const auto must = [](const Expected<void>& done) {
    if (!done)
      throw std::runtime_error(done.error().reason);
  };
  must(database.begin());
  must(database.add_agent(sample_agent(1, "Anna")));
  must(database.add_agent(sample_agent(2, "Bob")));
  must(database.add_tournament({.id = "demo",
                                .wire_id = TournamentId{1},
                                .title = "The demo",
                                .settings = "a = 1",
                                .created = UnixMicros{5}}));
  must(database.add_match(sample_match(1)));
  must(database.add_game(sample_game(1, 0)));
  must(database.add_game(sample_game(2, 1)));
  must(database.commit());
}

}  // namespace poolhall::storage
