// A tournament of eight house bots, killed (SIGKILL) in the middle and started again: the schedule
// is the same, and the stored games stand up to `poolhall verify`.
#include <gmock/gmock.h>

#include <signal.h>

#include <fstream>
#include <map>
#include <string>

#include "../../integration/tournament/program.hpp"
#include "server/ledger/stored_tournament.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::tournament {
namespace {

std::string eight_bots(const std::string& format) {
  std::string text = "name = \"cup\"\nformat = \"" + format +
                     "\"\ngames_per_match = 1\nmirrored = \"none\"\n"
                     "max_concurrent_games = 4\nseed = 11\n[clock]\ngame_seconds = 3600\n";
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"}) {
    text += "[[entry]]\nname = \"" + std::string(name) + "\"\nhouse = \"random\"\n";
  }
  return text;
}

struct Planned {
  std::array<storage::AgentId, 2> agents{};
  std::uint64_t seed = 0;

  friend bool operator==(const Planned&, const Planned&) = default;
};

std::map<std::uint32_t, Planned> stored_matches(const std::filesystem::path& database) {
  auto reader = storage::open_sqlite_reader(database).value();
  std::map<std::uint32_t, Planned> planned;
  const auto matches = reader->matches_of("cup");
  EXPECT_TRUE(matches);
  for (const storage::MatchRecord& match : *matches) {
    planned[match.pairing.value()] = {match.agents, match.seed};
  }
  return planned;
}

// Every stored match is the one that the schedule has of this number, and the other way round.
void expect_schedule_of(const std::filesystem::path& database) {
  auto reader = storage::open_sqlite_reader(database).value();
  const auto stored = ledger::stored_tournament(*reader, "cup");
  ASSERT_TRUE(stored && *stored);
  const ledger::TournamentBook& book = (*stored)->book;
  EXPECT_TRUE(book.schedule().is_complete);
  const auto matches = stored_matches(database);
  EXPECT_EQ(matches.size(), book.schedule().pairings.size());
  const Names names = book.names();
  for (const auto& [number, planned] : matches) {
    const Pairing* pairing = book.pairing(number);
    ASSERT_NE(pairing, nullptr) << number;
    const std::array<EntryId, 2> players{pairing->first, pairing->second};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto agent = reader->agent(planned.agents[i]);
      ASSERT_TRUE(agent && *agent);
      EXPECT_EQ((*agent)->name, names[index(players[i])]) << "match " << number;
    }
  }
}

class Killed : public testing::TestWithParam<const char*> {};

TEST_P(Killed, GoesOnWithTheSameScheduleAndItsGamesAreVerified) {
  const test_support::TemporaryDirectory directory;
  std::ofstream(directory / "cup.toml") << eight_bots(GetParam());
  const std::vector<std::string> run{"tournament", "run", "cup.toml", "--db", "cup.db"};
  {
    Program program(directory.path(), run);
    std::size_t results = 0;
    while (const auto line = program.next_line()) {
      results += line->find(" beat ") != std::string::npos ? 1U : 0U;
      if (results == 3) {
        break;
      }
    }
    program.signal(SIGKILL);
    EXPECT_EQ(program.wait(), -1);
  }
  const auto before = stored_matches(directory / "cup.db");
  EXPECT_GE(before.size(), 3U);
  Program again(directory.path(), run);
  const std::string output = again.rest();
  EXPECT_EQ(again.wait(), 0) << output;
  const auto after = stored_matches(directory / "cup.db");
  for (const auto& [number, planned] : before) {
    EXPECT_EQ(after.at(number), planned) << "match " << number;
  }
  expect_schedule_of(directory / "cup.db");
  Program verify(directory.path(), {"verify", "--db", "cup.db"});
  const std::string verdict = verify.rest();
  EXPECT_EQ(verify.wait(), 0) << verdict;
  Program table(directory.path(), {"tournament", "standings", "cup", "--db", "cup.db"});
  const std::string standings = table.rest();
  EXPECT_EQ(table.wait(), 0) << standings;
  // The same table as at the end of the run.
  EXPECT_THAT(output, testing::HasSubstr(standings.substr(0, standings.find("Games ended"))));
}

INSTANTIATE_TEST_SUITE_P(Formats, Killed,
                         testing::Values("round_robin", "swiss", "double_elimination"));

}  // namespace
}  // namespace poolhall::tournament
