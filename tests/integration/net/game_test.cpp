// Whole games between two clients over real sockets, on a real database file.
#include <gtest/gtest.h>

#include "scripted_play.hpp"
#include "server/storage/sqlite_database.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using rules::Seat;

net::ServerOptions options_for(const std::filesystem::path& database) {
  net::ServerOptions options = test_options(database);
  options.settings.limits.takeover_interval = std::chrono::milliseconds{0};
  return options;
}

class Game : public ::testing::Test {
 protected:
  test_support::TemporaryDirectory directory_;
  TestServer server_{options_for(directory_ / "test.db")};
};

TEST_F(Game, IsPlayedToItsEndAndToldToBoth) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  const protocol::GameId game = start_game(anna, bert, "bert");

  const rules::GameState after = play_turns({anna, bert}, Seat::first, 8);
  if (!after.result) {
    static_cast<void>(bert.call<protocol::GameReply>(protocol::Concede{game}));
  }

  const auto told_anna = anna.wait_for<protocol::GameOver>();
  const auto told_bert = bert.wait_for<protocol::GameOver>();
  EXPECT_EQ(told_anna.game, game);
  EXPECT_EQ(told_anna.winner, told_bert.winner);
  EXPECT_EQ(told_anna.reason, told_bert.reason);
  EXPECT_EQ(told_anna.checksum, told_bert.checksum);
  EXPECT_EQ(anna.wait_for<protocol::MatchOver>().seeds.size(), 1U);
  EXPECT_EQ(bert.wait_for<protocol::MatchOver>().opponent, "anna");
  static_cast<void>(anna.call<protocol::AckReply>(protocol::Ack{game}));
}

TEST_F(Game, ShowsTheOpponentWhatTheShooterIsTold) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  const auto reply = anna.call<protocol::ShotReply<Received>>(scripted_shot(anna.wait_for<Turn>()));
  const auto seen = bert.wait_for<protocol::GameShot<Received>>();
  EXPECT_EQ(seen.shot_id, reply.shot.shot_id);
  EXPECT_EQ(seen.executed, reply.shot.executed);
  EXPECT_EQ(seen.events.size(), reply.shot.events.size());
  EXPECT_GT(seen.events.size(), 2U);
  EXPECT_EQ(seen.state.balls, reply.shot.state.balls);
}

TEST_F(Game, HasEveryShotInTheDatabaseWhenItIsAnswered) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  const protocol::GameId game = start_game(anna, bert, "bert");
  const auto reply = anna.call<protocol::ShotReply<Received>>(scripted_shot(anna.wait_for<Turn>()));

  auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
  const auto row = reader->turn(game, 1).value();
  ASSERT_TRUE(row);
  EXPECT_EQ(row->shot->executed, reply.shot.executed);
  EXPECT_EQ(row->request, reply.shot.shot_id);
}

TEST_F(Game, AnswersTheSameShotAgainWithoutPlayingItAgain) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  const protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  const auto first = anna.call<protocol::ShotReply<Received>>(shot);
  const auto second = anna.call<protocol::ShotReply<Received>>(shot);
  EXPECT_EQ(first.repetition, protocol::Repetition::first_time);
  EXPECT_EQ(second.repetition, protocol::Repetition::duplicate);
  EXPECT_EQ(first.shot.executed, second.shot.executed);
  EXPECT_EQ(first.shot.state.balls, second.shot.state.balls);

  protocol::Shot other = shot;
  other.params.v += 1;
  EXPECT_EQ(anna.refused(other).code, "conflicting_shot");
  other = shot;
  other.shot_id = {"\"another\""};
  EXPECT_EQ(anna.refused(other).code, "stale_turn");
}

TEST_F(Game, AnswersAPipelinedRepetitionAsADuplicate) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  const protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  const auto first_id = anna.send(shot);
  const auto second_id = anna.send(shot);
  const auto first = std::get<protocol::ReplyMessage>(anna.answer_to(first_id));
  const auto second = std::get<protocol::ReplyMessage>(anna.answer_to(second_id));
  EXPECT_EQ(std::get<protocol::ShotReply<Received>>(first.reply).repetition,
            protocol::Repetition::first_time);
  EXPECT_EQ(std::get<protocol::ShotReply<Received>>(second.reply).repetition,
            protocol::Repetition::duplicate);
}

TEST_F(Game, TurnsAwayWhoIsNotToMoveAndWhoIsNotInIt) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  WireClient carl{server_.port()};
  anna.join("anna");
  bert.join("bert");
  carl.join("carl");
  static_cast<void>(start_game(anna, bert, "bert"));
  const protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  EXPECT_EQ(bert.refused(shot).code, "not_your_turn");
  EXPECT_EQ(carl.refused(shot).code, "unknown_game");
  EXPECT_EQ(carl.refused(protocol::Sync{shot.game}).code, "unknown_game");
}

TEST_F(Game, MakesTheThirdRefusalAFoul) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  shot.params.a = 500;
  EXPECT_FALSE(anna.refused(shot).error.foul);
  EXPECT_FALSE(anna.refused(shot).error.foul);
  const auto last = anna.refused(shot);
  EXPECT_EQ(last.code, "bad_shot");
  EXPECT_TRUE(last.error.foul);
  EXPECT_EQ(bert.wait_for<protocol::GameTurnLost<Received>>().turn, 1U);
  EXPECT_EQ(bert.wait_for<Turn>().turn, 2U);
}

TEST_F(Game, IsLostByWhoeverRunsOutOfTime) {
  WireClient anna{server_.port()};
  WireClient bert{server_.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert", {.game_ms = 100}));
  const auto over = bert.wait_for<protocol::GameOver>();
  EXPECT_EQ(over.reason, rules::EndReason::timeout);
  EXPECT_EQ(over.winner, Seat::second);
  EXPECT_TRUE(over.scored);
}

TEST_F(Game, TellsATakenOverAgentWhatIsPending) {
  WireClient bert{server_.port()};
  bert.join("bert");
  auto anna = std::make_unique<WireClient>(server_.port());
  const std::string token = anna->join("anna");
  const protocol::GameId game = start_game(*anna, bert, "bert");
  static_cast<void>(anna->wait_for<Turn>());

  WireClient second{server_.port()};
  const auto reply = second.login(token);
  ASSERT_EQ(reply.games.size(), 1U);
  EXPECT_EQ(reply.games.front().game, game);
  static_cast<void>(anna->wait_for<protocol::Superseded>());
  EXPECT_FALSE(anna->read_line());
  EXPECT_EQ(second.wait_for<protocol::GameSnapshot<Received>>().terms.game, game);
  const Turn turn = second.wait_for<Turn>();
  EXPECT_EQ(turn.turn, 1U);
  EXPECT_LT(turn.clock.own_ms, 600'000);
  static_cast<void>(second.call<protocol::ShotReply<Received>>(scripted_shot(turn)));
}

TEST_F(Game, TellsWhoWasAwayAtItsEndUntilItIsAcknowledged) {
  WireClient bert{server_.port()};
  bert.join("bert");
  auto anna = std::make_unique<WireClient>(server_.port());
  const std::string token = anna->join("anna");
  const protocol::GameId game = start_game(*anna, bert, "bert");
  anna.reset();
  static_cast<void>(bert.call<protocol::GameReply>(protocol::Concede{game}));
  static_cast<void>(bert.wait_for<protocol::GameOver>());

  WireClient again{server_.port()};
  ASSERT_EQ(again.login(token).games.size(), 1U);
  EXPECT_EQ(again.wait_for<protocol::GameOver>().game, game);
  const auto sync = again.call<protocol::SyncReply<Received>>(protocol::Sync{game});
  ASSERT_TRUE(sync.over);
  EXPECT_EQ(sync.over->winner, Seat::first);
  static_cast<void>(again.call<protocol::AckReply>(protocol::Ack{game}));
  again.close();

  WireClient third{server_.port()};
  EXPECT_TRUE(third.login(token).games.empty());
}

}  // namespace
}  // namespace poolhall::net_tests
