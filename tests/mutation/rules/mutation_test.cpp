// Switches off and inverts every clause in turn and asks whether a row of the clause table
// notices. Built against the rules compiled with POOLHALL_CLAUSE_MUTATION, in which each decision
// asks this file.
#include <gtest/gtest.h>

#include <cstdio>
#include <exception>
#include <set>
#include <string>
#include <string_view>

#include "rule_rows.hpp"
#include "rules/clause.hpp"

namespace poolhall::rules {
namespace {

enum class Change { none, disabled, inverted };

// What is changed while a row is judged; the run is single-threaded.
struct Mutation {
  std::string_view clause;
  Change change = Change::none;
};
Mutation& mutation() {
  static Mutation current;
  return current;
}

}  // namespace

bool applies(const Clause& clause, bool fact) {
  if (clause.name != mutation().clause) {
    return fact;
  }
  switch (mutation().change) {
    case Change::disabled:
      return false;
    case Change::inverted:
      return !fact;
    case Change::none:
      break;
  }
  return fact;
}

namespace test {
namespace {

std::string guarded_outcome(const Row& row) {
  try {
    return outcome(row);
  } catch (const std::exception& thrown) {
    return thrown.what();
  }
}

struct Count {
  std::size_t rows = 0;
  std::string first;
};

Count rows_that_notice(const Mutation& change) {
  mutation() = change;
  Count count;
  for (const Row& row : all_rows()) {
    if (guarded_outcome(row) != row.expected) {
      count.first = count.rows++ == 0 ? row.name : count.first;
    }
  }
  mutation() = {};
  return count;
}

TEST(ClauseMutation, IsNoticedByARowForEveryClauseDisabledOrInverted) {
  std::printf("%-24s %-5s %9s %9s   %s\n", "clause", "rule", "disabled", "inverted",
              "first row that notices");
  for (const Clause* clause : all_clauses()) {
    const Count disabled = rows_that_notice({clause->name, Change::disabled});
    const Count inverted = rows_that_notice({clause->name, Change::inverted});
    std::printf("%-24s %-5s %9zu %9zu   %s\n", std::string(clause->name).c_str(),
                std::string(clause->rule).c_str(), disabled.rows, inverted.rows,
                disabled.first.c_str());
    EXPECT_GE(disabled.rows, 1U) << clause->name << " disabled";
    EXPECT_GE(inverted.rows, 1U) << clause->name << " inverted";
  }
}

TEST(ClauseMutation, LeavesTheRowsAloneWhenNothingIsChanged) {
  EXPECT_EQ(rows_that_notice({}).rows, 0U);
}

TEST(ClauseMutation, KnowsEveryClauseByADifferentName) {
  std::set<std::string_view> names;
  for (const Clause* clause : all_clauses()) {
    EXPECT_TRUE(names.insert(clause->name).second) << clause->name;
    EXPECT_FALSE(clause->rule.empty());
    EXPECT_FALSE(clause->text.empty());
  }
}

}  // namespace
}  // namespace test
}  // namespace poolhall::rules
