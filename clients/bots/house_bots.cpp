#include "clients/bots/house_bots.hpp"

#include <memory>

#include "clients/bots/greedy_bot.hpp"
#include "clients/bots/planner_bot.hpp"
#include "clients/bots/random_bot.hpp"

namespace poolhall::bots {

std::optional<client::PlayerFactory> house_bot(std::string_view name,
                                               const HouseBotSettings& settings) {
  if (name == "random") {
    return [settings](const client::GameInfo& info) -> std::unique_ptr<client::Player> {
      return std::make_unique<RandomBot>(info, settings.seed);
    };
  }
  if (name == "greedy") {
    return [settings](const client::GameInfo& info) -> std::unique_ptr<client::Player> {
      GreedySettings greedy{.seed = settings.seed};
      greedy.effort = settings.effort.value_or(greedy.effort);
      return std::make_unique<GreedyBot>(info, greedy);
    };
  }
  if (name == "planner") {
    return [settings](const client::GameInfo& info) -> std::unique_ptr<client::Player> {
      return std::make_unique<PlannerBot>(
          info, PlannerSettings{
                    .seed = settings.seed, .effort = settings.effort, .cores = settings.cores});
    };
  }
  return std::nullopt;
}

std::vector<std::string> house_bot_names() {
  return {"random", "greedy", "planner"};
}

}  // namespace poolhall::bots
