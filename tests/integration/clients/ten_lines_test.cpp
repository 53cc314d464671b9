// The bot of clients/cpp/README.md, as it stands there.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "clients/bots/exhibition.hpp"
#include "clients/bots/house_bots.hpp"
#include "tests/support/ten_lines.hpp"

namespace poolhall {
namespace {

// The lines of `text` with the spaces around them cut off.
std::vector<std::string> trimmed_lines(std::istream& text) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    const auto first = line.find_first_not_of(' ');
    lines.push_back(first == std::string::npos ? "" : line.substr(first));
  }
  return lines;
}

TEST(TenLineBot, IsTheOneInTheReadme) {
  std::ifstream readme(POOLHALL_SOURCE_DIR "/clients/cpp/README.md");
  std::ifstream here(POOLHALL_SOURCE_DIR "/tests/support/ten_lines.hpp");
  std::ostringstream page;
  page << readme.rdbuf();
  std::size_t found = 0;
  for (const std::string& line : trimmed_lines(here)) {
    if (line.starts_with("if (turn.state") || line.starts_with("return client::Shot{{")) {
      EXPECT_NE(page.str().find(line), std::string::npos) << line;
      ++found;
    }
  }
  EXPECT_EQ(found, 3U);
}

TEST(TenLineBot, PlaysAGameToItsEnd) {
  const auto game = bots::play_exhibition(
      {.seed = 3}, {client::player_from(test_support::ten_lines), *bots::house_bot("greedy", {})});
  EXPECT_EQ(game.fault, "");
  ASSERT_TRUE(game.result.winner);
  EXPECT_GT(game.seats[0].shots, 0U);
}

}  // namespace
}  // namespace poolhall
