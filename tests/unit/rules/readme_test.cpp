// rules/README.md says of every clause where it is and which rows test it; this holds it to that.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "rule_rows.hpp"
#include "rules/clause.hpp"

namespace poolhall::rules::test {
namespace {

std::string readme() {
  std::ifstream in(std::string(POOLHALL_SOURCE_DIR) + "/rules/README.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RulesReadme, NamesEveryClause) {
  const std::string text = readme();
  for (const Clause* clause : all_clauses()) {
    EXPECT_NE(text.find("`" + std::string(clause->name) + "`"), std::string::npos) << clause->name;
  }
}

TEST(RulesReadme, NamesRowsThatExist) {
  std::set<std::string> rows;
  for (const Row& row : all_rows()) {
    rows.insert(row.name);
  }
  const std::string text = readme();
  const std::regex table_row(R"(\n\|[^\n]*)");
  const std::regex quoted("\"([^\"]+)\"");
  std::size_t named = 0;
  for (std::sregex_iterator line(text.begin(), text.end(), table_row), end; line != end; ++line) {
    const std::string cells = line->str();
    for (std::sregex_iterator name(cells.begin(), cells.end(), quoted); name != end; ++name) {
      ++named;
      EXPECT_TRUE(rows.contains((*name)[1].str())) << (*name)[1].str();
    }
  }
  EXPECT_GT(named, 50U);
}

}  // namespace
}  // namespace poolhall::rules::test
