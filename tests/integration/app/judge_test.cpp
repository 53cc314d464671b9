// `poolhall judge` as a program: what it prints, where, and with which exit code.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "protocol/json_value.hpp"
#include "tests/support/run_command.hpp"

namespace poolhall {
namespace {

using test_support::Ran;

// Runs it with that document, of the fuzzer's corpus, as its standard input.
Ran judge(const std::string& document, const std::string& arguments = "-") {
  return test_support::run_command(
      std::string(POOLHALL_PROGRAM) + " judge " + arguments,
      test_support::bytes_of(POOLHALL_SOURCE_DIR "/tests/fuzz/corpus/judge/" + document));
}

TEST(JudgeCommand, PrintsTheRulingAndTheNextState) {
  for (const char* document : {"shot", "events", "summary", "nine", "push_out", "off_table"}) {
    const Ran ran = judge(document);
    EXPECT_EQ(ran.exit_code, 0) << document << ran.err;
    EXPECT_EQ(ran.err, "") << document;
    const auto answer = protocol::parse_json(ran.out, {16, 1'000'000});
    ASSERT_TRUE(answer) << document;
    EXPECT_NE(answer->member("ruling"), nullptr) << document;
    EXPECT_NE(answer->member("state"), nullptr) << document;
    EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\n'), 1) << document;
  }
}

TEST(JudgeCommand, NamesTheFieldOfWrongInputInOneLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"17_balls", "-: /state/balls: "},         {"two_cue_balls", "-: /state/balls/1/id: "},
      {"overlap", "-: /state/balls/2/x: "},      {"down", "-: /call/ball: "},
      {"other_state", "-: /events/1/balls/1: "}, {"groups_unfit", "-: /state/groups: "},
      {"impossible_stroke", "-: /shot/theta: "}, {"unknown_key", "-: /x: "}};
  for (const auto& [document, start] : wrong) {
    const Ran ran = judge(document);
    EXPECT_EQ(ran.exit_code, 2) << document;
    EXPECT_EQ(ran.out, "") << document;
    EXPECT_TRUE(ran.err.starts_with(start)) << document << ": " << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << document;
  }
}

TEST(JudgeCommand, NamesAFileThatCannotBeRead) {
  const Ran ran = judge("shot", "/no/such/file.json");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_TRUE(ran.err.starts_with("/no/such/file.json: ")) << ran.err;
}

TEST(JudgeCommand, RefusesAFolder) {
  for (const char* arguments : {"/", "- < /"}) {
    const Ran ran = judge("shot", arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_NE(ran.err.find(": cannot be read, expected a JSON file or -\n"), std::string::npos)
        << ran.err;
  }
}

}  // namespace
}  // namespace poolhall
