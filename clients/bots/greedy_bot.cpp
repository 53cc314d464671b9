#include "clients/bots/greedy_bot.hpp"

#include <algorithm>

#include "clients/bots/candidates.hpp"
#include "clients/bots/choosing.hpp"

namespace poolhall::bots {
namespace {

// Below this value a pot is compared with safeties.
constexpr double good_pot = 0.35;
constexpr std::uint64_t least_effort = 1'500;
// Shots that a game may still need, and what an event may cost on a slow machine.
constexpr std::int64_t shots_to_come = 40;
constexpr std::int64_t microseconds_per_event = 4;

// Streams of the dice within a turn.
enum class Stream : std::uint32_t { noise, headings, last_resort };

Dice dice_for(Dice::Key key, const client::TurnView& turn, Stream stream) {
  return Dice(key, (turn.state.turn * 8 + turn.refusals) * 4 + static_cast<std::uint32_t>(stream));
}

bool is_better(const std::optional<Candidate>& p, const std::optional<Candidate>& q) {
  return p && (!q || p->value > q->value);
}

}  // namespace

std::uint64_t affordable_effort(std::uint64_t effort, std::chrono::microseconds own_time) {
  const std::int64_t a_shot = std::max<std::int64_t>(own_time.count(), 0) / shots_to_come;
  const auto events = static_cast<std::uint64_t>(a_shot / microseconds_per_event);
  return std::clamp(events, std::min(least_effort, effort), effort);
}

GreedyBot::GreedyBot(const client::GameInfo& info, const GreedySettings& settings)
    : settings_(settings), key_(Dice::key(settings.seed, info.game)) {}

std::optional<Candidate> GreedyBot::best_shot(const client::TurnView& turn) const {
  const std::uint64_t effort = affordable_effort(settings_.effort, turn.clock.own);
  Rehearsal rehearsal(turn, dice_for(key_, turn, Stream::noise));
  if (turn.state.kind == rules::TurnKind::break_shot) {
    return most_valuable(breaks(turn, rehearsal, effort / 3), rehearsal, effort);
  }
  auto best = most_valuable(straight_pots(turn, rehearsal, effort / 4), rehearsal, effort / 2);
  if (!best || best->value < good_pot) {
    Dice dice = dice_for(key_, turn, Stream::headings);
    const std::uint64_t spent = rehearsal.events();
    const std::uint64_t left = std::max(effort, spent) - spent;
    const auto other =
        most_valuable(all_around(turn, rehearsal, dice, spent + left / 2), rehearsal, spent + left);
    if (is_better(other, best)) {
      best = other;
    }
  }
  return best;
}

client::Move GreedyBot::choose(const client::TurnView& turn) {
  const PositionValue value(turn.info.table, turn.info.materials, aim_error(turn.info));
  const auto worth = [&](const rules::GameState& next) { return value.of(next, turn.info.seat); };
  const auto shot = [&] {
    const auto best = best_shot(turn);
    return best ? std::optional(best->shot) : std::nullopt;
  };
  return chosen_move(turn, {worth, shot}, dice_for(key_, turn, Stream::last_resort));
}

}  // namespace poolhall::bots
