// What a position is worth before anything is simulated: the probability that the player to move
// wins the game, from the best open pot and from how many balls both have left.
//
//   Outlook outlook(hall, aim_error, dice);
//   double p = outlook.mover_wins(position);
#pragma once

#include <array>
#include <vector>

#include "clients/bots/dice.hpp"
#include "clients/bots/position.hpp"
#include "clients/bots/trial.hpp"

namespace poolhall::bots {

// Chances to win by balls left, under one noise on one table.
struct Prospects {
  static constexpr std::size_t most = 10;
  using Table = std::array<std::array<double, most>, most>;

  // Of a player who has `mine` balls to pot (the 8 included; in nine-ball all that are left), the
  // opponent `theirs`: right after a pot of their own, with a position that they played for ...
  Table in_play{};
  // ... and coming to the table after the opponent's miss.
  Table arriving{};
  // That the shot succeeds, by balls left: in play, arriving, with the ball in hand.
  std::array<double, most> next{};
  std::array<double, most> first{};
  std::array<double, most> in_hand{};
  // Mean ease (Outlook::ease) of the balls to pot.
  std::array<double, most> ease{};
};

class Outlook {
 public:
  // `aim_error`: standard deviation of the heading, rad. Chances come from random layouts.
  Outlook(const Hall& hall, rules::RuleSet rules, double aim_error, Dice dice);

  [[nodiscard]] double mover_wins(const Position& position) const;
  [[nodiscard]] double wins(const Position& position, rules::Seat seat) const;

  // What is left to the player to move who has nothing to pot, or misses.
  [[nodiscard]] double missed(const Position& position) const {
    return with_chance(position, balls_on(position), 0);
  }

  // The open lines to the balls that are on, best first; `lines` is filled anew.
  void find_lines(const Position& position, std::vector<PotLine>& lines) const;

 private:
  [[nodiscard]] double with_chance(const Position& position, BallMask ball, double chance) const;
  // How good the pockets of a ball are, 0..1, wherever the cue ball may come to lie.
  [[nodiscard]] double ease(const Position& position, BallId ball) const;
  // Probability to win of a player in play with `balls` left before the last one, which comes at
  // the end; the opponent has `theirs`.
  [[nodiscard]] double running_out(const Position& position, BallMask balls, BallMask last,
                                   std::size_t theirs) const;
  [[nodiscard]] double at_the_table(const Position& position) const;
  [[nodiscard]] double in_hand(const Position& position) const;
  [[nodiscard]] double choosing(const Position& position) const;
  [[nodiscard]] double breaking() const;
  [[nodiscard]] std::optional<PotLine> open_line(const Position& position, BallId ball,
                                                 const PocketTarget& pocket) const;
  [[nodiscard]] double best_chance(const Position& position) const;
  [[nodiscard]] double mean_ease(const Position& layout) const;
  [[nodiscard]] Position random_layout(int balls, Dice& dice) const;
  void measure_chances(Dice& dice);
  void work_out_prospects();

  const Hall& hall_;
  Layout felt_;  // the table's measures, no balls
  rules::RuleSet rules_;
  double aim_error_;
  Prospects prospects_;
};

}  // namespace poolhall::bots
