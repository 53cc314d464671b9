#include "clients/bots/planner_bot.hpp"

#include <algorithm>

#include "clients/bots/choosing.hpp"
#include "clients/bots/noise_guess.hpp"
#include "clients/bots/rehearsal.hpp"
#include "clients/bots/thinking_time.hpp"

namespace poolhall::bots {
namespace {

// Simulated events a second on a core, before any have been counted.
constexpr double first_guess = 8e5;
constexpr double shortest_measured = 0.02;  // s

}  // namespace

PlannerBot::PlannerBot(const client::GameInfo& info, const PlannerSettings& settings)
    : settings_(settings),
      key_(Dice::key(settings.seed, info.game)),
      noise_(reckoned_noise(info)),
      planner_(std::make_unique<Planner>(info, noise_, key_, settings.cores)),
      events_a_second_(first_guess * std::max(1U, settings.cores)) {}

// The effort is bounded by the time, as events are reckoned to pass; the deadline is for machines
// that turn out to be slower.
std::optional<client::Shot> PlannerBot::best_shot(const client::TurnView& turn) {
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::microseconds time = thinking_time(turn);
  const double seconds = std::chrono::duration<double>(time).count();
  const auto affordable = static_cast<std::uint64_t>(seconds * events_a_second_);
  const std::uint64_t before = planner_->events();
  auto shot = planner_->best_shot(turn.state, {.effort = settings_.effort.value_or(affordable),
                                               .deadline = begin + time * 5 / 4});
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (took > shortest_measured) {
    const double rate = static_cast<double>(planner_->events() - before) / took;
    events_a_second_ += (rate - events_a_second_) / 3;
  }
  return shot;
}

void PlannerBot::reckon_noise(const client::TurnView& turn) {
  constexpr double worth_while = 1.15;  // ratio of the factors
  if (turn.info.noise) {
    return;
  }
  const protocol::NoiseParams guess = guessed_noise(turn.shots);
  constexpr double least = 1e-3;  // degrees; less is no noise at all
  const double ratio = (guess.phi + least) / (noise_.phi + least);
  if (ratio > worth_while || ratio < 1 / worth_while) {
    noise_ = guess;
    planner_ = std::make_unique<Planner>(turn.info, noise_, key_, settings_.cores);
  }
}

client::Move PlannerBot::choose(const client::TurnView& turn) {
  reckon_noise(turn);
  const auto worth = [&](const rules::GameState& next) {
    const double mover = planner_->mover_wins(next);
    return next.to_move == turn.info.seat ? mover : 1 - mover;
  };
  const auto shot = [&] { return best_shot(turn); };
  return chosen_move(turn, {worth, shot}, Dice(key_, turn.state.turn * 8 + turn.refusals));
}

}  // namespace poolhall::bots
