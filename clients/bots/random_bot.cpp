#include "clients/bots/random_bot.hpp"

#include <numbers>

#include "clients/bots/stroke.hpp"

namespace poolhall::bots {
namespace {

constexpr int most_draws = 1000;

rules::Call random_call(const rules::GameState& state, Dice& dice) {
  if (state.settings.rules != rules::RuleSet::eight_ball ||
      state.kind == rules::TurnKind::break_shot) {
    return {};
  }
  const auto balls = rules::callable_balls(state);
  if (balls.empty()) {
    return {.kind = rules::Call::Kind::safety};
  }
  return {.kind = rules::Call::Kind::pocket,
          .ball = balls[dice.below(balls.size())],
          .pocket = static_cast<physics::PocketId>(dice.below(physics::pocket_count))};
}

}  // namespace

std::optional<physics::Vec2<double>> random_placement(const client::TurnView& turn, Dice& dice) {
  if (!is_ball_in_hand(turn.state.kind)) {
    return std::nullopt;
  }
  const double radius = turn.info.materials.ball_radius;
  const auto& table = turn.info.table;
  const double y_end =
      turn.state.kind == rules::TurnKind::ball_in_hand ? table.length - radius : table.head_string;
  return physics::Vec2<double>{dice.uniform(radius, table.width - radius),
                               dice.uniform(radius, y_end)};
}

std::optional<client::Shot> random_shot(const client::TurnView& turn, Dice& dice) {
  for (int draw = 0; draw < most_draws; ++draw) {
    client::Shot shot;
    shot.cue_ball = random_placement(turn, dice);
    shot.call = random_call(turn.state, dice);
    const StrokeWish wish{.phi = dice.uniform(0, 2 * std::numbers::pi),
                          .speed = dice.uniform(0.5, 6)};
    const auto ready = rules::prepare_shot(turn.state, shot.call, shot.cue_ball, turn.info.table,
                                           turn.info.materials);
    if (!ready) {
      continue;
    }
    const auto stroke =
        clear_stroke(wish, rules::balls_on_table(*ready), turn.info.table, turn.info.materials);
    if (stroke) {
      shot.stroke = *stroke;
      return shot;
    }
  }
  return std::nullopt;
}

RandomBot::RandomBot(const client::GameInfo& info, std::uint64_t seed)
    : key_(Dice::key(seed, info.game)) {}

client::Move RandomBot::choose(const client::TurnView& turn) {
  // A refused move is not drawn again: refusals move to streams of their own.
  Dice dice(key_, turn.state.turn * 8 + turn.refusals);
  if (turn.state.kind == rules::TurnKind::decision) {
    if (turn.state.options.empty()) {
      return client::Concede{};
    }
    return turn.state.options[dice.below(turn.state.options.size())];
  }
  const auto shot = random_shot(turn, dice);
  if (!shot) {
    return client::Concede{};
  }
  return *shot;
}

}  // namespace poolhall::bots
