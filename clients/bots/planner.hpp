// The search for a shot: many plans, weeded out under samples of the noise, first by what a
// position looks like, then by a small search of the shot after.
//
//   Planner planner(info, {.seed = 1, .cores = 4});
//   std::optional<client::Shot> shot = planner.best_shot(state, {.effort = 300'000});
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/bots/look_ahead.hpp"
#include "clients/bots/outlook.hpp"
#include "clients/bots/plans.hpp"
#include "clients/bots/workshop.hpp"

namespace poolhall::bots {

struct Budget {
  std::uint64_t effort = 500'000;  // simulated events, about
  std::optional<Workshop::Instant> deadline{};
};

class Planner {
 public:
  Planner(const client::GameInfo& info, const protocol::NoiseParams& noise, Dice::Key key,
          unsigned cores);
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  // Nothing where no shot was found in the time.
  [[nodiscard]] std::optional<client::Shot> best_shot(const rules::GameState& state,
                                                      const Budget& budget);
  // Probability that the player to move wins, looked at a little deeper than Outlook does.
  [[nodiscard]] double mover_wins(const rules::GameState& state);

  // Events simulated so far.
  [[nodiscard]] std::uint64_t events() const { return workshop_.events(); }

 private:
  using Plans = std::vector<Plan>;
  // How a plan's sample is judged.
  enum class Depth : std::uint8_t { outlook, look_ahead };
  struct Round {
    std::size_t keep = 0;     // plans that go into it
    std::size_t samples = 0;  // that each has met after it
  };

  [[nodiscard]] std::optional<client::Shot> best_break(const Position& position,
                                                       std::uint64_t until);
  [[nodiscard]] Plans plans_for(const Position& position, const Budget& budget);
  [[nodiscard]] bool meet_noise(Plans& plans, std::size_t samples, Depth depth);
  // Says whether all rounds were played before the deadline.
  bool weed(Plans& plans, const std::vector<Round>& rounds);
  void compare(Plans& plans, std::uint64_t until);

  Hall hall_;
  physics::NoiseLevel noise_;
  Dice::Key key_;
  std::vector<physics::ShotDeviates> deviates_;
  Outlook outlook_;
  LookAhead look_ahead_;
  Workshop workshop_;
};

}  // namespace poolhall::bots
