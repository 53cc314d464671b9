// `poolhall serve` as a person starts it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "server_process.hpp"
#include "test_server.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/temporary_directory.hpp"
#include "wire_client.hpp"

namespace poolhall::net_tests {
namespace {

using test_support::Ran;

Ran poolhall(const std::string& arguments) {
  return test_support::run_command(std::string{POOLHALL_PROGRAM} + " " + arguments);
}

std::ptrdiff_t lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Program, SaysInOneLineThatItsPortIsInUse) {
  test_support::TemporaryDirectory directory;
  const ServerProcess server{directory.path()};
  const std::string endpoint = "127.0.0.1:" + std::to_string(server.port());
  const Ran ran = poolhall("serve --listen " + endpoint + " --http 127.0.0.1:0 --db " +
                           (directory / "other.db").string());
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_EQ(lines_in(ran.err), 1) << ran.err;
  EXPECT_NE(ran.err.find(endpoint), std::string::npos) << ran.err;
}

TEST(Program, SaysInOneLineThatItsDatabaseIsAnotherServers) {
  test_support::TemporaryDirectory directory;
  const ServerProcess server{directory.path()};
  const Ran ran = poolhall("serve --listen 127.0.0.1:0 --http 127.0.0.1:0 --db " +
                           (directory / "server.db").string());
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_EQ(lines_in(ran.err), 1) << ran.err;
}

TEST(Program, DoesNotOpenItselfToOthersUnasked) {
  const Ran ran = poolhall("serve --listen 0.0.0.0:0 --http 127.0.0.1:0");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(lines_in(ran.err), 1) << ran.err;
}

TEST(Program, RefusesASettingsFileWithAWrongKey) {
  test_support::TemporaryDirectory directory;
  const std::string file = (directory / "wrong.toml").string();
  FILE* out = fopen(file.c_str(), "w");
  fputs("[server]\nlisten_on = \"127.0.0.1:0\"\n", out);
  fclose(out);
  const Ran ran = poolhall("serve --config " + file);
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find(file + ":"), std::string::npos) << ran.err;
}

TEST(Program, StopsInOrderWhenItIsAskedTo) {
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path()};
  WireClient anna{server.port()};
  anna.join("anna");
  EXPECT_EQ(server.terminate(), 0);
  static_cast<void>(anna.wait_for<protocol::ShuttingDown>());
  EXPECT_FALSE(anna.read_line());
}

// The log goes into a pipe that nobody reads: it is full after some hundreds of connections.
TEST(Program, GoesOnWhenNobodyReadsItsLog) {
  test_support::TemporaryDirectory directory;
  const std::string log = (directory / "server.log").string();
  ASSERT_EQ(::mkfifo(log.c_str(), 0600), 0);
  const int reader = ::open(log.c_str(), O_RDONLY | O_NONBLOCK);
  const auto config = directory / "poolhall.toml";
  std::ofstream(config) << "[limits]\nconnections_per_address = 10000\n"
                           "messages_per_second = 100000\nmessage_burst = 100000\n";
  ServerProcess server{directory.path(), {"--config", config.string()}};
  WireClient anna{server.port()};
  anna.join("anna");
  for (int i = 0; i < 1'500; ++i) {
    const WireClient visitor{server.port()};
    static_cast<void>(anna.call<protocol::PingReply>(protocol::Ping{}));
  }
  EXPECT_EQ(server.terminate(), 0);
  ::close(reader);
}

TEST(Program, LogsNoToken) {
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path(), {"--log-json"}};
  WireClient anna{server.port()};
  const std::string token = anna.join("anna");
  EXPECT_EQ(server.terminate(), 0);
  FILE* log = fopen((directory / "server.log").c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::string text(1 << 16, '\0');
  text.resize(fread(text.data(), 1, text.size(), log));
  fclose(log);
  EXPECT_NE(text.find("agent anna"), std::string::npos);
  EXPECT_EQ(text.find(token), std::string::npos);
}

}  // namespace
}  // namespace poolhall::net_tests
