#include "clients/bots/rehearsal.hpp"

#include <algorithm>
#include <numbers>

namespace poolhall::bots {
namespace {

constexpr double won = 2;
constexpr double with_ball_in_hand = 0.9;
constexpr double with_ball_in_kitchen = 0.55;
constexpr double with_choice = 0.5;
constexpr double with_break = 0.35;
constexpr double with_table = 0.1;     // and nothing to pot
constexpr double with_sure_pot = 0.8;  // the table and a pot that cannot fail
constexpr double per_ball = 0.03;

int balls_left(const rules::GameState& state, rules::Group group) {
  return static_cast<int>(std::ranges::count_if(state.balls, [&](const rules::BallPlace& ball) {
    const unsigned n = physics::number(ball.id);
    const bool mine = group == rules::Group::solids ? n >= 1 && n <= 7 : n >= 9;
    return mine && ball.where == rules::Whereabouts::on_table;
  }));
}

// How many balls fewer the player in `seat` has to pot than the opponent.
int lead_in_balls(const rules::GameState& state, rules::Seat seat) {
  const auto* memory = std::get_if<rules::EightBallMemory>(&state.memory);
  if (memory == nullptr || !memory->first_seat_group) {
    return 0;
  }
  const int solids = balls_left(state, rules::Group::solids);
  const int stripes = balls_left(state, rules::Group::stripes);
  const bool has_solids =
      (*memory->first_seat_group == rules::Group::solids) == (seat == rules::Seat::first);
  return has_solids ? stripes - solids : solids - stripes;
}

}  // namespace

PositionValue::PositionValue(const physics::Table& table, const physics::Materials& materials,
                             double aim_error)
    : table_(table), materials_(materials), aim_error_(aim_error) {}

double PositionValue::mover_worth(const rules::GameState& state) const {
  switch (state.kind) {
    case rules::TurnKind::break_shot:
      return with_break;
    case rules::TurnKind::ball_in_hand:
      return with_ball_in_hand;
    case rules::TurnKind::ball_in_hand_behind_head_string:
      return with_ball_in_kitchen;
    case rules::TurnKind::decision:
      return with_choice;
    case rules::TurnKind::shot:
      break;
  }
  const Layout layout = layout_of(state, table_, materials_);
  const auto cue = std::ranges::find(layout.balls, physics::cue_ball, &physics::Ball<double>::id);
  if (cue == layout.balls.end()) {
    return with_table;
  }
  const auto targets = target_balls(state);
  const auto lines = pot_lines(layout, cue->position, targets, aim_error_);
  const double best = lines.empty() ? 0.0 : lines.front().chance;
  return with_table + (with_sure_pot - with_table) * best;
}

double PositionValue::of(const rules::GameState& state, rules::Seat seat) const {
  if (state.result) {
    if (!state.result->winner) {
      return 0;
    }
    return *state.result->winner == seat ? won : -won;
  }
  const double worth = mover_worth(state);
  return (state.to_move == seat ? worth : -worth) + per_ball * lead_in_balls(state, seat);
}

protocol::NoiseParams reckoned_noise(const client::GameInfo& info) {
  return info.noise ? *info.noise : protocol::noise_preset("olympiad").value();
}

double aim_error(const client::GameInfo& info) {
  return reckoned_noise(info).phi * std::numbers::pi / 180;
}

Rehearsal::Rehearsal(const client::TurnView& turn, Dice dice)
    : turn_(turn),
      noise_(reckoned_noise(turn.info)),
      position_value_(turn.info.table, turn.info.materials, aim_error(turn.info)) {
  deviates_.reserve(max_samples);
  for (std::size_t i = 0; i < max_samples; ++i) {
    deviates_.push_back(dice.deviates());
  }
}

std::optional<protocol::ReadyShot> Rehearsal::ready(const client::Shot& shot) const {
  auto ready = protocol::ready_shot(turn_.state, shot.call, shot.cue_ball, shot.stroke,
                                    turn_.info.table, turn_.info.materials);
  return ready ? std::optional(*std::move(ready)) : std::nullopt;
}

std::optional<rules::Ruling> Rehearsal::run(const protocol::ReadyShot& ready) {
  auto played = protocol::play_shot(ready);
  if (!played) {
    return std::nullopt;
  }
  events_ += played->simulation.events.size();
  return std::move(played->ruling);
}

std::optional<rules::Ruling> Rehearsal::exact(const client::Shot& shot) {
  const auto asked = ready(shot);
  return asked ? run(*asked) : std::nullopt;
}

std::optional<double> Rehearsal::exact_value(const client::Shot& shot) {
  const auto ruling = exact(shot);
  if (!ruling) {
    return std::nullopt;
  }
  return position_value_.of(ruling->next, turn_.info.seat);
}

std::optional<double> Rehearsal::value(const client::Shot& shot, SampleRange samples) {
  auto asked = ready(shot);
  if (!asked || samples.count == 0) {
    return std::nullopt;
  }
  double sum = 0;
  for (std::size_t i = 0; i < samples.count; ++i) {
    const auto& deviates = deviates_[(samples.first + i) % max_samples];
    const auto executed = protocol::executed_shot(shot.stroke, noise_, deviates, asked->scene.balls,
                                                  turn_.info.table, turn_.info.materials);
    asked->scene.shot = protocol::to_physics(executed.params);
    const auto ruling = run(*asked);
    if (!ruling) {
      return std::nullopt;
    }
    sum += position_value_.of(ruling->next, turn_.info.seat);
  }
  return sum / static_cast<double>(samples.count);
}

}  // namespace poolhall::bots
