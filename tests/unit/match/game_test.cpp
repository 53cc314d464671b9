#include "server/match/game.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"

namespace poolhall::match {
namespace {

using protocol::ErrorCode;
using storage::TurnAction;

constexpr protocol::GameId id{7};

storage::TermsRecord quick_terms() {
  storage::TermsRecord terms;
  terms.noise = "none";
  terms.rack_gap = 1e-4;
  terms.clock = Micros{10'000'000};
  terms.increment = Micros{1'000};
  return terms;
}

storage::GameRecord record_of(const storage::TermsRecord& terms) {
  GameOrder order;
  order.id = id;
  order.match = protocol::MatchId{1};
  order.agents = {storage::AgentId{1}, storage::AgentId{2}};
  order.terms = terms;
  order.rack_seed = 5;
  order.key[3] = 9;
  return new_game_record(order).value();
}

Game game_of(const storage::TermsRecord& terms) {
  return Game::open({.game = record_of(terms)}).value();
}

Arrival at(std::int64_t micros) {
  return {.at = Instant{micros}, .lag = Micros{0}, .date = storage::UnixMicros{micros}};
}

protocol::Shot break_shot(const std::string& shot_id = "1") {
  protocol::Shot shot;
  shot.game = id;
  shot.turn = 1;
  shot.shot_id.json = shot_id;
  shot.params = {.a = 0, .b = 1, .theta = 5, .phi = 90, .v = 5};
  shot.cue_ball = physics::Vec2<double>{0.558, 0.4};
  return shot;
}

Store settled(Game& game, Answer answer, std::int64_t now = 0) {
  Answer result = game.settle(play(std::get<Play>(answer).job), Instant{now});
  return std::get<Store>(std::move(result));
}

void play_and_store(Game& game, const protocol::Shot& shot, std::int64_t when) {
  static_cast<void>(settled(game, game.shot(game.state().to_move, shot, at(when))));
  game.stored();
}

ErrorCode refused(const Answer& answer) {
  return std::get<Refuse>(answer).error.code;
}

TEST(Game, begins_as_its_row_says) {
  const storage::GameRecord record = record_of(quick_terms());
  const Game game = Game::open({.game = record}).value();
  EXPECT_EQ(game.phase(), Phase::due);
  EXPECT_EQ(protocol::encode_state(game.state()), record.initial_state);
  EXPECT_EQ(record.seal, seal(record));
  EXPECT_EQ(game.clock().balance().left[1], Micros{10'000'000});
}

TEST(Game, refuses_terms_that_do_not_exist) {
  GameOrder order;
  order.terms.noise = "loud";
  EXPECT_FALSE(new_game_record(order));
  order.terms = {};
  order.terms.table = "round";
  EXPECT_FALSE(new_game_record(order));
}

TEST(Game, stores_a_shot_with_what_was_intended_and_what_was_played) {
  Game game = game_of(quick_terms());
  game.begin_turn(Instant{1'000});
  const Store store = settled(game, game.shot(Seat::first, break_shot(), at(501'000)));
  EXPECT_EQ(game.phase(), Phase::storing);
  EXPECT_EQ(store.turn.action, TurnAction::shot);
  EXPECT_EQ(store.turn.shot->index, 1U);
  EXPECT_EQ(store.turn.shot->intended, break_shot().params);
  EXPECT_EQ(store.turn.shot->executed, break_shot().params);  // no noise
  EXPECT_FALSE(store.turn.shot->moved);
  EXPECT_EQ(store.turn.clock.used, Micros{500'000});
  EXPECT_EQ(store.turn.clock.left[0], Micros{9'501'000});
  EXPECT_EQ(store.turn.checksum, chained(first_link(game.record()), store.turn));
  EXPECT_EQ(game.state().turn, 1U) << "nothing has happened before it is durable";
  game.stored();
  EXPECT_EQ(game.state().turn, 2U);
  EXPECT_EQ(game.state_json(), store.turn.state_after);
  EXPECT_EQ(game.phase(), Phase::due);
}

TEST(Game, adds_the_noise_of_its_key) {
  storage::TermsRecord terms = quick_terms();
  terms.noise = "olympiad";
  Game game = game_of(terms);
  const Store store = settled(game, game.shot(Seat::first, break_shot(), at(1)));
  const auto deviates = shot_deviates(game.record().key, {id, Seat::first, 1});
  EXPECT_EQ(store.turn.shot->executed.phi, 90 + 0.125 * deviates[3]);
  EXPECT_EQ(store.turn.shot->executed.v, 5 + 0.075 * deviates[4]);
}

TEST(Game, joins_the_same_shot_while_it_is_played_and_stored) {
  Game game = game_of(quick_terms());
  Answer first = game.shot(Seat::first, break_shot(), at(1));
  EXPECT_TRUE(std::holds_alternative<Join>(game.shot(Seat::first, break_shot(), at(2))));
  static_cast<void>(settled(game, std::move(first)));
  EXPECT_TRUE(std::holds_alternative<Join>(game.shot(Seat::first, break_shot(), at(3))));
}

TEST(Game, refuses_another_content_under_the_same_shot_id_in_flight) {
  Game game = game_of(quick_terms());
  const Answer first = game.shot(Seat::first, break_shot(), at(1));
  protocol::Shot other = break_shot();
  other.params.v = 4;
  EXPECT_EQ(refused(game.shot(Seat::first, other, at(2))), ErrorCode::conflicting_shot);
  EXPECT_TRUE(std::holds_alternative<Later>(game.shot(Seat::first, break_shot("2"), at(2))));
  EXPECT_EQ(game.phase(), Phase::playing);
}

TEST(Game, refers_a_turn_that_is_over_to_its_row) {
  Game game = game_of(quick_terms());
  play_and_store(game, break_shot(), 1);
  const Answer again = game.shot(Seat::first, break_shot(), at(2));
  ASSERT_TRUE(std::holds_alternative<Past>(again));
  const storage::TurnRecord& row = game.last_turn().value();
  EXPECT_EQ(std::get<Past>(again).turn, row.number);
  EXPECT_EQ(repeated_shot(row, Seat::first, break_shot()), std::nullopt);
  protocol::Shot other = break_shot();
  other.call = {.kind = rules::Call::Kind::safety};
  EXPECT_EQ(repeated_shot(row, Seat::first, other)->code, ErrorCode::conflicting_shot);
  EXPECT_EQ(repeated_shot(row, Seat::first, break_shot("2"))->code, ErrorCode::stale_turn);
  EXPECT_EQ(repeated_shot(row, Seat::second, break_shot())->code, ErrorCode::stale_turn);
  EXPECT_EQ(repeated_decision(row, Seat::first, {id, 1, rules::Decision::accept})->code,
            ErrorCode::stale_turn);
}

TEST(Game, tells_turns_of_the_opponent_from_those_that_are_not_due) {
  Game game = game_of(quick_terms());
  EXPECT_EQ(refused(game.shot(Seat::second, break_shot(), at(1))), ErrorCode::not_your_turn);
  protocol::Shot shot = break_shot();
  shot.turn = 2;
  EXPECT_EQ(refused(game.shot(Seat::first, shot, at(1))), ErrorCode::stale_turn);
  shot.turn = 0;
  EXPECT_EQ(refused(game.shot(Seat::first, shot, at(1))), ErrorCode::stale_turn);
  EXPECT_EQ(game.refusals(), 0U);
}

TEST(Game, refuses_what_cannot_be_played_and_names_the_field) {
  Game game = game_of(quick_terms());
  game.begin_turn(Instant{0});
  protocol::Shot shot = break_shot();
  shot.params.v = 11;
  Answer answer = game.shot(Seat::first, shot, at(100));
  answer = game.settle(play(std::get<Play>(answer).job), Instant{900});
  const protocol::Error& error = std::get<Refuse>(answer).error;
  EXPECT_EQ(error.code, ErrorCode::bad_shot);
  EXPECT_EQ(error.field, "/params/params/v");
  EXPECT_EQ(error.game, id);
  EXPECT_FALSE(error.foul);
  EXPECT_EQ(game.refusals(), 1U);
  EXPECT_EQ(game.phase(), Phase::thinking);
  const Store store = settled(game, game.shot(Seat::first, break_shot(), at(1'000)));
  EXPECT_EQ(store.turn.clock.used, Micros{200}) << "the server's 800 are not charged";
  EXPECT_EQ(store.turn.refusals, 1U);
}

TEST(Game, ends_the_turn_with_a_foul_at_the_last_refusal) {
  Game game = game_of(quick_terms());
  protocol::Shot shot = break_shot();
  shot.cue_ball = physics::Vec2<double>{0.5, 2.0};  // outside the kitchen
  for (int i = 1; i <= 2; ++i) {
    Answer answer = game.shot(Seat::first, shot, at(i));
    answer = game.settle(play(std::get<Play>(answer).job), Instant{i});
    EXPECT_EQ(refused(answer), ErrorCode::bad_cue_ball_position);
  }
  const Store store = settled(game, game.shot(Seat::first, shot, at(3)));
  EXPECT_EQ(store.turn.action, TurnAction::lost_turn);
  EXPECT_EQ(store.turn.shot, std::nullopt);
  ASSERT_TRUE(store.error);
  EXPECT_TRUE(store.error->foul);
  EXPECT_NE(store.turn.ruling->find("too_many_refusals"), std::string::npos);
  game.stored();
  EXPECT_EQ(game.state().to_move, Seat::second);
  EXPECT_EQ(game.refusals(), 0U);
}

TEST(Game, is_lost_when_the_clock_is_at_zero_without_waiting_for_the_player) {
  Game game = game_of(quick_terms());
  game.begin_turn(Instant{500});
  EXPECT_EQ(game.expires(Micros{0}), Instant{10'000'500});
  EXPECT_TRUE(std::holds_alternative<Later>(game.expire(at(10'000'499))));
  const Store store = std::get<Store>(game.expire(at(10'000'500)));
  EXPECT_EQ(store.turn.action, TurnAction::timeout);
  EXPECT_EQ(store.error, std::nullopt);
  EXPECT_EQ(store.turn.clock.left[0], Micros{0});
  ASSERT_TRUE(store.game);
  EXPECT_EQ(store.game->result, (rules::GameResult{Seat::second, rules::EndReason::timeout}));
  EXPECT_EQ(store.game->seal, seal(*store.game));
  game.stored();
  EXPECT_EQ(game.phase(), Phase::over);
  EXPECT_EQ(game.record().head, store.turn.checksum);
}

TEST(Game, is_lost_by_a_shot_that_comes_after_the_clock_was_at_zero) {
  Game game = game_of(quick_terms());
  game.begin_turn(Instant{0});
  const Store store = std::get<Store>(game.shot(Seat::first, break_shot(), at(10'000'000)));
  EXPECT_EQ(store.turn.action, TurnAction::timeout);
  EXPECT_EQ(store.error->code, ErrorCode::stale_turn);
}

TEST(Game, loses_the_turn_at_the_cap_on_its_time) {
  storage::TermsRecord terms = quick_terms();
  terms.shot_cap = Micros{2'000'000};
  Game game = game_of(terms);
  game.begin_turn(Instant{0});
  const Store store = std::get<Store>(game.expire(at(2'000'000)));
  EXPECT_EQ(store.turn.action, TurnAction::lost_turn);
  EXPECT_NE(store.turn.ruling->find("shot_time_exceeded"), std::string::npos);
  EXPECT_EQ(store.game, std::nullopt);
}

TEST(Game, can_be_conceded_by_either_side_once) {
  for (const Seat seat : {Seat::first, Seat::second}) {
    Game game = game_of(quick_terms());
    game.begin_turn(Instant{0});
    const Store store = std::get<Store>(game.concede(seat, at(10)));
    EXPECT_EQ(store.turn.seat, seat);
    EXPECT_TRUE(std::holds_alternative<Join>(game.concede(seat, at(11))));
    EXPECT_TRUE(std::holds_alternative<Later>(game.concede(other(seat), at(11))));
    game.stored();
    EXPECT_EQ(game.record().result->winner, other(seat));
    EXPECT_TRUE(std::holds_alternative<Done>(game.concede(seat, at(12))));
    EXPECT_EQ(refused(game.concede(other(seat), at(12))), ErrorCode::game_over);
  }
}

TEST(Game, takes_nothing_else_while_a_shot_is_played) {
  Game game = game_of(quick_terms());
  const Answer first = game.shot(Seat::first, break_shot(), at(1));
  EXPECT_TRUE(std::holds_alternative<Later>(game.concede(Seat::second, at(2))));
  EXPECT_TRUE(std::holds_alternative<Later>(game.forfeit(Seat::second, at(2))));
  EXPECT_TRUE(std::holds_alternative<Later>(game.expire(at(99'000'000))));
}

TEST(Game, is_void_when_the_server_fails) {
  Game game = game_of(quick_terms());
  static_cast<void>(game.shot(Seat::first, break_shot(), at(1)));
  const Store store = std::get<Store>(game.settle(ServerFault{"broken"}, Instant{2}));
  EXPECT_EQ(store.turn.action, TurnAction::void_game);
  EXPECT_EQ(store.game->result, (rules::GameResult{std::nullopt, rules::EndReason::void_game}));
}

TEST(Game, goes_on_as_before_when_a_turn_could_not_be_stored) {
  Game game = game_of(quick_terms());
  game.begin_turn(Instant{0});
  static_cast<void>(settled(game, game.shot(Seat::first, break_shot(), at(100))));
  game.not_stored(Instant{5'000});
  EXPECT_EQ(game.phase(), Phase::thinking);
  const Store store = settled(game, game.shot(Seat::first, break_shot("2"), at(5'100)));
  EXPECT_EQ(store.turn.clock.used, Micros{200});
  EXPECT_EQ(store.turn.shot->index, 1U);
}

TEST(Game, goes_on_after_a_restart_from_its_last_row) {
  Game game = game_of(quick_terms());
  play_and_store(game, break_shot(), 1'000);
  Game restarted =
      Game::open({.game = game.record(), .last_turn = game.last_turn(), .shots = {1, 0}}).value();
  EXPECT_EQ(restarted.phase(), Phase::due);
  EXPECT_EQ(restarted.state(), game.state());
  EXPECT_EQ(restarted.clock().balance(), game.clock().balance());
  const Seat mover = game.state().to_move;
  const Store one = std::get<Store>(game.concede(mover, at(50)));
  const Store other_one = std::get<Store>(restarted.concede(mover, at(50)));
  EXPECT_EQ(one.turn, other_one.turn);
}

TEST(Game, is_acknowledged_once_by_each_seat_when_it_is_over) {
  Game game = game_of(quick_terms());
  EXPECT_EQ(game.acknowledge(Seat::first), std::nullopt);
  static_cast<void>(game.forfeit(Seat::first, at(1)));
  game.stored();
  const auto record = game.acknowledge(Seat::second);
  ASSERT_TRUE(record);
  EXPECT_TRUE(record->acknowledged[1]);
  EXPECT_EQ(record->seal, seal(*record));
  EXPECT_EQ(game.acknowledge(Seat::second), std::nullopt);
}

TEST(Game, keeps_no_minus_zero) {
  Game game = game_of(quick_terms());
  protocol::Shot shot = break_shot();
  shot.params.a = -0.0;
  const Store store = settled(game, game.shot(Seat::first, shot, at(1)));
  EXPECT_FALSE(std::signbit(store.turn.shot->intended.a));
  EXPECT_FALSE(std::signbit(store.turn.shot->executed.a));
}

}  // namespace
}  // namespace poolhall::match
