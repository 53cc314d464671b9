// The house bots by name.
//
//   std::optional<client::PlayerFactory> maker = house_bot("greedy", {.seed = 7});
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cpp/player.hpp"

namespace poolhall::bots {

struct HouseBotSettings {
  std::uint64_t seed = 1;
  // Of greedy, GreedySettings::effort, and of planner, PlannerSettings::effort; unset: their own
  // defaults.
  std::optional<std::uint64_t> effort{};
  unsigned cores = 1;  // that one move of planner may use
};

// Nothing if there is no house bot of that name.
[[nodiscard]] std::optional<client::PlayerFactory> house_bot(std::string_view name,
                                                             const HouseBotSettings& settings);

// Weakest first.
[[nodiscard]] std::vector<std::string> house_bot_names();

}  // namespace poolhall::bots
