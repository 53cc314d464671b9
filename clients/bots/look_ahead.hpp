// What a position is worth to the player to move, by a small search of the next shot: a few
// strokes on the best lines, played under a few samples of the noise.
//
//   LookAhead look_ahead(outlook, noise, deviates, {});
//   double p = look_ahead.mover_wins(position, trial, salt);
#pragma once

#include <span>

#include "clients/bots/outlook.hpp"
#include "clients/bots/pot_strokes.hpp"
#include "clients/bots/trial.hpp"

namespace poolhall::bots {

struct LookAheadSettings {
  std::size_t lines = 3;      // tried, best first
  std::size_t finalists = 3;  // strokes that meet the noise
  std::size_t samples = 6;    // of it
};

class LookAhead {
 public:
  LookAhead(const Outlook& outlook, const physics::NoiseLevel& noise,
            std::span<const physics::ShotDeviates> deviates, const LookAheadSettings& settings)
      : outlook_(outlook), noise_(noise), deviates_(deviates), settings_(settings) {}

  // Probability that the player to move wins. `salt` picks the samples of the noise.
  [[nodiscard]] double mover_wins(const Position& position, Trial& trial, std::size_t salt) const;
  [[nodiscard]] double wins(const Position& position, rules::Seat seat, Trial& trial,
                            std::size_t salt) const;

 private:
  struct Stroke {
    protocol::ShotParams params{};
    rules::Call call{};
    double value = 0;
  };
  [[nodiscard]] std::vector<Stroke> strokes(const Position& position, Trial& trial) const;

  const Outlook& outlook_;
  physics::NoiseLevel noise_;
  std::span<const physics::ShotDeviates> deviates_;
  LookAheadSettings settings_;
  StrokeGrid grid_ = narrow_grid();
};

// The call that goes with a ball and a pocket; in nine-ball none.
[[nodiscard]] rules::Call call_of(const Position& position, BallId ball, PocketId pocket);
[[nodiscard]] rules::Call safety_of(const Position& position);

}  // namespace poolhall::bots
