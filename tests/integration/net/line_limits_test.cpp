// The limits of lines and words, each reached from both sides.
#include <gtest/gtest.h>

#include "protocol/events_json.hpp"
#include "scripted_play.hpp"
#include "server/storage/sqlite_database.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;

class LineLimits : public ::testing::Test {
 protected:
  // Before the first use of port().
  protocol::Limits& limits() { return options_.settings.limits; }
  [[nodiscard]] std::uint16_t port() {
    if (!server_) {
      server_ = std::make_unique<TestServer>(options_);
    }
    return server_->port();
  }
  // The code of the error that this line is answered with, "" for a result.
  static std::string answer_to(WireClient& client, const std::string& line) {
    client.send_bytes(line + "\n");
    for (;;) {
      const std::string came = client.read_line().value();
      if (came.find("\"result\"") != std::string::npos) {
        return "";
      }
      const std::string key = "\"data\":{\"code\":\"";
      if (const auto at = came.find(key); at != std::string::npos) {
        const auto from = at + key.size();
        return came.substr(from, came.find('"', from) - from);
      }
    }
  }
  static std::string ping(const std::string& params) {
    return R"({"jsonrpc":"2.0","id":1,"method":"ping","params":)" + params + "}";
  }
  // A ping whose line has exactly so many bytes.
  static std::string ping_of(std::size_t bytes) {
    const std::string empty = ping(R"({"t":""})");
    return ping(R"({"t":")" + std::string(bytes - empty.size(), 'x') + "\"}");
  }

  test_support::TemporaryDirectory directory_;
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::unique_ptr<TestServer> server_;
};

// Where a ball was is only known from the states; the cue ball never rests at the frame's origin.
bool has_states(const physics::EventLog<double>& events) {
  return events.at(0).after[0].position.x != 0;
}

TEST_F(LineLimits, OfBytesAreFourKiBBeforeLoginAndSixtyFourAfter) {
  WireClient client{port()};
  client.hello();
  EXPECT_EQ(answer_to(client, ping_of(4'096)), "not_logged_in");
  EXPECT_EQ(answer_to(client, ping_of(4'097)), "line_too_long");
  static_cast<void>(client.call<protocol::LoginReply>(protocol::Register{"anna", {}}));
  EXPECT_EQ(answer_to(client, ping_of(65'536)), "");
  EXPECT_EQ(answer_to(client, ping_of(65'537)), "line_too_long");
  EXPECT_EQ(answer_to(client, ping_of(65'536) + "\r"), "");
}

TEST_F(LineLimits, OfNestingAreSixteen) {
  WireClient client{port()};
  client.join("anna");
  const auto nested = [](int depth) {
    return ping("{\"x\":" + std::string(static_cast<std::size_t>(depth) - 2, '[') +
                std::string(static_cast<std::size_t>(depth) - 2, ']') + "}");
  };
  EXPECT_EQ(answer_to(client, nested(16)), "");
  EXPECT_EQ(answer_to(client, nested(17)), "parse_error");
}

TEST_F(LineLimits, OfKeysAre256InAllObjectsTogether) {
  WireClient client{port()};
  client.join("anna");
  const auto with_keys = [](int count) {
    std::string params = "{";
    for (int i = 0; i < count - 4; ++i) {
      params += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":0";
    }
    return ping(params + "}");
  };
  EXPECT_EQ(answer_to(client, with_keys(256)), "");
  EXPECT_EQ(answer_to(client, with_keys(257)), "parse_error");
}

TEST_F(LineLimits, OfNamesAreOneTo32) {
  WireClient client{port()};
  client.hello();
  EXPECT_EQ(client.refused(protocol::Register{"", {}}).code, "bad_name");
  EXPECT_EQ(client.refused(protocol::Register{std::string(33, 'a'), {}}).code, "bad_name");
  const std::string longest = std::string(29, 'Z') + "._-";
  EXPECT_EQ(client.call<protocol::LoginReply>(protocol::Register{longest, {}}).agent, longest);
}

TEST_F(LineLimits, OfShotIdsAre64Characters) {
  WireClient client{port()};
  client.join("anna");
  const auto shot = [](std::size_t length) {
    std::string id;
    for (std::size_t i = 0; i < length; ++i) {
      id += "\u00e9";  // two bytes, one character
    }
    return R"({"jsonrpc":"2.0","id":1,"method":"shot","params":{"game":1,"turn":1,"shot_id":")" +
           id + R"(","params":{"a":0,"b":0,"theta":5,"phi":0,"v":1}}})";
  };
  EXPECT_EQ(answer_to(client, shot(64)), "unknown_game");
  EXPECT_EQ(answer_to(client, shot(65)), "invalid_params");
  EXPECT_EQ(answer_to(client, shot(0)), "invalid_params");
}

TEST_F(LineLimits, OfAClientsNameAre64Bytes) {
  const auto hello = [](std::size_t length) {
    return R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"protocol":[1,1],"name":"a",)"
           R"("client":{"name":")" +
           std::string(length, 'c') + "\"}}}";
  };
  WireClient client{port()};
  EXPECT_EQ(answer_to(client, hello(65)), "invalid_params");
  EXPECT_EQ(answer_to(client, hello(64)), "");
}

TEST_F(LineLimits, AreToldInHellosReply) {
  limits().line_bytes = 30'000;
  limits().nesting = 12;
  limits().max_refusals = 7;
  WireClient client{port()};
  protocol::Hello hello;
  hello.name = "a";
  const auto told = client.call<protocol::HelloReply>(hello).limits;
  EXPECT_EQ(told.line_bytes, 30'000U);
  EXPECT_EQ(told.nesting, 12U);
  EXPECT_EQ(told.max_refusals, 7U);
  EXPECT_EQ(told.login_deadline, protocol::Limits{}.login_deadline);
}

TEST_F(LineLimits, OfTheServersLinesLeaveOutStatesThenEvents) {
  std::string token;
  protocol::Shot shot;
  {
    WireClient anna{port()};
    WireClient bert{port()};
    token = anna.join("anna");
    bert.join("bert");
    static_cast<void>(start_game(anna, bert, "bert"));
    shot = scripted_shot(anna.wait_for<Turn>());
    const auto reply = anna.call<protocol::ShotReply<Received>>(shot).shot;
    EXPECT_TRUE(has_states(reply.events));
  }
  // The same shot again, from a server whose lines may be so long.
  const auto events_within = [&](std::size_t line_bytes) {
    server_.reset();
    limits().server_line_bytes = line_bytes;
    WireClient anna{port()};
    anna.login(token);
    return anna.call<protocol::ShotReply<Received>>(shot).shot.events;
  };
  auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
  const std::string full = reader->turn(protocol::GameId{1}, 1).value()->shot->events;
  const std::size_t summary = protocol::summary_of(full).size();
  constexpr std::size_t rest = 16 * 1024;
  EXPECT_TRUE(has_states(events_within(rest + full.size())));
  EXPECT_FALSE(has_states(events_within(rest + full.size() - 1)));
  EXPECT_FALSE(events_within(rest + summary).empty());
  EXPECT_TRUE(events_within(rest + summary - 1).empty());
}

TEST_F(LineLimits, OfATournamentListLeaveOutTheOldestThatAreOver) {
  limits().server_line_bytes = 1'500;
  WireClient client{port()};
  server_->server().post([](net::MatchHost& host) {
    for (int i = 0; i < 9; ++i) {
      const auto status = i == 0 ? net::TournamentStatus::open : net::TournamentStatus::finished;
      host.open_tournament({"cup-" + std::to_string(i), "", "", status});
    }
  });
  client.join("anna");
  const auto list = client.call<protocol::TournamentListReply>(protocol::TournamentList{});
  ASSERT_GE(list.tournaments.size(), 2U);
  EXPECT_LT(list.tournaments.size(), 9U);
  EXPECT_EQ(list.tournaments[0].name, "cup-0");
  EXPECT_EQ(list.tournaments[1].name, "cup-8");
}

TEST_F(LineLimits, OfRefusalsInATurnAreTheHosts) {
  limits().max_refusals = 2;
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  protocol::Shot shot = scripted_shot(anna.wait_for<Turn>());
  shot.params.v = 1'000;
  EXPECT_FALSE(anna.refused(shot).error.foul);
  EXPECT_TRUE(anna.refused(shot).error.foul);
}

TEST_F(LineLimits, OfTakeoversEndWithTheSecond) {
  limits().takeover_interval = milliseconds{200};
  limits().messages_per_second = 1e6;
  limits().message_burst = 1e6;
  WireClient first{port()};
  const std::string token = first.join("anna");
  WireClient second{port()};
  second.hello();
  while (true) {
    const auto answer = second.answer_to(second.send(protocol::Login{{token}}));
    if (std::holds_alternative<protocol::ReplyMessage>(answer)) {
      break;
    }
    EXPECT_EQ(std::get<protocol::ErrorMessage>(answer).code, "rate_limited");
    EXPECT_TRUE(std::get<protocol::ErrorMessage>(answer).retryable);
  }
  static_cast<void>(first.wait_for<protocol::Superseded>());
  EXPECT_FALSE(first.read_line());
}

}  // namespace
}  // namespace poolhall::net_tests
