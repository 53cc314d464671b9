#include "clients/bots/thinking_time.hpp"

#include <algorithm>
#include <bit>

#include "clients/bots/position.hpp"

namespace poolhall::bots {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// Kept for the way of the answer, and for a machine that does something else for a moment.
constexpr microseconds least_reserve = milliseconds{150};
constexpr int reserve_share = 20;  // of the clock: a twentieth
// Shots beyond one for each ball that is left: misses, safeties, the opponent's good ones.
constexpr int shots_beside = 4;

int shots_ahead(const rules::GameState& state) {
  const Position position = position_of(state);
  if (position.rules == rules::RuleSet::nine_ball) {
    return std::popcount(static_cast<unsigned>(position.on_table & ~1U)) + shots_beside;
  }
  return left_of(position, group_balls(position, state.to_move).value_or(solids)) + shots_beside;
}

}  // namespace

std::chrono::microseconds thinking_time(const client::TurnView& turn) {
  const microseconds own = turn.clock.own;
  const microseconds reserve = std::max(least_reserve, own / reserve_share);
  microseconds time = (own - reserve) / shots_ahead(turn.state) + turn.info.increment * 9 / 10;
  time = std::min({time, own - reserve, microseconds{longest_thought}});
  if (turn.info.shot_cap) {
    const microseconds cap = *turn.info.shot_cap;
    time = std::min(time, cap - std::max(least_reserve, cap / reserve_share));
  }
  return std::max(time, microseconds{0});
}

}  // namespace poolhall::bots
