#include "scripted_play.hpp"

#include <algorithm>

namespace poolhall::net_tests {

using protocol::Received;
using rules::TurnKind;

namespace {

constexpr double table_width = 1.116;
constexpr double head_string = 2.236 / 4;
constexpr double radius = 0.028575;

bool is_free(const rules::GameState& state, physics::Vec2<double> place) {
  return std::none_of(state.balls.begin(), state.balls.end(), [&](const rules::BallPlace& ball) {
    const double dx = ball.position.x - place.x;
    const double dy = ball.position.y - place.y;
    return ball.where == rules::Whereabouts::on_table && physics::number(ball.id) != 0 &&
           dx * dx + dy * dy < 9 * radius * radius;
  });
}

physics::Vec2<double> free_place_in_kitchen(const rules::GameState& state) {
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10;
    const physics::Vec2<double> place{table_width * (0.2 + 0.06 * (i % 10)),
                                      head_string * (0.95 - 0.08 * row)};
    if (is_free(state, place)) {
      return place;
    }
  }
  throw std::runtime_error("no free place in the kitchen");
}

}  // namespace

protocol::Shot scripted_shot(const Turn& turn) {
  protocol::Shot shot;
  shot.game = turn.game;
  shot.turn = turn.turn;
  shot.shot_id = {"\"turn-" + std::to_string(turn.turn) + "-" + std::to_string(turn.refusals) +
                  "\""};
  const bool is_break = turn.kind == TurnKind::break_shot;
  // From high above the cue passes over whatever lies behind the ball.
  shot.params = {
      .a = 0, .b = 0, .theta = is_break ? 20.0 : 60.0, .phi = 90, .v = is_break ? 6.0 : 1.5};
  if (!is_break) {
    shot.params.phi = (turn.turn * 37 + turn.refusals * 90) % 360;
    shot.call.kind = rules::Call::Kind::safety;
  }
  if (turn.kind != TurnKind::shot) {
    shot.cue_ball = free_place_in_kitchen(turn.state);
  }
  return shot;
}

protocol::Request scripted_answer(const Turn& turn) {
  if (turn.kind == TurnKind::decision) {
    const auto& legal = std::get<protocol::LegalDecisions>(turn.legal);
    return protocol::Decide{turn.game, turn.turn, legal.decisions.front()};
  }
  return scripted_shot(turn);
}

protocol::GameId start_game(WireClient& anna, WireClient& bert, const std::string& bert_name,
                            const protocol::ClockSettings& clock) {
  protocol::Challenge challenge;
  challenge.opponent = bert_name;
  challenge.noise = "none";
  challenge.clock = clock;
  static_cast<void>(anna.call<protocol::ChallengeReply>(challenge));
  const auto offer = bert.wait_for<protocol::ChallengeOffer>();
  static_cast<void>(
      bert.call<protocol::ChallengeReply>(protocol::ChallengeAccept{offer.challenge}));
  const auto start = anna.wait_for<protocol::GameStart<Received>>();
  static_cast<void>(bert.wait_for<protocol::GameStart<Received>>());
  return start.terms.game;
}

rules::GameState play_turns(const Players& players, rules::Seat to_move, std::uint32_t last) {
  for (;;) {
    WireClient& mover = to_move == rules::Seat::first ? players.first : players.second;
    const Turn turn = mover.wait_for<Turn>();
    rules::GameState after;
    const protocol::Request answer = scripted_answer(turn);
    if (std::holds_alternative<protocol::Shot>(answer)) {
      after = mover.call<protocol::ShotReply<Received>>(answer).shot.state;
    } else {
      after = mover.call<protocol::DecideReply<Received>>(answer).decision.state;
    }
    if (after.result || turn.turn >= last) {
      return after;
    }
    to_move = after.to_move;
  }
}

}  // namespace poolhall::net_tests
