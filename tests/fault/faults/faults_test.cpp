// A small version of `poolhall bench faults`.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/fault/harness/bad_run.hpp"
#include "tests/fault/harness/kill_run.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::fault {
namespace {

template <class Report>
std::string text_of(const Report& report) {
  std::ostringstream text;
  print(report, text);
  return text.str();
}

TEST(BadClients, AreToldWhyAndLeaveGoodGamesBitForBitAsTheyAre) {
  const test_support::TemporaryDirectory directory;
  const BadReport report = run_bad_clients({.directory = directory.path(),
                                            .games = 2,
                                            .rounds = 1,
                                            .seed = 7,
                                            .longest_thought = std::chrono::milliseconds{15}});
  EXPECT_TRUE(report.sound()) << text_of(report);
}

TEST(KilledServer, LosesNothingPlaysNothingTwiceAndBringsEveryGameToItsEnd) {
  const test_support::TemporaryDirectory directory;
  const KillReport report = run_kills({.program = POOLHALL_PROGRAM,
                                       .directory = directory.path(),
                                       .kills = 5,
                                       .kills_a_failpoint = 1,
                                       .games = 4,
                                       .seed = 5});
  EXPECT_TRUE(report.sound()) << text_of(report);
  EXPECT_EQ(report.failpoint_kills.size(), 5U) << text_of(report);
}

}  // namespace
}  // namespace poolhall::fault
