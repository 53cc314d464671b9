// Our clients against the real program with its house bots in processes of their own.
#include <gtest/gtest.h>

#include <string>

#include "clients/cpp/client.hpp"
#include "recording_proxy.hpp"
#include "server_process.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

TEST(ClientPrograms, ThePythonExamplePlaysAWholeGameAgainstGreedy) {
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path()};
  const RecordingProxy proxy{server.port()};
  const test_support::Ran played = test_support::run_command(
      "timeout 200 python3 " POOLHALL_SOURCE_DIR "/clients/python/example_bot.py 127.0.0.1:" +
      std::to_string(proxy.port()));
  EXPECT_EQ(played.exit_code, 0) << played.err;
  EXPECT_EQ(played.out.rfind("game over:", 0), 0U) << played.err;
}

TEST(ClientPrograms, TheCppClientPlaysAHouseBotToTheEnd) {
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path()};
  const RecordingProxy proxy{server.port()};
  client::ClientOptions options;
  options.port = std::to_string(proxy.port());
  options.agent.name = "conceder";
  options.agent.challenges = {protocol::Challenge{.opponent = "house:random"}};
  options.agent.games = 1;
  std::size_t turns = 0;
  const client::End end = client::play(options, [&turns](const client::TurnView& turn) {
    ++turns;
    if (turn.state.kind == rules::TurnKind::decision) {
      return client::Move{turn.state.options.front()};
    }
    if (turns > 5) {
      return client::Move{client::Concede{}};
    }
    client::Shot shot{{.b = 20, .theta = 60, .phi = 90, .v = 3}, {}, {}};
    if (turn.state.kind != rules::TurnKind::shot) {
      shot.cue_ball = {0.3, 0.3};
    }
    if (turn.state.kind != rules::TurnKind::break_shot) {
      shot.call.kind = rules::Call::Kind::safety;
    }
    return client::Move{shot};
  });
  EXPECT_EQ(end.ending, client::Ending::finished) << end.reason;
  EXPECT_GT(turns, 0U);
}

}  // namespace
}  // namespace poolhall::net_tests
