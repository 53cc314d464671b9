// The key table of the code, config/README.md and the files in config/ say the same.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "server/settings/document.hpp"
#include "server/settings/files.hpp"
#include "server/settings/server_settings.hpp"
#include "server/settings/tournament_settings.hpp"

namespace poolhall::settings {
namespace {

const std::string config = std::string(POOLHALL_SOURCE_DIR) + "/config";

std::string read(const std::string& file) {
  auto content = read_file(file);
  EXPECT_TRUE(content) << file;
  return content.value_or("");
}

// A row of the page: | `key` | what it accepts | `default` | meaning |
struct Row {
  std::string expected;
  std::string default_value;
  std::string meaning;
};

std::string trimmed(const std::string& cell) {
  const auto first = cell.find_first_not_of(' ');
  const auto last = cell.find_last_not_of(' ');
  return first == std::string::npos ? "" : cell.substr(first, last - first + 1);
}

std::string without_ticks(const std::string& cell) {
  return cell.size() >= 2 && cell.front() == '`' ? cell.substr(1, cell.size() - 2) : cell;
}

// Rows below the heading `## section`, by key.
std::map<std::string, Row> rows(const std::string& section) {
  std::istringstream page(read(config + "/README.md"));
  std::map<std::string, Row> found;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) {
      inside = line == "## " + section;
    }
    if (!inside || !line.starts_with("| `")) {
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) {
      cells.push_back(trimmed(cell));
    }
    EXPECT_EQ(cells.size(), 4u) << line;
    cells.resize(4);
    const auto [where, is_new] =
        found.insert({without_ticks(cells[0]), {cells[1], without_ticks(cells[2]), cells[3]}});
    EXPECT_TRUE(is_new) << "twice: " << line;
  }
  return found;
}

void expect_documented(const std::vector<KeyDoc>& keys, const std::map<std::string, Row>& page) {
  for (const KeyDoc& key : keys) {
    const auto row = page.find(key.name);
    ASSERT_NE(row, page.end()) << "not in config/README.md: " << key.name;
    EXPECT_EQ(row->second.expected, key.expected) << key.name;
    EXPECT_EQ(row->second.default_value, key.default_value.value_or("")) << key.name;
    EXPECT_FALSE(row->second.meaning.empty()) << key.name;
  }
  EXPECT_EQ(page.size(), keys.size()) << "config/README.md has keys that the code has not";
}

void collect_names(const Node& node, const std::string& prefix, std::vector<std::string>& names) {
  for (const Member& member : std::get<Table>(node.value)) {
    if (std::holds_alternative<Table>(member.node.value)) {
      collect_names(member.node, prefix + member.key + ".", names);
    } else {
      names.push_back(prefix + member.key);
    }
  }
}

TEST(Documentation, EveryServerKeyIsOnThePageWithItsDefault) {
  expect_documented(server_keys(), rows("The server: poolhall.toml"));
}

TEST(Documentation, EveryTournamentKeyIsOnThePageWithItsDefault) {
  expect_documented(tournament_keys(), rows("A tournament: tournaments/*.toml"));
}

TEST(Documentation, TheServersFileHasEveryKeyOnceInOrder) {
  const auto root = parse_document(read(config + "/poolhall.toml"), "poolhall.toml");
  ASSERT_TRUE(root);
  std::vector<std::string> in_file;
  collect_names(*root, "", in_file);
  std::vector<std::string> in_code;
  for (const KeyDoc& key : server_keys()) {
    in_code.push_back(key.name);
  }
  EXPECT_EQ(in_file, in_code);
}

TEST(Documentation, TheServersFileHasEveryKeyAtItsDefault) {
  for (const KeyDoc& key : server_keys()) {
    ASSERT_TRUE(key.default_value) << key.name;
    const std::string line =
        key.name.substr(key.name.rfind('.') + 1) + " = " + *key.default_value + "\n";
    EXPECT_THAT(read(config + "/poolhall.toml"), testing::HasSubstr("\n" + line)) << key.name;
  }
}

TEST(Documentation, EveryTournamentFileCanBeRead) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(config + "/tournaments")) {
    if (file.path().extension() != ".toml") {
      continue;
    }
    const auto tournament = load_tournament(file.path().string());
    EXPECT_TRUE(tournament) << text(tournament.error());
    ++files;
  }
  EXPECT_GE(files, 1u);
}

}  // namespace
}  // namespace poolhall::settings
