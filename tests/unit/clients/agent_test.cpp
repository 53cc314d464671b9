// The agent talks to a scripted server through the protocol's own codec, without sockets.
#include "clients/cpp/agent.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "tests/support/scripted_game.hpp"

namespace poolhall::client {
namespace {

using protocol::ErrorCode;
using protocol::GameId;
using protocol::Outgoing;

class FakeOutside : public Outside {
 public:
  struct Thought {
    GameInfo info;
    TurnTask task;
  };

  void send(std::string line) override { lines.push_back(std::move(line)); }
  void think(const GameInfo& info, std::shared_ptr<Player>, const TurnTask& task) override {
    thoughts.push_back({info, task});
  }
  void wake(GameId game, std::chrono::milliseconds) override { woken.push_back(game); }

  std::vector<std::string> lines;
  std::vector<Thought> thoughts;
  std::vector<GameId> woken;
};

class AgentTest : public testing::Test {
 protected:
  AgentTest() {
    settings_.name = "tester";
    settings_.noise = NoisePart::none;
  }

  Agent& agent() {
    if (!agent_) {
      agent_.emplace(settings_, player_from([](const TurnView&) -> Move { return Concede{}; }),
                     outside_);
    }
    return *agent_;
  }

  // The request that the agent sent last, as a server reads it.
  protocol::Incoming last() {
    std::string line = outside_.lines.at(outside_.lines.size() - 1);
    line.pop_back();
    auto incoming = protocol::decode_request(line, {});
    EXPECT_TRUE(incoming) << line;
    return incoming.value();
  }

  std::optional<End> reply(const protocol::Reply<Outgoing>& value) {
    return came(protocol::encode_reply(*last().id, value));
  }
  std::optional<End> error(ErrorCode code) {
    return came(protocol::encode_error(*last().id, {code, "", "scripted", {}, false}));
  }
  std::optional<End> notify(const protocol::Notification<Outgoing>& value) {
    return came(protocol::encode_notification(value, ++seq_));
  }
  std::optional<End> came(std::string line) {
    line.pop_back();
    return agent().line_came(line);
  }

  void log_in() {
    agent().begin_session();
    ASSERT_FALSE(reply(protocol::HelloReply{}));
    ASSERT_FALSE(reply(protocol::LoginReply{.agent = "tester", .token = {}, .games = {}}));
    ASSERT_TRUE(agent().is_logged_in());
  }

  void start_game() { ASSERT_FALSE(notify(test_support::scripted_start(GameId{17}))); }

  void give_turn(std::uint32_t turn) {
    ASSERT_FALSE(notify(test_support::scripted_turn(GameId{17}, turn)));
  }

  void choose(std::uint32_t turn, std::uint32_t refusals = 0) {
    agent().move_chosen(GameId{17}, {turn, refusals},
                        Shot{.stroke = {.theta = 5, .phi = 90, .v = 3}});
  }

  AgentSettings settings_;
  FakeOutside outside_;
  std::optional<Agent> agent_;
  std::uint64_t seq_ = 0;
};

TEST_F(AgentTest, RegistersUnderItsNameWithATokenOfItsOwn) {
  agent().begin_session();
  EXPECT_TRUE(std::holds_alternative<protocol::Hello>(last().request));
  ASSERT_FALSE(reply(protocol::HelloReply{}));
  const auto request = std::get<protocol::Register>(last().request);
  EXPECT_EQ(request.name, "tester");
  EXPECT_EQ(request.token->text.size(), 64U);
}

TEST_F(AgentTest, HangsUpAndComesBackWhenItsLoginIsPutOff) {
  agent().begin_session();
  ASSERT_FALSE(reply(protocol::HelloReply{}));
  ASSERT_FALSE(error(ErrorCode::rate_limited));
  EXPECT_TRUE(agent().is_put_off());
  agent().session_ended();
  agent().begin_session();
  EXPECT_FALSE(agent().is_put_off());
  EXPECT_TRUE(std::holds_alternative<protocol::Hello>(last().request));
}

TEST_F(AgentTest, LogsInWithTheSameTokenAfterALostReplyToRegister) {
  agent().begin_session();
  ASSERT_FALSE(reply(protocol::HelloReply{}));
  const auto first = std::get<protocol::Register>(last().request);
  agent().session_ended();
  agent().begin_session();
  ASSERT_FALSE(reply(protocol::HelloReply{}));
  EXPECT_EQ(std::get<protocol::Login>(last().request).token, *first.token);
  ASSERT_FALSE(error(ErrorCode::unauthorized));
  EXPECT_EQ(*std::get<protocol::Register>(last().request).token, *first.token);
}

TEST_F(AgentTest, AddsItsPartToTheNoiseOfAGame) {
  settings_.noise = NoisePart::added;
  log_in();
  const auto ready = std::get<protocol::GameReady>(last().request);
  auto start = test_support::scripted_start(GameId{17});
  start.terms.agent_commitments[rules::index(start.terms.seat)] = ready.commitment;
  ASSERT_FALSE(notify(start));
  const auto next = std::get<protocol::GameReady>(last().request);
  EXPECT_NE(next.commitment, ready.commitment);
  outside_.lines.pop_back();
  const auto reveal = std::get<protocol::GameReveal>(last().request);
  EXPECT_EQ(reveal.game, GameId{17});
  EXPECT_EQ(sha256_of(reveal.secret), ready.commitment);
}

TEST_F(AgentTest, RevealsNothingForACommitmentThatIsNotItsOwn) {
  settings_.noise = NoisePart::added;
  log_in();
  auto start = test_support::scripted_start(GameId{17});
  start.terms.agent_commitments[rules::index(start.terms.seat)] = {std::string(64, '1')};
  const std::size_t before = outside_.lines.size();
  ASSERT_FALSE(notify(start));
  EXPECT_EQ(outside_.lines.size(), before + 1);  // the next game.ready
}

TEST(NoiseParts, AreHashedAsPublished) {
  // FIPS 180-4's SHA-256 of 32 zero bytes, as by Python's hashlib.
  EXPECT_EQ(sha256_of({std::string(64, '0')}).text,
            "66687aadf862bd776c8fc18b8e9f8e20089714856ee233b3902a591d0d5f2925");
}

TEST_F(AgentTest, ATakenNameIsTheEnd) {
  agent().begin_session();
  ASSERT_FALSE(reply(protocol::HelloReply{}));
  const auto end = error(ErrorCode::name_taken);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->ending, Ending::refused);
}

TEST_F(AgentTest, AFullServerIsNotTheEnd) {
  agent().begin_session();
  EXPECT_FALSE(error(ErrorCode::server_full));
}

TEST_F(AgentTest, AnswersATurnWithAShot) {
  log_in();
  start_game();
  give_turn(1);
  ASSERT_EQ(outside_.thoughts.size(), 1U);
  EXPECT_EQ(outside_.thoughts[0].info.opponent, "somebody");
  EXPECT_EQ(outside_.thoughts[0].task.state.balls.size(), 16U);
  choose(1);
  const auto shot = std::get<protocol::Shot>(last().request);
  EXPECT_EQ(shot.game, GameId{17});
  EXPECT_EQ(shot.turn, 1U);
  EXPECT_EQ(shot.params.phi, 90);
}

TEST_F(AgentTest, SendsThePendingShotAgainAfterAReconnectionWithoutThinkingTwice) {
  log_in();
  start_game();
  give_turn(1);
  choose(1);
  const auto first = std::get<protocol::Shot>(last().request);
  agent().session_ended();
  log_in();
  give_turn(1);
  EXPECT_EQ(std::get<protocol::Shot>(last().request), first);
  EXPECT_EQ(outside_.thoughts.size(), 1U);
}

TEST_F(AgentTest, AMoveChosenWhileDisconnectedIsSentWhenTheTurnComesAgain) {
  log_in();
  start_game();
  give_turn(1);
  agent().session_ended();
  const std::size_t before = outside_.lines.size();
  choose(1);
  EXPECT_EQ(outside_.lines.size(), before);
  log_in();
  give_turn(1);
  EXPECT_TRUE(std::holds_alternative<protocol::Shot>(last().request));
}

TEST_F(AgentTest, ARefusedShotMakesItThinkAgain) {
  log_in();
  start_game();
  give_turn(1);
  choose(1);
  ASSERT_FALSE(error(ErrorCode::bad_shot));
  ASSERT_EQ(outside_.thoughts.size(), 2U);
  EXPECT_EQ(outside_.thoughts[1].task.key.refusals, 1U);
}

TEST_F(AgentTest, AsksForAGameThatItDoesNotKnow) {
  log_in();
  give_turn(1);
  EXPECT_EQ(std::get<protocol::Sync>(last().request).game, GameId{17});
  const auto start = test_support::scripted_start(GameId{17});
  ASSERT_FALSE(reply(
      protocol::SyncReply<Outgoing>{.snapshot = {start.terms, start.state, {600'000, 600'000, {}}},
                                    .pending = test_support::scripted_turn(GameId{17}, 1)}));
  EXPECT_EQ(outside_.thoughts.size(), 1U);
}

TEST_F(AgentTest, AStaleTurnIsDropped) {
  log_in();
  start_game();
  give_turn(1);
  choose(1);
  ASSERT_FALSE(error(ErrorCode::stale_turn));
  EXPECT_EQ(outside_.thoughts.size(), 1U);
  give_turn(2);
  EXPECT_EQ(outside_.thoughts.size(), 2U);
}

TEST_F(AgentTest, ARateLimitedShotIsSentAgainLaterAsItWas) {
  log_in();
  start_game();
  give_turn(1);
  choose(1);
  const auto first = std::get<protocol::Shot>(last().request);
  ASSERT_FALSE(error(ErrorCode::rate_limited));
  ASSERT_THAT(outside_.woken, testing::ElementsAre(GameId{17}));
  agent().send_answer_again(GameId{17});
  EXPECT_EQ(std::get<protocol::Shot>(last().request), first);
}

TEST_F(AgentTest, APlayerWhoseEveryMoveIsRefusedConcedes) {
  log_in();
  start_game();
  give_turn(1);
  for (std::uint32_t refusals = 0; refusals < 10; ++refusals) {
    choose(1, refusals);
    ASSERT_FALSE(error(ErrorCode::invalid_params));
  }
  choose(1, 10);
  EXPECT_TRUE(std::holds_alternative<protocol::Concede>(last().request));
}

TEST_F(AgentTest, AcknowledgesTheEndOfAGame) {
  settings_.games = 1;
  log_in();
  start_game();
  ASSERT_FALSE(notify(test_support::scripted_over(GameId{17})));
  EXPECT_EQ(std::get<protocol::Ack>(last().request).what, protocol::Ended{GameId{17}});
  const auto end = reply(protocol::AckReply{GameId{17}});
  ASSERT_TRUE(end);
  EXPECT_EQ(end->ending, Ending::finished);
}

TEST_F(AgentTest, SupersededIsTheEnd) {
  log_in();
  const auto end = notify(protocol::Superseded{});
  ASSERT_TRUE(end);
  EXPECT_EQ(end->ending, Ending::superseded);
}

TEST_F(AgentTest, AnswersLagProbesAtOnce) {
  log_in();
  ASSERT_FALSE(notify(protocol::LagProbe{4711}));
  const auto incoming = last();
  EXPECT_FALSE(incoming.id);
  EXPECT_EQ(std::get<protocol::Lag>(incoming.request).t, 4711);
}

TEST_F(AgentTest, RepeatsAnUnansweredChallengeUnderTheSameId) {
  settings_.challenges = {protocol::Challenge{.opponent = "house:greedy"}};
  log_in();
  const auto first = std::get<protocol::Challenge>(last().request);
  agent().session_ended();
  log_in();
  const auto second = std::get<protocol::Challenge>(last().request);
  EXPECT_EQ(first, second);
  ASSERT_FALSE(reply(
      protocol::ChallengeReply{protocol::ChallengeId{3}, protocol::ChallengeStatus::accepted, {}}));
  agent().session_ended();
  log_in();
  EXPECT_FALSE(std::holds_alternative<protocol::Challenge>(last().request));
}

TEST_F(AgentTest, IgnoresLinesThatItDoesNotUnderstand) {
  log_in();
  EXPECT_FALSE(agent().line_came("{\"jsonrpc\":\"2.0\",\"method\":\"new.thing\",\"params\":{}}"));
  EXPECT_FALSE(agent().line_came("nonsense"));
}

}  // namespace
}  // namespace poolhall::client
