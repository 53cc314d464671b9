// A game between two shots, small enough to be copied a million times a second: what the planner
// searches over. Plans only: the referee (rules/) has the last word. Stalemates are left out.
//
//   Position position = position_of(turn.state);
//   BallMask mine = balls_on(position);
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "clients/bots/pot_lines.hpp"
#include "rules/game_state.hpp"

namespace poolhall::bots {

// A set of balls, a bit for each number.
using BallMask = std::uint16_t;

[[nodiscard]] constexpr BallMask only(BallId ball) {
  return static_cast<BallMask>(1U << physics::number(ball));
}
inline constexpr BallMask solids = 0x00FE;
inline constexpr BallMask stripes = 0xFE00;
inline constexpr BallMask the_eight = 0x0100;
inline constexpr BallMask the_nine = 0x0200;

// What is to be decided when the turn is a decision.
enum class Choice : std::uint8_t {
  none,
  illegal_break,    // the opponent of the breaker: accept, or rerack and either breaks
  break_foul,       // the opponent of the breaker: accept, or ball in hand in the kitchen
  eight_on_break,   // the breaker: spot the 8, or break again
  eight_with_foul,  // the opponent: spot the 8 with ball in hand in the kitchen, or break
  push_out,         // the opponent: shoot, or pass the shot back
};

struct Position {
  std::array<Point, physics::max_balls> at{};  // m, by number, of the balls on the table
  BallMask on_table = 0;
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  rules::Seat to_move = rules::Seat::first;
  rules::Seat breaker = rules::Seat::first;
  rules::TurnKind kind = rules::TurnKind::shot;
  Choice choice = Choice::none;
  std::optional<rules::Group> first_group{};     // of the first seat; unset: open table
  std::array<std::uint8_t, 2> fouls_in_a_row{};  // nine-ball, by seat
  bool push_out_allowed = false;
  bool is_over = false;
  std::optional<rules::Seat> winner{};

  [[nodiscard]] bool has(BallMask balls) const { return (on_table & balls) != 0; }
  [[nodiscard]] Point cue() const { return at[0]; }
};

[[nodiscard]] Position position_of(const rules::GameState& state);

// Group of the player in `seat`, as a set of balls; nothing while the table is open.
[[nodiscard]] std::optional<BallMask> group_balls(const Position& position, rules::Seat seat);

// The balls that the player to move must strike first; in 8-ball also those that may be called.
[[nodiscard]] BallMask balls_on(const Position& position);

// How many balls a player with the group `mine` has to pot, the 8 included.
[[nodiscard]] int left_of(const Position& position, BallMask mine);

// Balls of a position as the simulator wants them: those on the table, at rest.
[[nodiscard]] physics::BallSet<double> ball_set(const Position& position);

// The position with `ball` back on the long string, at the foot spot or behind it.
[[nodiscard]] Position with_spotted(Position position, BallId ball, const physics::Table& table,
                                    double radius);

}  // namespace poolhall::bots
