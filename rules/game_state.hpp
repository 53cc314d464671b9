// A game between two shots: where the balls are, whose turn it is, what may be done, and what a
// rule set remembers. A plain value; `referee.hpp` makes the next one.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "physics/ball.hpp"
#include "physics/table.hpp"
#include "rules/eight_ball_memory.hpp"
#include "rules/nine_ball_memory.hpp"
#include "rules/seat.hpp"

namespace poolhall::rules {

using physics::BallId;
using physics::PocketId;

enum class RuleSet : std::uint8_t { eight_ball, nine_ball };

// On the wire and in files: "8-ball", "9-ball"; "eight-ball" and "nine-ball" are read too.
[[nodiscard]] std::string_view name(RuleSet rules);
[[nodiscard]] std::optional<RuleSet> rule_set(std::string_view name);

enum class TurnKind : std::uint8_t {
  break_shot,                       // "break": cue ball in hand in the kitchen
  shot,                             // the cue ball lies where it lies
  ball_in_hand,                     // anywhere
  ball_in_hand_behind_head_string,  // in the kitchen; first ball hit must lie outside it
  decision,                         // no shot: one of `options`
};
[[nodiscard]] std::string_view name(TurnKind kind);
[[nodiscard]] std::optional<TurnKind> turn_kind(std::string_view name);

enum class Decision : std::uint8_t {
  accept,               // play on, the table as it lies; a cue ball that is down is then in hand
                        // in the kitchen
  accept_ball_in_hand,  // play on with the cue ball in hand in the kitchen
  rerack_chooser_breaks,
  rerack_breaker_breaks,
  spot_eight,
  shoot,      // nine-ball, after a push-out: the chooser shoots
  pass_back,  // nine-ball, after a push-out: the one who pushed out shoots again
};
[[nodiscard]] std::string_view name(Decision decision);
[[nodiscard]] std::optional<Decision> decision(std::string_view name);

// A cue ball in hand stays where it came to rest, or pocketed or off the table, until it is placed.
enum class Whereabouts : std::uint8_t { on_table, pocketed, off_table };

struct BallPlace {
  BallId id{};
  Whereabouts where = Whereabouts::on_table;
  physics::Vec2<double> position{};  // m, when on_table
  PocketId pocket{};                 // when pocketed

  friend bool operator==(const BallPlace&, const BallPlace&) = default;
};

// How a game ended; every one has a stable name on the wire.
enum class EndReason : std::uint8_t {
  eight_pocketed,      // 8-ball: the 8 legally pocketed in the called pocket
  eight_early,         // the 8 pocketed before the group was cleared
  eight_wrong_pocket,  // the 8 in another pocket than called
  eight_with_last,     // the 8 on the stroke of the group's last ball
  eight_on_safety,     // the 8 pocketed on a declared safety
  eight_on_foul,       // the 8 pocketed with a foul
  eight_off_table,     // the 8 driven off the table
  nine_pocketed,       // nine-ball: the 9 legally pocketed
  three_fouls,         // nine-ball: three fouls in a row
  stalemate,           // drawn: a second stalemate
  conceded,
  timeout,    // game clock at zero
  forfeit,    // did not come, or was withdrawn
  void_game,  // a server fault: not scored, played again
};
[[nodiscard]] std::string_view name(EndReason reason);
[[nodiscard]] std::optional<EndReason> end_reason(std::string_view name);

struct GameResult {
  std::optional<Seat> winner{};  // unset: drawn or void
  EndReason reason = EndReason::conceded;

  friend bool operator==(const GameResult&, const GameResult&) = default;
};

// Everything fixed for a game before its first turn.
struct GameSettings {
  RuleSet rules = RuleSet::eight_ball;
  Seat breaker = Seat::first;
  std::uint64_t rack_seed = 0;  // below 2^53, so that every JSON reader keeps it
  double rack_gap = 0;          // m between the surfaces of neighbours in the rack
  double rack_jitter = 0;       // m, largest seeded displacement of a ball in x and in y; the
                                // rack is opened where the gap leaves no room for it

  friend bool operator==(const GameSettings&, const GameSettings&) = default;
};

struct GameState {
  GameSettings settings;
  std::vector<BallPlace> balls;  // ascending ids; 0 is the cue ball
  Seat to_move = Seat::first;
  std::uint32_t turn = 1;  // grows by one with every turn, decisions too
  TurnKind kind = TurnKind::break_shot;
  Seat breaker = Seat::first;     // of the current rack
  std::uint32_t rack = 1;         // racks so far in this game
  std::vector<Decision> options;  // when kind is decision
  std::uint32_t turns_without_pocket = 0;
  std::uint32_t stalemates = 0;
  std::variant<EightBallMemory, NineBallMemory> memory;
  std::optional<GameResult> result{};  // set when the game is over

  friend bool operator==(const GameState&, const GameState&) = default;
};

// The place of ball `id`; nothing if the game has no such ball.
[[nodiscard]] const BallPlace* find_ball(const GameState& state, BallId id);

}  // namespace poolhall::rules
