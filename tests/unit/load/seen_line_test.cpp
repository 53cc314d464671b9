// What the generator of load sees in a line is what the server's encoder has put there.
#include <gtest/gtest.h>

#include "clients/load/latencies.hpp"
#include "clients/load/quick_play.hpp"
#include "clients/load/seen_line.hpp"
#include "protocol/codec.hpp"
#include "rules/referee.hpp"

namespace poolhall::load {
namespace {

using protocol::Outgoing;

const physics::Table table = physics::preset_table("olympiad").value();
const physics::Materials materials = physics::preset_materials("olympiad").value();

protocol::GameTurn<Outgoing> turn_of(const rules::GameState& state) {
  protocol::GameTurn<Outgoing> turn;
  turn.game = protocol::GameId{17};
  turn.turn = state.turn;
  turn.kind = state.kind;
  turn.state = {protocol::encode_state(state)};
  turn.legal = protocol::LegalBalls{rules::callable_balls(state), rules::legal_first_balls(state),
                                    rules::legal_calls(state)};
  turn.refusals = 2;
  return turn;
}

TEST(SeenLine, FindsTurnBallsAndRefusalsOfATurn) {
  rules::GameState state = rules::new_game({}, table, materials);
  state.kind = rules::TurnKind::ball_in_hand;
  state.turn = 5;
  const std::string line = protocol::encode_notification(turn_of(state), 3);
  EXPECT_EQ(look_at(line).kind, LineKind::turn);
  const auto seen = turn_in(line);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->game, 17);
  EXPECT_EQ(seen->turn, 5U);
  EXPECT_EQ(seen->refusals, 2U);
  EXPECT_EQ(seen->balls, rules::callable_balls(state));
  EXPECT_TRUE(seen->calls_pockets);
  ASSERT_EQ(seen->taken.size(), 15U);
  EXPECT_EQ(seen->taken[3].x, state.balls[4].position.x);
  EXPECT_EQ(seen->taken[3].y, state.balls[4].position.y);
}

TEST(SeenLine, FindsTheDecisionsOfADecision) {
  rules::GameState state = rules::new_game({}, table, materials);
  state.kind = rules::TurnKind::decision;
  protocol::GameTurn<Outgoing> turn = turn_of(state);
  turn.legal =
      protocol::LegalDecisions{{rules::Decision::accept, rules::Decision::rerack_chooser_breaks}};
  const auto seen = turn_in(protocol::encode_notification(turn, 3));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->decisions,
            (std::vector{rules::Decision::accept, rules::Decision::rerack_chooser_breaks}));
}

TEST(SeenLine, TellsRepliesFromErrors) {
  const protocol::RequestId id{"12"};
  EXPECT_EQ(look_at(protocol::encode_reply(id, protocol::GameReply{})).kind, LineKind::reply);
  const std::string line =
      protocol::encode_error(id, {protocol::ErrorCode::bad_shot, "/params/params/v", "too fast"});
  const SeenLine error = look_at(line);
  EXPECT_EQ(error.kind, LineKind::error);
  EXPECT_EQ(error.id, 12);
  EXPECT_EQ(error_code_in(line), "bad_shot");
  EXPECT_EQ(look_at(protocol::encode_error({}, {})).id, 0);
}

TEST(QuickPlay, AnswersTheSameTurnAlikeAndARefusedOneOtherwise) {
  SeenTurn turn;
  turn.game = 3;
  turn.turn = 8;
  const auto once = std::get<protocol::Shot>(quick_answer(turn, {}, 1));
  EXPECT_EQ(once, std::get<protocol::Shot>(quick_answer(turn, {}, 1)));
  turn.refusals = 1;
  const auto again = std::get<protocol::Shot>(quick_answer(turn, {}, 1));
  EXPECT_NE(once.params.phi, again.params.phi);
  EXPECT_NE(once.shot_id.json, again.shot_id.json);
}

TEST(QuickPlay, PlacesTheCueBallClearOfTheOthersAndBehindTheHeadString) {
  const Felt felt;
  SeenTurn turn;
  turn.kind = rules::TurnKind::ball_in_hand_behind_head_string;
  turn.taken = {{0.5, 0.3}, {0.6, 0.2}, {0.2, 0.1}};
  for (turn.turn = 1; turn.turn < 200; ++turn.turn) {
    const auto place = *std::get<protocol::Shot>(quick_answer(turn, felt, 1)).cue_ball;
    EXPECT_LE(place.y, felt.head_string);
    for (const auto& ball : turn.taken) {
      EXPECT_GT(std::hypot(ball.x - place.x, ball.y - place.y), 2 * felt.ball_radius);
    }
  }
}

TEST(Latencies, GiveTheNearestRank) {
  Latencies latencies;
  for (int i = 100; i >= 1; --i) {
    latencies.add(std::chrono::milliseconds{i});
  }
  EXPECT_EQ(latencies.share_below(0.5), std::chrono::milliseconds{50});
  EXPECT_EQ(latencies.share_below(0.99), std::chrono::milliseconds{99});
  EXPECT_EQ(latencies.share_below(0.999), std::chrono::milliseconds{100});
  EXPECT_EQ(latencies.share_below(1), std::chrono::milliseconds{100});
}

}  // namespace
}  // namespace poolhall::load
