// What `--help` says: every sub-command and every option has a line that explains it.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::app {
namespace {

std::vector<std::string> help_of(const std::string& arguments) {
  std::FILE* pipe =
      popen((std::string(POOLHALL_PROGRAM) + " " + arguments + " --help").c_str(), "r");
  std::string output;
  std::array<char, 4096> chunk{};
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe)) {
    output.append(chunk.data(), count);
  }
  EXPECT_EQ(pclose(pipe), 0) << arguments;
  std::vector<std::string> lines;
  std::istringstream in(output);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

// Names are indented by two; what explains them follows in a column further right, on the same line
// or, after a long name, on the next.
bool is_option(const std::string& line) {
  return line.starts_with("  -");
}
bool is_name(const std::string& line) {
  return line.size() > 2 && line.starts_with("  ") && line[2] != ' ';
}
bool is_explained(const std::vector<std::string>& lines, std::size_t i) {
  constexpr std::size_t column = 30;
  if (lines[i].size() > column && lines[i].substr(2, column - 2).find("  ") != std::string::npos) {
    return true;
  }
  return i + 1 < lines.size() && lines[i + 1].starts_with("          ");
}

std::vector<std::string> sub_commands(const std::vector<std::string>& lines) {
  std::vector<std::string> names;
  bool inside = false;
  for (const std::string& line : lines) {
    inside = inside || line.starts_with("Subcommands");
    if (inside && is_name(line)) {
      EXPECT_NE(line.find("  ", 2), std::string::npos) << line;
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

void expect_explained(const std::string& arguments) {
  const auto lines = help_of(arguments);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_option(lines[i])) {
      EXPECT_TRUE(is_explained(lines, i)) << "poolhall " << arguments << ": " << lines[i];
    }
  }
  for (const std::string& name : sub_commands(lines)) {
    expect_explained(arguments.empty() ? name : arguments + " " + name);
  }
}

TEST(Help, ExplainsEverySubCommandAndEveryOption) {
  EXPECT_GT(sub_commands(help_of("")).size(), 10U);
  expect_explained("");
}

// What the command line itself refuses is wrong input like any other.
TEST(Usage, ThatIsWrongEndsWithTheCodeOfWrongInput) {
  const std::string program = POOLHALL_PROGRAM;
  for (const char* arguments : {"", "frobnicate", "serve --frobnicate", "bench", "simulate"}) {
    const test_support::Ran ran = test_support::run_command(program + " " + arguments, "");
    EXPECT_EQ(ran.exit_code, 2) << arguments;
    EXPECT_NE(ran.err, "") << arguments;
  }
  EXPECT_EQ(test_support::run_command(program + " --version", "").exit_code, 0);
}

// It would forfeit every game.
TEST(Usage, ABotThatDoesNotExistIsRefusedBeforeItsTournament) {
  const test_support::TemporaryDirectory folder;
  const std::string file = (folder / "cup.toml").string();
  std::ofstream(file)
      << "name = \"cup\"\n[[entry]]\nhouse = \"randm\"\n[[entry]]\nhouse = \"greedy\"\n";
  const test_support::Ran ran =
      test_support::run_command(std::string(POOLHALL_PROGRAM) + " tournament run " + file +
                                    " --db " + (folder / "cup.db").string(),
                                "");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find(file + ": entry \"randm\": got house = \"randm\", expected one of"),
            std::string::npos)
      << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "cup.db"));
}

}  // namespace
}  // namespace poolhall::app
