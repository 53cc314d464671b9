// The house bot of middling strength. It tries every own ball and pocket by the ghost ball, with
// the ball in hand from many places, rehearses each candidate under the announced noise and plays
// the best; where no pot is good enough, the best of many rehearsed safeties. It looks no further
// than the position that a shot leaves.
//
//   std::unique_ptr<client::Player> player = std::make_unique<GreedyBot>(info, GreedySettings{});
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/bots/dice.hpp"
#include "clients/bots/rehearsal.hpp"
#include "clients/cpp/player.hpp"

namespace poolhall::bots {

struct GreedySettings {
  std::uint64_t seed = 1;
  // Simulated events a shot may cost, about: the measure of thinking time that does not depend
  // on the machine. Less is used as the clock runs down.
  std::uint64_t effort = 60'000;
};

// A shot and what it is worth (rehearsal.hpp).
struct Candidate {
  client::Shot shot;
  double value = 0;
  std::size_t samples = 0;  // that the value is the mean of; 0: simulated without noise
};

class GreedyBot : public client::Player {
 public:
  GreedyBot(const client::GameInfo& info, const GreedySettings& settings);

  [[nodiscard]] client::Move choose(const client::TurnView& turn) override;

 private:
  [[nodiscard]] std::optional<Candidate> best_shot(const client::TurnView& turn) const;

  GreedySettings settings_;
  Dice::Key key_;
};

// The effort that the clock allows: the full one while there is time for forty such shots.
[[nodiscard]] std::uint64_t affordable_effort(std::uint64_t effort,
                                              std::chrono::microseconds own_time);

}  // namespace poolhall::bots
