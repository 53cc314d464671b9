// Every limit is reached once, and what happens then is said on the wire.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <stdexcept>

#include "scripted_play.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;

class LimitsTest : public ::testing::Test {
 protected:
  // Before the first use of server().
  protocol::Limits& limits() { return options_.settings.limits; }
  TestServer& server() {
    if (!server_) {
      server_ = std::make_unique<TestServer>(options_);
    }
    return *server_;
  }
  [[nodiscard]] std::uint16_t port() { return server().port(); }

  // One of two agents asks for 9 MB of replies and reads none: it is sent away for that, and the
  // other one is served as before.
  void leave_replies_unread() {
    limits().input_bytes_per_second = 1 << 30;
    limits().messages_per_second = 1e6;
    limits().message_burst = 1e6;
    WireClient anna{port()};
    anna.join("anna");
    WireClient lazy{port()};
    lazy.join("lazy");
    // Its system would take all of the replies; the server's alone takes 4 MB of them.
    const int taken = 64 * 1024;
    ::setsockopt(lazy.descriptor(), SOL_SOCKET, SO_RCVBUF, &taken, sizeof taken);
    const std::string ping = R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{"t":")" +
                             std::string(3'000, 'x') + "\"}}\n";
    lazy.send_bytes(ping);
    // Past the recorder, which reads each of them again.
    for (int i = 0; i < 3'000; ++i) {
      static_cast<void>(::send(lazy.descriptor(), ping.data(), ping.size(), MSG_NOSIGNAL));
    }
    std::string last;
    while (auto line = lazy.read_line()) {
      last = std::move(*line);
    }
    EXPECT_NE(last.find("unread_output"), std::string::npos) << last.substr(0, 200);
    static_cast<void>(anna.call<protocol::PingReply>(protocol::Ping{}));
  }

  test_support::TemporaryDirectory directory_;
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::unique_ptr<TestServer> server_;
};

// The error that the server sends without having been asked, right before the end.
std::string last_words(WireClient& client) {
  std::string code;
  while (const auto message = client.next_message()) {
    if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
      code = error->code;
    }
  }
  return code;
}

TEST_F(LimitsTest, ABadLineIsAnsweredAndTheConnectionStays) {
  WireClient client{port()};
  client.send_bytes("this is no JSON\n");
  const auto message = client.next_message();
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<protocol::ErrorMessage>(*message).number, -32700);
  client.join("anna");
}

TEST_F(LimitsTest, AWrongFieldIsNamed) {
  WireClient client{port()};
  client.send_bytes(
      R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"protocol":"x","name":"n"}})"
      "\n");
  const auto message = client.next_message();
  ASSERT_TRUE(message);
  const auto& error = std::get<protocol::ErrorMessage>(*message).error;
  EXPECT_EQ(error.field, "/params/protocol");
  EXPECT_NE(error.reason, "");
}

TEST_F(LimitsTest, TwentyBadLinesInARowEndTheConnection) {
  WireClient client{port()};
  for (int i = 0; i < 20; ++i) {
    client.send_bytes("nonsense\n");
  }
  EXPECT_EQ(last_words(client), "too_many_errors");
}

TEST_F(LimitsTest, AGoodLineBetweenBadOnesStartsTheirCountAgain) {
  limits().bad_lines_in_a_row = 3;
  WireClient client{port()};
  client.join("anna");
  for (int i = 0; i < 5; ++i) {
    client.send_bytes("nonsense\nnonsense\n");
    static_cast<void>(client.call<protocol::PingReply>(protocol::Ping{}));
  }
}

TEST_F(LimitsTest, NothingComesBeforeHello) {
  WireClient client{port()};
  EXPECT_EQ(client.refused(protocol::Ping{}).code, "not_logged_in");
  client.hello();
  EXPECT_EQ(client.refused(protocol::TournamentList{}).code, "not_logged_in");
}

TEST_F(LimitsTest, AnotherProtocolIsRefusedAndTheConnectionEnds) {
  WireClient client{port()};
  protocol::Hello hello;
  hello.least_protocol = 7;
  hello.most_protocol = 9;
  hello.name = "future";
  EXPECT_EQ(client.refused(hello).code, "unsupported_protocol");
  EXPECT_FALSE(client.read_line());
}

TEST_F(LimitsTest, WhoDoesNotLogInInTimeIsSentAway) {
  limits().login_deadline = milliseconds{100};
  WireClient client{port()};
  client.hello();
  EXPECT_EQ(last_words(client), "too_slow");
}

TEST_F(LimitsTest, AnUnfinishedLineIsNotWaitedForForEver) {
  limits().line_deadline = milliseconds{100};
  WireClient client{port()};
  client.join("anna");
  client.send_bytes("{\"jsonrpc\":");
  EXPECT_EQ(last_words(client), "too_slow");
}

TEST_F(LimitsTest, ALineThatIsTooLongIsSkippedAndSaid) {
  limits().line_bytes = 2'048;
  WireClient client{port()};
  client.join("anna");
  client.send_bytes(std::string(5'000, 'x') + "\n");
  for (;;) {
    const auto message = client.next_message();
    ASSERT_TRUE(message);
    if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
      EXPECT_EQ(error->code, "line_too_long");
      break;
    }
  }
  static_cast<void>(client.call<protocol::PingReply>(protocol::Ping{}));
}

TEST_F(LimitsTest, TooManyMessagesAreRefusedButNotTheAnswerToAPendingTurn) {
  limits().messages_per_second = 1;
  limits().message_burst = 10;
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  const protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  bool limited = false;
  for (int i = 0; i < 20 && !limited; ++i) {
    const auto answer = anna.answer_to(anna.send(protocol::Ping{}));
    const auto* error = std::get_if<protocol::ErrorMessage>(&answer);
    limited = error != nullptr && error->code == "rate_limited" && error->retryable;
  }
  EXPECT_TRUE(limited);
  EXPECT_EQ(anna.call<protocol::ShotReply<Received>>(shot).shot.turn, 1U);
}

TEST_F(LimitsTest, AFloodEndsItsOwnConnectionOnly) {
  WireClient anna{port()};
  WireClient flood{port()};
  anna.join("anna");
  flood.join("flood");
  std::string many;
  for (int i = 0; i < 200; ++i) {
    many += R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{"t":1}})"
            "\n";
  }
  for (int i = 0; i < 20; ++i) {
    flood.send_bytes(many);
  }
  std::string code;
  while (const auto line = flood.read_line()) {
    if (line->find("rate_limited") != std::string::npos) {
      code = "rate_limited";
    }
  }
  EXPECT_EQ(code, "rate_limited");
  static_cast<void>(anna.call<protocol::PingReply>(protocol::Ping{}));
}

TEST_F(LimitsTest, OneAddressHasABoundedNumberOfConnections) {
  limits().connections_per_address = 2;
  WireClient first{port()};
  WireClient second{port()};
  first.hello();
  second.hello();
  WireClient third{port()};
  EXPECT_EQ(last_words(third), "server_full");
  first.close();
  // The place is free once the server has seen the end of the first.
  for (;;) {
    WireClient again{port()};
    again.send_bytes(R"({"jsonrpc":"2.0","id":1,"method":"nothing"})"
                     "\n");
    const auto line = again.read_line();
    if (line && line->find("server_full") == std::string::npos) {
      break;
    }
  }
}

TEST_F(LimitsTest, AFullServerSaysSo) {
  limits().connections = 1;
  WireClient first{port()};
  first.hello();
  WireClient second{port()};
  EXPECT_EQ(last_words(second), "server_full");
}

TEST_F(LimitsTest, WhoDoesNotReadIsSentAwayAndNobodyElse) {
  limits().output_queue_bytes = 64 * 1024;
  leave_replies_unread();
}

TEST_F(LimitsTest, WhoLeavesMostUnreadIsSentAwayWhenAllTogetherLeaveTooMuch) {
  limits().output_bytes_in_all = 128 * 1024;
  leave_replies_unread();
}

// The sender has used up its pace for half a minute, and its clock has two seconds. What it sent
// fits into the window of a new connection, so that all of it has arrived by then.
TEST_F(LimitsTest, AnAnswerThatWaitsForItsSendersPaceIsReadBeforeTheFlagFalls) {
  limits().input_bytes_per_second = 1024;
  limits().input_burst_bytes = 64 * 1024;
  limits().message_burst = 1'000;
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  protocol::ClockSettings clock;
  clock.game_ms = 2'000;
  const protocol::GameId game = start_game(anna, bert, "bert", clock);
  const Turn turn = anna.wait_for<Turn>();
  const protocol::Ping ping{protocol::RawJson{'"' + std::string(10'000, 'x') + '"'}};
  for (int i = 0; i < 9; ++i) {
    static_cast<void>(anna.send(ping));
  }
  const auto reply = anna.call<protocol::ShotReply<Received>>(scripted_shot(turn));
  EXPECT_EQ(reply.shot.game, game);
  EXPECT_EQ(reply.shot.turn, turn.turn);
}

TEST_F(LimitsTest, AnAgentsOldChallengesMakeRoomForNewOnes) {
  limits().messages_per_second = 1e6;
  limits().message_burst = 1e6;
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  protocol::Challenge challenge;
  challenge.opponent = "bert";
  const auto ask = [&](int i) {
    challenge.challenge_id = protocol::ShotId{std::to_string(i)};
    return anna.call<protocol::ChallengeReply>(challenge).challenge;
  };
  const auto decline = [&](protocol::ChallengeId id) {
    static_cast<void>(bert.call<protocol::ChallengeReply>(protocol::ChallengeDecline{id}));
  };
  const auto first = ask(0);
  decline(first);
  EXPECT_EQ(ask(0), first);
  protocol::ChallengeId last{};
  for (int i = 1; i <= 256; ++i) {
    last = ask(i);
    decline(last);
  }
  EXPECT_EQ(ask(256), last);
  EXPECT_NE(ask(0), first);
}

TEST_F(LimitsTest, AnAddressMakesOnlySoManyConnectionsAtOnce) {
  std::string code;
  for (int i = 0; i < 1'000 && code.empty(); ++i) {
    WireClient client{port()};
    client.send_bytes(R"({"jsonrpc":"2.0","id":1,"method":"nothing"})"
                      "\n");
    const auto line = client.read_line();
    code = line && line->find("rate_limited") != std::string::npos ? "rate_limited" : "";
  }
  EXPECT_EQ(code, "rate_limited");
}

TEST_F(LimitsTest, AnAddressRegistersOnlySoManyAgentsAtOnce) {
  limits().connections_per_address = 60;
  std::string code;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds{60};
  for (int i = 0; code.empty() && std::chrono::steady_clock::now() < patience; ++i) {
    try {
      WireClient client{port()};
      client.hello();
      auto answer = client.answer_to(client.send(protocol::Register{"a" + std::to_string(i), {}}));
      if (const auto* refused = std::get_if<protocol::ErrorMessage>(&answer)) {
        code = refused->code;
      }
    } catch (const std::runtime_error&) {  // NOLINT(bugprone-empty-catch): the next comes in
      // Turned away at the door, where connections have a rate of their own.
    }
  }
  EXPECT_EQ(code, "rate_limited");
}

TEST_F(LimitsTest, LinesMayComeByteByByteOrManyAtOnce) {
  WireClient client{port()};
  const std::string hello = protocol::encode_request(1, protocol::Hello{1, 1, "bytes", {}, {}});
  for (const char byte : hello) {
    client.send_bytes({&byte, 1});
  }
  EXPECT_NE(client.read_line()->find("\"result\""), std::string::npos);
  std::string many = protocol::encode_request(2, protocol::Register{"anna", {}});
  for (int i = 3; i < 20; ++i) {
    many += protocol::encode_request(i, protocol::Ping{});
  }
  client.send_bytes(many);
  int replies = 0;
  while (replies < 18) {
    const auto line = client.read_line();
    ASSERT_TRUE(line);
    replies += line->find("\"result\"") != std::string::npos ? 1 : 0;
  }
}

TEST_F(LimitsTest, ATokenOpensItsOwnAgentAndNoOther) {
  const std::string token(64, 'a');
  {
    WireClient anna{port()};
    anna.hello();
    const auto reply =
        anna.call<protocol::LoginReply>(protocol::Register{"anna", protocol::Hex256{token}});
    EXPECT_EQ(reply.token->text, token);
  }
  WireClient other{port()};
  other.hello();
  EXPECT_EQ(other.refused(protocol::Login{{std::string(64, 'b')}}).code, "unauthorized");
  EXPECT_EQ(other.refused(protocol::Register{"Anna", {}}).code, "name_taken");
  EXPECT_EQ(other.refused(protocol::Register{"an na", {}}).number < 0, true);
}

TEST_F(LimitsTest, ARegistrationWhoseReplyWasLostIsRepeated) {
  limits().takeover_interval = milliseconds{0};
  const std::string token(64, 'c');
  const protocol::Register request{"anna", protocol::Hex256{token}};
  {
    WireClient anna{port()};
    anna.hello();
    static_cast<void>(anna.call<protocol::LoginReply>(request));
  }
  WireClient anna{port()};
  anna.hello();
  EXPECT_EQ(anna.call<protocol::LoginReply>(request).agent, "anna");
}

TEST_F(LimitsTest, ClosedRegistrationIsClosed) {
  options_.settings.registration = "closed";
  WireClient client{port()};
  client.hello();
  EXPECT_EQ(client.refused(protocol::Register{"anna", {}}).code, "registration_closed");
}

TEST_F(LimitsTest, TwoLoginsWithinASecondAreOneTooMany) {
  limits().takeover_interval = milliseconds{60'000};
  WireClient anna{port()};
  const std::string token = anna.join("anna");
  WireClient second{port()};
  second.hello();
  EXPECT_EQ(second.refused(protocol::Login{{token}}).code, "rate_limited");
  static_cast<void>(anna.call<protocol::PingReply>(protocol::Ping{}));
}

TEST_F(LimitsTest, AChallengeThatNobodyAnswersExpires) {
  limits().challenge_expiry = milliseconds{50};
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  protocol::Challenge challenge;
  challenge.opponent = "bert";
  const auto offered = anna.call<protocol::ChallengeReply>(challenge);
  const auto over = anna.wait_for<protocol::ChallengeOver>();
  EXPECT_EQ(over.challenge, offered.challenge);
  EXPECT_EQ(over.outcome, protocol::ChallengeOutcome::expired);
  EXPECT_EQ(bert.refused(protocol::ChallengeAccept{offered.challenge}).code, "conflicting_request");
}

TEST_F(LimitsTest, AChallengeAskedAgainIsTheSameChallenge) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  protocol::Challenge challenge;
  challenge.opponent = "bert";
  challenge.challenge_id = protocol::ShotId{"\"once\""};
  const auto first = anna.call<protocol::ChallengeReply>(challenge);
  const auto second = anna.call<protocol::ChallengeReply>(challenge);
  EXPECT_EQ(first.challenge, second.challenge);
  challenge.noise = "none";
  EXPECT_EQ(anna.refused(challenge).code, "conflicting_request");
}

TEST_F(LimitsTest, NobodyChallengesWhomThereIsNot) {
  WireClient anna{port()};
  anna.join("anna");
  for (const char* opponent : {"house:nobody", "nobody", "anna"}) {
    protocol::Challenge challenge;
    challenge.opponent = opponent;
    EXPECT_EQ(anna.refused(challenge).code, "unknown_agent") << opponent;
  }
  protocol::Challenge challenge;
  challenge.opponent = "house:nobody";
  EXPECT_EQ(anna.refused(challenge).error.reason,
            "unknown_agent: got \"house:nobody\", expected one of house:random, house:greedy, "
            "house:planner");
}

}  // namespace
}  // namespace poolhall::net_tests
