// What a server knows after it was stopped or killed: everything that it had told.
#include <gtest/gtest.h>

#include "scripted_play.hpp"
#include "server_process.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using rules::Seat;

TEST(Restart, GoesOnWithAGameWhereTheLastStoredTurnLeftIt) {
  test_support::TemporaryDirectory directory;
  auto server = std::make_unique<TestServer>(directory / "test.db");
  std::string anna_token;
  std::string bert_token;
  rules::GameState before;
  protocol::GameId game{};
  {
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    anna_token = anna.join("anna");
    bert_token = bert.join("bert");
    game = start_game(anna, bert, "bert");
    before = play_turns({anna, bert}, Seat::first, 4);
    ASSERT_FALSE(before.result);
    EXPECT_EQ(server->stop(), 0);
  }
  server = std::make_unique<TestServer>(directory / "test.db");
  WireClient anna{server->port()};
  WireClient bert{server->port()};
  ASSERT_EQ(anna.login(anna_token).games.size(), 1U);
  ASSERT_EQ(bert.login(bert_token).games.size(), 1U);
  EXPECT_EQ(anna.wait_for<protocol::GameSnapshot<Received>>().state.balls, before.balls);
  const rules::GameState after = play_turns({anna, bert}, before.to_move, 8);
  if (!after.result) {
    static_cast<void>(bert.call<protocol::GameReply>(protocol::Concede{game}));
  }
  EXPECT_EQ(anna.wait_for<protocol::GameOver>().game, game);
  EXPECT_EQ(bert.wait_for<protocol::GameOver>().game, game);
}

TEST(Restart, AnswersAShotOfBeforeAsADuplicate) {
  test_support::TemporaryDirectory directory;
  auto server = std::make_unique<TestServer>(directory / "test.db");
  std::string token;
  protocol::Shot shot;
  protocol::ShotReply<Received> first;
  {
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    token = anna.join("anna");
    bert.join("bert");
    static_cast<void>(start_game(anna, bert, "bert"));
    shot = scripted_shot(anna.wait_for<Turn>());
    first = anna.call<protocol::ShotReply<Received>>(shot);
    server->stop();
  }
  server = std::make_unique<TestServer>(directory / "test.db");
  WireClient anna{server->port()};
  anna.login(token);
  const auto again = anna.call<protocol::ShotReply<Received>>(shot);
  EXPECT_EQ(again.repetition, protocol::Repetition::duplicate);
  EXPECT_EQ(again.shot.executed, first.shot.executed);
  EXPECT_EQ(again.shot.state.balls, first.shot.state.balls);
}

TEST(Restart, TellsEveryoneThatTheServerStops) {
  test_support::TemporaryDirectory directory;
  TestServer server{directory / "test.db"};
  WireClient anna{server.port()};
  anna.join("anna");
  server.stop();
  static_cast<void>(anna.wait_for<protocol::ShuttingDown>());
  EXPECT_FALSE(anna.read_line());
}

TEST(Restart, LosesNoAnsweredShotWhenTheProgramIsKilled) {
  test_support::TemporaryDirectory directory;
  auto server = std::make_unique<ServerProcess>(directory.path());
  std::string anna_token;
  std::string bert_token;
  rules::GameState state;
  protocol::GameId game{};
  {
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    anna_token = anna.join("anna");
    bert_token = bert.join("bert");
    game = start_game(anna, bert, "bert");
    state = play_turns({anna, bert}, Seat::first, 1);
  }
  for (std::uint32_t last = 2; last <= 8 && !state.result; ++last) {
    server->kill();
    server = std::make_unique<ServerProcess>(directory.path());
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    anna.login(anna_token);
    bert.login(bert_token);
    const auto snapshot = anna.wait_for<protocol::GameSnapshot<Received>>();
    EXPECT_EQ(snapshot.state.turn, state.turn);
    EXPECT_EQ(snapshot.state.balls, state.balls);
    state = play_turns({anna, bert}, state.to_move, last);
  }
  server->kill();
  server = std::make_unique<ServerProcess>(directory.path());
  WireClient anna{server->port()};
  anna.login(anna_token);
  if (!state.result) {
    static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  }
  EXPECT_EQ(anna.wait_for<protocol::GameOver>().game, game);
  EXPECT_EQ(server->terminate(), 0);
}

TEST(Restart, PlaysOnAgainstTheHouseAfterAKill) {
  test_support::TemporaryDirectory directory;
  auto server = std::make_unique<ServerProcess>(directory.path());
  std::string token;
  {
    WireClient anna{server->port()};
    token = anna.join("anna");
    protocol::Challenge challenge;
    challenge.opponent = "house:random";
    const auto reply = anna.call<protocol::ChallengeReply>(challenge);
    EXPECT_EQ(reply.status, protocol::ChallengeStatus::accepted);
    const Turn turn = anna.wait_for<Turn>();
    static_cast<void>(anna.call<protocol::ShotReply<Received>>(scripted_shot(turn)));
  }
  server->kill();
  server = std::make_unique<ServerProcess>(directory.path());
  WireClient anna{server->port()};
  anna.login(token);
  for (int own_turns = 0; own_turns < 3; ++own_turns) {
    const auto message = anna.next_notification();
    if (std::holds_alternative<protocol::GameOver>(message.notification)) {
      return;
    }
    if (const auto* turn = std::get_if<Turn>(&message.notification)) {
      static_cast<void>(anna.answer_to(anna.send(scripted_answer(*turn))));
    } else {
      --own_turns;
    }
  }
  protocol::GameId game{};
  const auto listing = anna.wait_for<Turn>();
  game = listing.game;
  static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  EXPECT_EQ(anna.wait_for<protocol::GameOver>().game, game);
}

}  // namespace
}  // namespace poolhall::net_tests
