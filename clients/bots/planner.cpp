#include "clients/bots/planner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "clients/bots/random_bot.hpp"

namespace poolhall::bots {
namespace {

constexpr std::size_t deviates_count = 4096;
constexpr std::size_t block = 16;  // of the deviates' strata
constexpr std::size_t most_compared = 16;
constexpr std::size_t most_samples = 256;
constexpr std::size_t look_ahead_samples = 6;
// A plan is dropped when it is worse than the best by so many standard errors of the difference.
constexpr double sure = 2.5;
// Below this probability to win no pot is taken without a look around.
constexpr double look_around_below = 0.97;

enum class Purpose : std::uint32_t { layouts, deviates, breaks };

physics::NoiseLevel level_of(const protocol::NoiseParams& noise) {
  constexpr double degree = std::numbers::pi / 180;
  return {noise.a / 1000, noise.b / 1000, noise.theta * degree, noise.phi * degree, noise.v};
}

bool is_silent(const physics::NoiseLevel& noise) {
  return noise.a == 0 && noise.b == 0 && noise.theta == 0 && noise.phi == 0 && noise.speed == 0;
}

Dice dice_of(Dice::Key key, Purpose purpose, std::uint32_t number = 0) {
  return Dice(key, 0x80000000U + 16 * number + static_cast<std::uint32_t>(purpose));
}

std::vector<physics::ShotDeviates> drawn_deviates(Dice dice) {
  return stratified_deviates(deviates_count, dice);
}

void update(Plan& plan) {
  double sum = 0;
  for (const float result : plan.results) {
    sum += result;
  }
  plan.value = sum / static_cast<double>(std::max<std::size_t>(plan.results.size(), 1));
}

void best_first(std::vector<Plan>& plans) {
  std::ranges::stable_sort(plans, std::ranges::greater{}, &Plan::value);
}

// Whether `plan` is worse than `best` beyond doubt: both met the same samples.
bool is_beaten(const Plan& plan, const Plan& best) {
  const std::size_t n = std::min(plan.results.size(), best.results.size());
  if (n < 2) {
    return false;
  }
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = static_cast<double>(best.results[i]) - static_cast<double>(plan.results[i]);
    sum += d;
    squares += d * d;
  }
  const auto count = static_cast<double>(n);
  const double mean = sum / count;
  const double variance = std::max(squares / count - mean * mean, 0.0) / (count - 1);
  return mean > sure * std::sqrt(variance) + 1e-4;
}

}  // namespace

Planner::Planner(const client::GameInfo& info, const protocol::NoiseParams& noise, Dice::Key key,
                 unsigned cores)
    : hall_(info.table, info.materials),
      noise_(level_of(noise)),
      key_(key),
      deviates_(drawn_deviates(dice_of(key, Purpose::deviates))),
      outlook_(hall_, info.rules, noise_.phi, dice_of(key, Purpose::layouts)),
      look_ahead_(outlook_, noise_, deviates_,
                  {.samples = is_silent(noise_) ? 1U : look_ahead_samples}),
      workshop_(hall_, cores) {}

double Planner::mover_wins(const rules::GameState& state) {
  return look_ahead_.mover_wins(position_of(state), workshop_.first(), 0);
}

Planner::Plans Planner::plans_for(const Position& position, const Budget& budget) {
  const PlanSources sources{hall_, outlook_, noise_, workshop_};
  Plans plans = pot_plans(position, sources);
  const bool in_hand = is_ball_in_hand(position.kind);
  if (!plans.empty() && (in_hand || plans.front().value > look_around_below)) {
    return plans;
  }
  const auto headings = std::clamp<std::uint64_t>(budget.effort / 300, 180, 1'440);
  if (!in_hand) {
    std::ranges::move(sweep_plans(position, sources, headings), std::back_inserter(plans));
    return plans;
  }
  for (const Point& place : good_places(position, sources, 4)) {
    Position ready = *with_cue_ball(position, place, hall_);
    for (Plan& plan : sweep_plans(ready, sources, headings / 4)) {
      plan.shot.cue_ball = place;
      plans.push_back(std::move(plan));
    }
  }
  return plans;
}

// Brings every plan to `samples` results, unless the deadline comes first.
bool Planner::meet_noise(Plans& plans, std::size_t samples, Depth depth) {
  struct Item {
    std::size_t plan;
    std::size_t sample;
  };
  const std::size_t needed = is_silent(noise_) ? 1 : samples;  // all would be the same
  std::vector<Item> items;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    for (std::size_t i = plans[p].results.size(); i < needed; ++i) {
      items.push_back({p, i});
    }
  }
  std::vector<float> found(items.size());
  const bool all = workshop_.for_each(items.size(), [&](Trial& trial, std::size_t k) {
    const Plan& plan = plans[items[k].plan];
    const std::size_t i = items[k].sample;
    const Position next = trial.noisy(plan.ready, plan.shot.stroke, plan.shot.call, noise_,
                                      deviates_[i % deviates_.size()]);
    const rules::Seat seat = plan.ready.to_move;
    const double wins = depth == Depth::outlook ? outlook_.wins(next, seat)
                                                : look_ahead_.wins(next, seat, trial, i);
    found[k] = static_cast<float>(wins);
  });
  if (!all) {
    return false;
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    plans[items[k].plan].results.push_back(found[k]);
  }
  for (Plan& plan : plans) {
    update(plan);
  }
  return true;
}

bool Planner::weed(Plans& plans, const std::vector<Round>& rounds) {
  best_first(plans);
  for (const Round& round : rounds) {
    plans.resize(std::min(plans.size(), round.keep));
    if (!meet_noise(plans, round.samples, Depth::outlook)) {
      return false;
    }
    best_first(plans);
  }
  return true;
}

// Plans that are worse beyond doubt go, the others meet more noise, until one is left or the effort
// is used up.
void Planner::compare(Plans& plans, std::uint64_t until) {
  for (Plan& plan : plans) {
    plan.results.clear();
  }
  for (std::size_t samples = block; samples <= most_samples && plans.size() > 1; samples += block) {
    if (!meet_noise(plans, samples, Depth::look_ahead)) {
      return;
    }
    best_first(plans);
    const Plan best = plans.front();
    std::erase_if(plans, [&](const Plan& plan) { return is_beaten(plan, best); });
    if (workshop_.events() >= until) {
      return;
    }
  }
}

// Breaks come in batches: whenever the time is up the best of those that have met enough noise is
// at hand.
std::optional<client::Shot> Planner::best_break(const Position& position, std::uint64_t until) {
  constexpr std::size_t batch_size = 64;
  constexpr std::uint32_t most_batches = 12;
  constexpr std::size_t kept_of_a_batch = 2;
  const PlanSources sources{hall_, outlook_, noise_, workshop_};
  Plans best;
  for (std::uint32_t batch = 0; batch < most_batches; ++batch) {
    Plans plans = break_plans(position, sources, dice_of(key_, Purpose::breaks, batch), batch_size);
    const bool all = weed(plans, {{batch_size, 8}, {24, 16}, {12, 32}, {4, 64}});
    plans.resize(std::min(plans.size(), kept_of_a_batch));
    if (all || best.empty()) {
      std::ranges::move(plans, std::back_inserter(best));
    }
    if (!all || workshop_.events() >= until) {
      break;
    }
  }
  (void)weed(best, {{most_batches * kept_of_a_batch, 128}, {8, 256}});
  return best.empty() ? std::nullopt : std::optional{best.front().shot};
}

std::optional<client::Shot> Planner::best_shot(const rules::GameState& state,
                                               const Budget& budget) {
  workshop_.set_deadline(budget.deadline);
  const std::uint64_t begin = workshop_.events();
  const Position position = position_of(state);
  if (position.kind == rules::TurnKind::break_shot) {
    return best_break(position, begin + budget.effort * 3 / 4);
  }
  Plans plans = plans_for(position, budget);
  if (plans.empty()) {
    return std::nullopt;
  }
  (void)weed(plans, {{160, 4}, {80, 8}, {40, 16}});
  plans.resize(std::min(plans.size(), most_compared));
  if (workshop_.events() - begin < budget.effort) {
    compare(plans, begin + budget.effort);
  }
  return plans.front().shot;
}

}  // namespace poolhall::bots
