// Trying a shot out before playing it: the server's physics and the server's referee, under the
// announced noise, with a value for the player in what comes out.
//
//   Rehearsal rehearsal(turn, dice);
//   double mean = rehearsal.value(shot, {.first = 0, .count = 8}).value_or(lost);
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clients/bots/dice.hpp"
#include "clients/bots/pot_lines.hpp"
#include "clients/cpp/player.hpp"
#include "protocol/shot_path.hpp"

namespace poolhall::bots {

// Worth of a position for `seat`, about -1..1 (a won game 2, a lost one -2): who has the table,
// with which rights, how good the best straight pot is, who has fewer balls left.
class PositionValue {
 public:
  PositionValue(const physics::Table& table, const physics::Materials& materials, double aim_error);

  [[nodiscard]] double of(const rules::GameState& state, rules::Seat seat) const;

 private:
  [[nodiscard]] double mover_worth(const rules::GameState& state) const;

  physics::Table table_;
  physics::Materials materials_;
  double aim_error_;
};

// The samples of the noise with these numbers; the same number is the same noise for every shot,
// so that shots are compared in the same luck.
struct SampleRange {
  std::size_t first = 0;
  std::size_t count = 1;
};

class Rehearsal {
 public:
  static constexpr std::size_t max_samples = 64;

  Rehearsal(const client::TurnView& turn, Dice dice);

  // The ruling after `shot` without noise; nothing if it cannot be played.
  [[nodiscard]] std::optional<rules::Ruling> exact(const client::Shot& shot);
  // The value of what comes out without noise.
  [[nodiscard]] std::optional<double> exact_value(const client::Shot& shot);
  // Mean value over samples of the noise; nothing if the shot cannot be played.
  [[nodiscard]] std::optional<double> value(const client::Shot& shot, SampleRange samples);

  [[nodiscard]] const PositionValue& position_value() const { return position_value_; }
  // Events simulated so far: the measure of effort, the same on every machine.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  void add_events(std::uint64_t events) { events_ += events; }

 private:
  [[nodiscard]] std::optional<protocol::ReadyShot> ready(const client::Shot& shot) const;
  [[nodiscard]] std::optional<rules::Ruling> run(const protocol::ReadyShot& ready);

  const client::TurnView& turn_;
  protocol::NoiseParams noise_;
  PositionValue position_value_;
  std::vector<physics::ShotDeviates> deviates_;
  std::uint64_t events_ = 0;
};

// The noise that a bot reckons with: the announced one, or the Olympiad's where none is told.
[[nodiscard]] protocol::NoiseParams reckoned_noise(const client::GameInfo& info);
// Its standard deviation of the heading, in rad.
[[nodiscard]] double aim_error(const client::GameInfo& info);

}  // namespace poolhall::bots
