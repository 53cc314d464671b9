// Where planner's shots come from: pots along lines with many strokes, a sweep of headings all
// around (banks, kicks, combinations and safeties), breaks.
//
//   std::vector<Plan> plans = pot_plans(position, sources);
#pragma once

#include <vector>

#include "clients/bots/dice.hpp"
#include "clients/bots/outlook.hpp"
#include "clients/bots/pot_strokes.hpp"
#include "clients/bots/workshop.hpp"

namespace poolhall::bots {

// A shot, the position that it is played from, and what it is worth so far: the probability that
// the player wins.
struct Plan {
  client::Shot shot{};
  Position ready{};  // the cue ball in its place
  double value = 0;
  std::vector<float> results{};  // by sample of the noise
};

struct PlanSources {
  const Hall& hall;
  const Outlook& outlook;
  const physics::NoiseLevel& noise;
  Workshop& workshop;
};

// Places for the cue ball in hand from which pots are likely, best first.
[[nodiscard]] std::vector<Point> good_places(const Position& position, const PlanSources& sources,
                                             std::size_t most);

// Each with its value without noise, weighted by the line's chance.
[[nodiscard]] std::vector<Plan> pot_plans(const Position& position, const PlanSources& sources);

// Strokes at `headings` headings and several speeds, as a safety (in nine-ball without a call), as
// a push-out where that is allowed, and as every pot that one makes. Values are smoothed over the
// neighbours as the noise of the heading does.
[[nodiscard]] std::vector<Plan> sweep_plans(const Position& position, const PlanSources& sources,
                                            std::size_t headings);

[[nodiscard]] std::vector<Plan> break_plans(const Position& position, const PlanSources& sources,
                                            Dice dice, std::size_t count);

}  // namespace poolhall::bots
