#include "tests/support/mirrored.hpp"

#include <cmath>

namespace poolhall::test_support {

using physics::PocketId;
using physics::RailId;

PocketId mirrored(PocketId pocket) {
  // Left and right of a row are neighbours in the enumeration.
  return static_cast<PocketId>(static_cast<unsigned>(pocket) ^ 1U);
}

RailId mirrored(RailId rail) {
  switch (rail) {
    case RailId::head_left:
      return RailId::head_right;
    case RailId::head_right:
      return RailId::head_left;
    case RailId::foot_left:
      return RailId::foot_right;
    case RailId::foot_right:
      return RailId::foot_left;
    default:
      return rail;
  }
}

rules::GameState mirrored(rules::GameState state, const physics::Table& table) {
  for (rules::BallPlace& place : state.balls) {
    if (place.where == rules::Whereabouts::on_table) {
      place.position.x = table.width - place.position.x;
    } else if (place.where == rules::Whereabouts::pocketed) {
      place.pocket = mirrored(place.pocket);
    }
  }
  return state;
}

rules::Call mirrored(rules::Call call) {
  if (call.kind == rules::Call::Kind::pocket) {
    call.pocket = mirrored(call.pocket);
  }
  return call;
}

physics::EventLog<double> mirrored(physics::EventLog<double> events, const physics::Table& table) {
  for (physics::Event<double>& event : events) {
    for (std::size_t k = 0; k < event.ball_count; ++k) {
      physics::Ball<double>& ball = event.after[k];
      ball.position.x = table.width - ball.position.x;
      ball.velocity.x = -ball.velocity.x;
      // An angular velocity is an axial vector: what lies along the mirror turns round.
      ball.angular_velocity.y = -ball.angular_velocity.y;
      ball.angular_velocity.z = -ball.angular_velocity.z;
      if (ball.pocket) {
        ball.pocket = mirrored(*ball.pocket);
      }
    }
    if (event.rail) {
      event.rail = mirrored(*event.rail);
    }
    if (event.pocket) {
      event.pocket = mirrored(*event.pocket);
    }
  }
  return events;
}

namespace {

bool same_places(const rules::GameState& state, const rules::GameState& other,
                 const physics::Table& table) {
  constexpr double tolerance = 1e-9;
  if (state.kind == rules::TurnKind::break_shot && !state.result) {
    return state.balls == other.balls;
  }
  const rules::GameState image = mirrored(other, table);
  for (std::size_t i = 0; i < state.balls.size(); ++i) {
    const rules::BallPlace& p = state.balls[i];
    const rules::BallPlace& q = image.balls[i];
    if (p.id != q.id || p.where != q.where || p.pocket != q.pocket ||
        std::abs(p.position.x - q.position.x) > tolerance ||
        std::abs(p.position.y - q.position.y) > tolerance) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool same_in_mirror(const rules::Ruling& ruling, const rules::Ruling& other,
                    const physics::Table& table) {
  bool same =
      ruling.legal == other.legal && ruling.driven_off == other.driven_off &&
      ruling.first_contact == other.first_contact && ruling.notes.size() == other.notes.size() &&
      ruling.fouls.size() == other.fouls.size() && ruling.pocketed.size() == other.pocketed.size();
  for (std::size_t i = 0; same && i < ruling.fouls.size(); ++i) {
    same = ruling.fouls[i].code == other.fouls[i].code &&
           ruling.fouls[i].event == other.fouls[i].event;
  }
  for (std::size_t i = 0; same && i < ruling.pocketed.size(); ++i) {
    same = ruling.pocketed[i].ball == other.pocketed[i].ball &&
           ruling.pocketed[i].pocket == mirrored(other.pocketed[i].pocket) &&
           ruling.pocketed[i].event == other.pocketed[i].event;
  }
  if (!same || !same_places(ruling.next, other.next, table)) {
    return false;
  }
  rules::GameState rest = other.next;
  rest.balls = ruling.next.balls;
  return rest == ruling.next;
}

}  // namespace poolhall::test_support
