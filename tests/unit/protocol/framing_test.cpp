#include "protocol/framing.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace poolhall::protocol {
namespace {

using Kind = LineSplitter::Kind;

// What came out of a splitter, in order: the lines, and "!" for one that was too long.
std::vector<std::string> fed(LineSplitter& splitter, std::string_view chunk) {
  std::vector<std::string> out;
  while (!chunk.empty()) {
    const LineSplitter::Step step = splitter.next(chunk);
    chunk = step.rest;
    if (step.kind == Kind::line) {
      out.emplace_back(step.line);
    } else if (step.kind == Kind::too_long) {
      out.emplace_back("!");
    }
  }
  return out;
}

using Lines = std::vector<std::string>;

TEST(LineSplitter, TakesSeveralLinesOutOfOneChunk) {
  LineSplitter splitter(10);
  EXPECT_EQ(fed(splitter, "one\ntwo\nthr"), (Lines{"one", "two"}));
  EXPECT_TRUE(splitter.inside_line());
  EXPECT_EQ(fed(splitter, "ee\n"), Lines{"three"});
  EXPECT_FALSE(splitter.inside_line());
}

TEST(LineSplitter, PutsALineTogetherFromSingleBytes) {
  LineSplitter splitter(10);
  Lines lines;
  for (const char c : std::string("ab\r\n\ncd\n")) {
    for (std::string& line : fed(splitter, std::string_view(&c, 1))) {
      lines.push_back(std::move(line));
    }
  }
  EXPECT_EQ(lines, (Lines{"ab", "", "cd"}));
}

TEST(LineSplitter, TakesCarriageReturnsOffTheEndOnly) {
  LineSplitter splitter(10);
  EXPECT_EQ(fed(splitter, "a\rb\r\nc\r\r\n"), (Lines{"a\rb", "c\r"}));
}

TEST(LineSplitter, TakesALineOfExactlyTheLimit) {
  LineSplitter splitter(4);
  EXPECT_EQ(fed(splitter, "1234\n1234\r\n"), (Lines{"1234", "1234"}));
  EXPECT_EQ(fed(splitter, "1234\r"), Lines{});
  EXPECT_EQ(fed(splitter, "\n"), Lines{"1234"});
}

TEST(LineSplitter, SaysOnceThatALineIsTooLongAndGoesOnAfterIt) {
  LineSplitter splitter(4);
  EXPECT_EQ(fed(splitter, "12345\nok\n"), (Lines{"!", "ok"}));
  EXPECT_EQ(fed(splitter, "123"), Lines{});
  EXPECT_EQ(fed(splitter, "456"), Lines{"!"});
  EXPECT_EQ(fed(splitter, "789"), Lines{});
  EXPECT_TRUE(splitter.inside_line());
  EXPECT_EQ(fed(splitter, "0\nok\n"), Lines{"ok"});
}

TEST(LineSplitter, RefusesALineThatIsOneByteTooLongHoweverItComes) {
  LineSplitter whole(4);
  EXPECT_EQ(fed(whole, "12345\n"), Lines{"!"});
  LineSplitter halves(4);
  EXPECT_EQ(fed(halves, "12345"), Lines{});  // the fifth byte could have been "\r"
  EXPECT_EQ(fed(halves, "\nok\n"), (Lines{"!", "ok"}));
}

TEST(LineSplitter, UsesANewLimitForTheNextBytes) {
  LineSplitter splitter(2);
  splitter.set_limit(5);
  EXPECT_EQ(fed(splitter, "12345\n"), Lines{"12345"});
}

}  // namespace
}  // namespace poolhall::protocol
