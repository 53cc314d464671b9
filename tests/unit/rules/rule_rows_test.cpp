// One test a row of the clause table.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "rule_rows.hpp"

namespace poolhall::rules::test {
namespace {

class RuleRow : public testing::TestWithParam<Row> {};

TEST_P(RuleRow, IsJudgedAsWritten) {
  EXPECT_EQ(outcome(GetParam()), GetParam().expected);
}

std::string test_name(const testing::TestParamInfo<Row>& info) {
  std::string name;
  for (const char c : info.param.name) {
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(EightBall, RuleRow, testing::ValuesIn(eight_ball_rows()), test_name);
INSTANTIATE_TEST_SUITE_P(NineBall, RuleRow, testing::ValuesIn(nine_ball_rows()), test_name);

TEST(RuleRows, AreAtLeast120AndAllDifferent) {
  std::set<std::string> seen;
  for (const Row& row : all_rows()) {
    EXPECT_TRUE(seen.insert(row.state + " | " + row.action).second) << row.name;
  }
  EXPECT_GE(seen.size(), 120U);
}

}  // namespace
}  // namespace poolhall::rules::test
