// The turns that follow one another in every game: who moves next, racks, stalemate.
#pragma once

#include <vector>

#include "rules/game_rules.hpp"

namespace poolhall::rules {

[[nodiscard]] GameState turn_for(GameState state, Seat to_move, TurnKind kind);
[[nodiscard]] GameState decision_for(GameState state, Seat chooser, std::vector<Decision> options);
[[nodiscard]] GameState game_over(GameState state, const GameResult& result);

// The first or the next rack of a game: balls racked, cue ball in hand, nothing remembered.
[[nodiscard]] GameState racked(GameState state, Seat breaker, const Venue& venue);

// The opponent's turn after the turn of `verdict.next` was lost without a shot.
[[nodiscard]] Verdict after_lost_turn(Verdict verdict);

// Decisions that every game knows; nothing for the others.
[[nodiscard]] std::optional<GameState> decided_commonly(const GameState& state, Decision decision,
                                                        const Venue& venue);

// Counts turns without a ball pocketed since `before`, and what follows from too many.
[[nodiscard]] Verdict with_stalemate(Verdict verdict, const GameState& before,
                                     std::uint32_t turns_without_pocket, const Venue& venue);

// Turns in a row without a ball pocketed that make a stalemate.
inline constexpr std::uint32_t stalemate_turns = 30;

[[nodiscard]] bool on_table(const GameState& state, BallId ball);
// Ids of the object balls on the table, ascending.
[[nodiscard]] std::vector<BallId> object_balls_on_table(const GameState& state);

}  // namespace poolhall::rules
