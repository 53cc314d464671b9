#include "clients/bots/choosing.hpp"

#include <limits>

#include "clients/bots/random_bot.hpp"

namespace poolhall::bots {
namespace {

// The first of equals. There is one at least.
rules::Decision best_decision(const client::TurnView& turn, const Thoughts& thoughts) {
  rules::Decision best = turn.state.options.front();
  double best_worth = -std::numeric_limits<double>::infinity();
  for (const rules::Decision option : turn.state.options) {
    const auto next = rules::decide(turn.state, option, turn.info.table, turn.info.materials);
    if (!next) {
      continue;
    }
    const double worth = thoughts.worth(*next);
    if (worth > best_worth) {
      best = option;
      best_worth = worth;
    }
  }
  return best;
}

}  // namespace

client::Move chosen_move(const client::TurnView& turn, const Thoughts& thoughts, Dice last_resort) {
  if (turn.state.kind == rules::TurnKind::decision) {
    if (turn.state.options.empty()) {
      return client::Concede{};
    }
    return best_decision(turn, thoughts);
  }
  if (turn.refusals == 0) {
    if (const auto shot = thoughts.best_shot()) {
      return *shot;
    }
  }
  if (const auto shot = random_shot(turn, last_resort)) {
    return *shot;
  }
  return client::Concede{};
}

}  // namespace poolhall::bots
