#include "clients/bots/position.hpp"

#include <algorithm>
#include <variant>

namespace poolhall::bots {
namespace {

Choice choice_of(const rules::GameState& state) {
  const auto offers = [&state](rules::Decision option) {
    return std::ranges::find(state.options, option) != state.options.end();
  };
  if (state.kind != rules::TurnKind::decision) {
    return Choice::none;
  }
  if (offers(rules::Decision::shoot)) {
    return Choice::push_out;
  }
  if (offers(rules::Decision::spot_eight)) {
    return state.to_move == state.breaker ? Choice::eight_on_break : Choice::eight_with_foul;
  }
  return offers(rules::Decision::accept_ball_in_hand) ? Choice::break_foul : Choice::illegal_break;
}

BallMask balls_of(rules::Group group) {
  return group == rules::Group::solids ? solids : stripes;
}

}  // namespace

Position position_of(const rules::GameState& state) {
  Position position;
  for (const rules::BallPlace& ball : state.balls) {
    if (ball.where == rules::Whereabouts::on_table) {
      position.on_table |= only(ball.id);
      position.at[physics::number(ball.id)] = ball.position;
    }
  }
  position.rules = state.settings.rules;
  position.to_move = state.to_move;
  position.breaker = state.breaker;
  position.kind = state.kind;
  position.choice = choice_of(state);
  if (const auto* eight = std::get_if<rules::EightBallMemory>(&state.memory)) {
    position.first_group = eight->first_seat_group;
  } else if (const auto* nine = std::get_if<rules::NineBallMemory>(&state.memory)) {
    position.fouls_in_a_row = nine->fouls_in_a_row;
    position.push_out_allowed = nine->push_out_allowed;
  }
  if (state.result) {
    position.is_over = true;
    position.winner = state.result->winner;
  }
  return position;
}

std::optional<BallMask> group_balls(const Position& position, rules::Seat seat) {
  if (!position.first_group) {
    return std::nullopt;
  }
  const BallMask first = balls_of(*position.first_group);
  return seat == rules::Seat::first ? first
                                    : static_cast<BallMask>((solids | stripes) & ~unsigned{first});
}

BallMask balls_on(const Position& position) {
  if (position.rules == rules::RuleSet::nine_ball) {
    const unsigned balls = position.on_table & ~1U;
    return static_cast<BallMask>(balls & (~balls + 1));
  }
  const BallMask mine = group_balls(position, position.to_move).value_or(solids | stripes);
  const auto balls = static_cast<BallMask>(position.on_table & mine);
  return balls != 0 ? balls : static_cast<BallMask>(position.on_table & the_eight);
}

int left_of(const Position& position, BallMask mine) {
  return std::popcount(static_cast<BallMask>(position.on_table & (mine | the_eight)));
}

physics::BallSet<double> ball_set(const Position& position) {
  physics::BallSet<double> balls;
  for (unsigned left = position.on_table; left != 0; left &= left - 1) {
    const auto n = static_cast<std::size_t>(std::countr_zero(left));
    auto& ball = balls[balls.count++];
    ball.id = BallId(static_cast<std::uint8_t>(n));
    ball.position = position.at[n];
  }
  return balls;
}

Position with_spotted(Position position, BallId ball, const physics::Table& table, double radius) {
  const double step = radius / 4;
  const auto is_free = [&](const Point& place) {
    for (unsigned left = position.on_table; left != 0; left &= left - 1) {
      const Point off = position.at[static_cast<std::size_t>(std::countr_zero(left))] - place;
      if (dot(off, off) < 4 * radius * radius) {
        return false;
      }
    }
    return true;
  };
  Point place{table.foot_spot_x, table.foot_spot_y};
  while (place.y < table.length - radius - step && !is_free(place)) {
    place.y += step;
  }
  position.on_table |= only(ball);
  position.at[physics::number(ball)] = place;
  return position;
}

}  // namespace poolhall::bots
