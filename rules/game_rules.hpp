// A rule set as data and functions: what the referee asks a game. Each game fills one table in
// its own file; nothing here knows which games there are.
//
//   Verdict verdict = game_rules(ready.settings.rules).judge({ready, call, facts, after, venue});
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "rules/clause.hpp"
#include "rules/fouls.hpp"
#include "rules/game_state.hpp"
#include "rules/rack.hpp"
#include "rules/referee.hpp"
#include "rules/shot_facts.hpp"

namespace poolhall::rules {

// Where a game is played.
struct Venue {
  const physics::Table& table;
  const physics::Materials& materials;
};

// A shot as a game judges it.
struct Shot {
  const GameState& ready;  // before it, the cue ball placed
  const Call& call;
  const ShotFacts& facts;
  const GameState& after;  // `ready` with every ball where the shot left it
  Venue venue;
};

struct Verdict {
  std::vector<FoulRecord> fouls;
  std::vector<Finding> notes;
  std::optional<BallId> first_contact{};
  GameState next;
};

struct GameRules {
  RuleSet id{};
  std::size_t object_balls = 0;                                     // 1 .. object_balls
  std::vector<std::size_t> rack_rows;                               // from the apex
  std::vector<BallId> (*rack_order)(RackRandom& random) = nullptr;  // row by row, left to right
  std::variant<EightBallMemory, NineBallMemory> fresh_memory;
  std::span<const Clause* const> clauses;
  // Whether memory, options and balls down fit each other.
  Expected<void> (*check)(const GameState& state) = nullptr;
  std::vector<BallId> (*callable_balls)(const GameState& state) = nullptr;
  std::vector<BallId> (*first_balls)(const GameState& state) = nullptr;
  std::vector<Call::Kind> (*legal_calls)(const GameState& state) = nullptr;
  Verdict (*judge)(const Shot& shot) = nullptr;
  // What follows a turn that the player to move lost by a foul without a shot.
  Verdict (*lost_turn)(const GameState& state, const Venue& venue) = nullptr;
  // `decision` is one of the state's options.
  GameState (*decide)(const GameState& state, Decision decision, const Venue& venue) = nullptr;
};

[[nodiscard]] const GameRules& game_rules(RuleSet rules);

}  // namespace poolhall::rules
