// `poolhall serve` as a person starts it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>

#include "server_process.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"
#include "wire_client.hpp"

namespace poolhall::net_tests {
namespace {

struct Outcome {
  int code = -1;
  std::string said;
};

Outcome run(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe = popen((std::string{POOLHALL_PROGRAM} + " " + arguments + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (fgets(buffer, sizeof buffer, pipe) != nullptr) {
    outcome.said += buffer;
  }
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

std::ptrdiff_t lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Program, SaysInOneLineThatItsPortIsInUse) {
  test_support::TemporaryDirectory directory;
  const ServerProcess server{directory.path()};
  const std::string endpoint = "127.0.0.1:" + std::to_string(server.port());
  const Outcome outcome = run("serve --listen " + endpoint + " --http 127.0.0.1:0 --db " +
                              (directory / "other.db").string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(lines_in(outcome.said), 1) << outcome.said;
  EXPECT_NE(outcome.said.find(endpoint), std::string::npos) << outcome.said;
}

TEST(Program, SaysInOneLineThatItsDatabaseIsAnotherServers) {
  test_support::TemporaryDirectory directory;
  const ServerProcess server{directory.path()};
  const Outcome outcome = run("serve --listen 127.0.0.1:0 --http 127.0.0.1:0 --db " +
                              (directory / "server.db").string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(lines_in(outcome.said), 1) << outcome.said;
}

TEST(Program, DoesNotOpenItselfToOthersUnasked) {
  const Outcome outcome = run("serve --listen 0.0.0.0:0 --http 127.0.0.1:0");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(lines_in(outcome.said), 1) << outcome.said;
}

TEST(Program, RefusesASettingsFileWithAWrongKey) {
  test_support::TemporaryDirectory directory;
  const std::string file = (directory / "wrong.toml").string();
  FILE* out = fopen(file.c_str(), "w");
  fputs("[server]\nlisten_on = \"127.0.0.1:0\"\n", out);
  fclose(out);
  const Outcome outcome = run("serve --config " + file);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.said.find(file + ":"), std::string::npos) << outcome.said;
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
