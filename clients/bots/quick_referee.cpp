#include "clients/bots/quick_referee.hpp"

#include <bit>

namespace poolhall::bots {
namespace {

using rules::Seat;
using rules::TurnKind;

constexpr double frozen_gap = 1e-6;  // m
constexpr BallMask the_cue_ball = 1;

Position settled(const Position& before, const ShotWatch& watch,
                 const physics::BallSet<double>& balls) {
  Position after = before;
  after.on_table = static_cast<BallMask>(before.on_table & ~unsigned{watch.down});
  for (const auto& ball : balls) {
    after.at[physics::number(ball.id)] = ball.position;
  }
  return after;
}

Position turn_of(Position position, Seat seat, TurnKind kind) {
  position.to_move = seat;
  position.kind = kind;
  position.choice = Choice::none;
  return position;
}

Position choice_for(Position position, Seat seat, Choice choice) {
  position.to_move = seat;
  position.kind = TurnKind::decision;
  position.choice = choice;
  return position;
}

Position won_by(Position position, Seat seat) {
  position.is_over = true;
  position.winner = seat;
  return position;
}

bool is_from_kitchen(const Position& before) {
  return before.kind == TurnKind::break_shot ||
         before.kind == TurnKind::ball_in_hand_behind_head_string;
}

// Fouls of any shot; `first_balls` are those that may be struck first.
bool is_foul(const Position& before, const ShotWatch& watch, BallMask first_balls,
             const physics::Table& table) {
  if ((watch.down & the_cue_ball) != 0 || !watch.first_contact) {
    return true;
  }
  const BallMask first = only(*watch.first_contact);
  const bool in_kitchen = is_from_kitchen(before) &&
                          before.at[physics::number(*watch.first_contact)].y < table.head_string;
  const bool needs_rail = before.kind != TurnKind::break_shot;
  return (first & first_balls) == 0 || in_kitchen || (needs_rail && !watch.rail_after_contact);
}

bool is_illegal_break(const ShotWatch& watch) {
  constexpr unsigned objects = 0xFFFE;
  return (watch.down & objects) == 0 && std::popcount(watch.railed & objects) < 4;
}

// ---- 8-ball ----

Position eight_break(const Position& before, Position after, const ShotWatch& watch,
                     const physics::Table& table) {
  const Seat breaker = before.to_move;
  const Seat opponent = rules::other(breaker);
  if (is_illegal_break(watch)) {
    return choice_for(after, opponent, Choice::illegal_break);
  }
  const bool foul = is_foul(before, watch, static_cast<BallMask>(~the_cue_ball), table);
  if ((watch.down & the_eight) != 0) {
    return foul ? choice_for(after, opponent, Choice::eight_with_foul)
                : choice_for(after, breaker, Choice::eight_on_break);
  }
  if (foul) {
    return (watch.down & the_cue_ball) != 0
               ? turn_of(after, opponent, TurnKind::ball_in_hand_behind_head_string)
               : choice_for(after, opponent, Choice::break_foul);
  }
  return turn_of(after, (watch.down & ~unsigned{the_cue_ball}) != 0 ? breaker : opponent,
                 TurnKind::shot);
}

bool is_scored(const rules::Call& call, const ShotWatch& watch) {
  return call.kind == rules::Call::Kind::pocket && (watch.down & only(call.ball)) != 0 &&
         watch.pocket[physics::number(call.ball)] == call.pocket;
}

Position eight_shot(const Position& before, Position after, const rules::Call& call,
                    const ShotWatch& watch, const physics::Table& table) {
  const Seat shooter = before.to_move;
  const Seat opponent = rules::other(shooter);
  const BallMask mine = balls_on(before);
  const bool foul = is_foul(before, watch, mine, table);
  if ((watch.down & the_eight) != 0) {
    const bool won = mine == the_eight && !foul && is_scored(call, watch);
    return won_by(after, won ? shooter : opponent);
  }
  if (foul) {
    return turn_of(after, opponent, TurnKind::ball_in_hand);
  }
  if (!is_scored(call, watch)) {
    return turn_of(after, opponent, TurnKind::shot);
  }
  if (!before.first_group) {
    const bool solid = (only(call.ball) & solids) != 0;
    after.first_group =
        solid == (shooter == Seat::first) ? rules::Group::solids : rules::Group::stripes;
  }
  return turn_of(after, shooter, TurnKind::shot);
}

// ---- Nine-ball ----

Position nine_foul(Position after, Seat shooter) {
  std::uint8_t& row = after.fouls_in_a_row[rules::index(shooter)];
  ++row;
  return row >= 3 ? won_by(after, rules::other(shooter))
                  : turn_of(after, rules::other(shooter), TurnKind::ball_in_hand);
}

Position nine_shot(const Position& before, Position after, const rules::Call& call,
                   const ShotWatch& watch, const physics::Table& table, double radius) {
  const Seat shooter = before.to_move;
  const Seat opponent = rules::other(shooter);
  const bool push_out = call.kind == rules::Call::Kind::push_out;
  const bool is_break = before.kind == TurnKind::break_shot;
  const bool foul = push_out ? (watch.down & the_cue_ball) != 0
                             : is_foul(before, watch, balls_on(before), table) ||
                                   (is_break && is_illegal_break(watch));
  after.push_out_allowed = false;
  if ((watch.down & the_nine) != 0) {
    if (!foul && !push_out) {
      return won_by(after, shooter);
    }
    after = with_spotted(after, BallId{9}, table, radius);
  }
  if (foul) {
    return nine_foul(after, shooter);
  }
  after.fouls_in_a_row[rules::index(shooter)] = 0;
  if (push_out) {
    return choice_for(after, opponent, Choice::push_out);
  }
  after.push_out_allowed = is_break;
  const bool goes_on = (watch.down & ~unsigned{the_cue_ball}) != 0;
  return turn_of(after, goes_on ? shooter : opponent, TurnKind::shot);
}

}  // namespace

BallMask frozen_balls(const Position& position, const physics::Table& table, double radius) {
  const double reach = radius + frozen_gap;
  BallMask frozen = 0;
  for (unsigned left = position.on_table; left != 0; left &= left - 1) {
    const auto n = static_cast<std::size_t>(std::countr_zero(left));
    const Point& at = position.at[n];
    if (at.x <= reach || at.y <= reach || at.x >= table.width - reach ||
        at.y >= table.length - reach) {
      frozen |= static_cast<BallMask>(1U << n);
    }
  }
  return frozen;
}

physics::Go ShotWatch::see(const physics::Sighting& seen) {
  switch (seen.type) {
    case physics::EventType::ball_collision:
      if (!first_contact && (seen.first == physics::cue_ball || seen.second == physics::cue_ball)) {
        first_contact = seen.first == physics::cue_ball ? seen.second : seen.first;
      }
      break;
    case physics::EventType::rail_collision:
      if ((frozen_to_rail & only(seen.first)) == 0) {
        railed |= only(seen.first);
        rail_after_contact = rail_after_contact || first_contact.has_value();
      }
      break;
    case physics::EventType::pocketed:
      down |= only(seen.first);
      railed |= only(seen.first);
      pocket[physics::number(seen.first)] = *seen.pocket;
      rail_after_contact = rail_after_contact || first_contact.has_value();
      break;
    default:
      break;
  }
  return physics::Go::on;
}

Position judged(const Position& before, const rules::Call& call, const ShotWatch& watch,
                const physics::BallSet<double>& balls, const physics::Table& table, double radius) {
  const Position after = settled(before, watch, balls);
  if (before.rules == rules::RuleSet::nine_ball) {
    return nine_shot(before, after, call, watch, table, radius);
  }
  return before.kind == TurnKind::break_shot ? eight_break(before, after, watch, table)
                                             : eight_shot(before, after, call, watch, table);
}

}  // namespace poolhall::bots
