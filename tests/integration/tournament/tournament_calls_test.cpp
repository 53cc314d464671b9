// `poolhall tournament create | start | ...` against a running server.
#include <gmock/gmock.h>

#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <regex>
#include <string>
#include <thread>

#include "program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::tournament {
namespace {

using testing::HasSubstr;

constexpr std::chrono::minutes patience{10};

const std::string four_bots =
    "name = \"cup\"\nformat = \"swiss\"\nrounds = 2\ngames_per_match = 2\nseed = 3\n"
    "max_concurrent_games = 2\n[clock]\ngame_seconds = 60\n"
    "[[entry]]\nname = \"a\"\nhouse = \"random\"\n[[entry]]\nname = \"b\"\nhouse = \"random\"\n"
    "[[entry]]\nname = \"c\"\nhouse = \"random\"\n[[entry]]\nname = \"d\"\nhouse = \"random\"\n";

class TournamentCalls : public testing::Test {
 protected:
  TournamentCalls() {
    std::ofstream(directory_ / "cup.toml") << four_bots;
    std::ofstream(directory_ / "token") << std::string(64, 'a') << '\n';
    chmod((directory_ / "token").c_str(), S_IRUSR | S_IWUSR);
    server_ = std::make_unique<Program>(
        directory_.path(),
        std::vector<std::string>{"serve", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0",
                                 "--db", "server.db", "--admin-token-file", "token"});
    static const std::regex page("page on (127\\.0\\.0\\.1:\\d+)");
    std::smatch found;
    while (const auto line = server_->next_line()) {
      const std::string& text = *line;
      if (std::regex_search(text, found, page)) {
        address_ = found[1];
        break;
      }
    }
  }

  struct Answer {
    int code = -1;
    std::string text;
  };
  [[nodiscard]] Answer call(std::vector<std::string> words) const {
    words.insert(words.begin(), "tournament");
    Program program(directory_.path(), words);
    Answer answer;
    answer.text = program.rest();
    answer.code = program.wait();
    return answer;
  }
  [[nodiscard]] Answer at_server(std::vector<std::string> words) const {
    words.insert(words.end(), {"--server", address_});
    return call(words);
  }
  [[nodiscard]] Answer as_host(std::vector<std::string> words) const {
    words.insert(words.end(), {"--admin-token-file", "token"});
    return at_server(words);
  }

  test_support::TemporaryDirectory directory_;
  std::unique_ptr<Program> server_;
  std::string address_;
};

TEST_F(TournamentCalls, ATournamentIsCreatedStartedPausedAndPlayedToItsTable) {
  ASSERT_FALSE(address_.empty());
  EXPECT_EQ(at_server({"create", "cup.toml"}).code, 2) << "without a token";
  const Answer created = as_host({"create", "cup.toml"});
  ASSERT_EQ(created.code, 0) << created.text;
  EXPECT_THAT(at_server({"list"}).text, HasSubstr("swiss, 4 entries"));
  EXPECT_EQ(as_host({"start", "cup"}).code, 0);
  EXPECT_EQ(as_host({"pause", "cup"}).code, 0);
  EXPECT_EQ(as_host({"resume", "cup"}).code, 0);
  EXPECT_EQ(as_host({"start", "no-such-cup"}).code, 1);
  const auto until = std::chrono::steady_clock::now() + patience;
  std::string status;
  while (status.find("finished") == std::string::npos && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds{300});
    status = at_server({"status", "cup"}).text;
  }
  EXPECT_THAT(status, HasSubstr("Tournament cup: finished, swiss, 4 entries\n4 of 4 matches over"));
  for (const char* table : {"standings", "crosstable"}) {
    for (const char* format : {"text", "csv", "json"}) {
      const Answer online = at_server({table, "cup", "--format", format});
      const Answer offline = call({table, "cup", "--format", format, "--db", "server.db"});
      EXPECT_EQ(online.code, 0) << online.text;
      EXPECT_EQ(online.text, offline.text) << table << ' ' << format;
    }
  }
  const Answer trf = at_server({"export", "cup", "--trf"});
  EXPECT_EQ(trf.code, 0);
  EXPECT_THAT(trf.text, HasSubstr("\nXXR 2\n"));
  EXPECT_EQ(trf.text, call({"export", "cup", "--trf", "--db", "server.db"}).text);
  EXPECT_EQ(at_server({"standings", "no-such-cup"}).code, 1);
}

}  // namespace
}  // namespace poolhall::tournament
