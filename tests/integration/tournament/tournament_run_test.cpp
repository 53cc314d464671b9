// `poolhall tournament run` with real processes, sockets and a real database file.
#include <gmock/gmock.h>

#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "program.hpp"
#include "server/ledger/check.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::tournament {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string two_random_bots =
    "name = \"cup\"\ngames_per_match = 4\nseed = 3\n"
    "[clock]\ngame_seconds = 60\n"
    "[[entry]]\nname = \"one\"\nhouse = \"random\"\noptions = {seed = 1}\n"
    "[[entry]]\nname = \"two\"\nhouse = \"random\"\noptions = {seed = 2}\n";

class TournamentRun : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    std::ofstream(directory_ / file) << text;
  }
  [[nodiscard]] Program run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{"tournament", "run"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return Program(directory_.path(), words);
  }

  test_support::TemporaryDirectory directory_;
};

// Lines that tell a game's result: "one beat two (eight pocketed)".
std::size_t results(const std::string& output) {
  std::size_t count = 0;
  for (const std::string word : {" beat ", " drew "}) {
    for (auto at = output.find(word); at != std::string::npos; at = output.find(word, at + 1)) {
      ++count;
    }
  }
  return count;
}

TEST_F(TournamentRun, PlaysToTheEndAndShowsTableEndingsAndWhereTheGamesAre) {
  write("cup.toml", two_random_bots);
  Program program = run({"cup.toml"});
  const std::string output = program.rest();
  EXPECT_EQ(program.wait(), 0) << output;
  EXPECT_THAT(output, StartsWith("Tournament cup: 8-ball, 2 entries, 1 matches of 4 games"));
  EXPECT_EQ(results(output), 4u) << output;
  EXPECT_THAT(output, HasSubstr("] 4/4 games, 0 running"));
  EXPECT_THAT(output, HasSubstr("#  Entry  Points  Games  W  L  D"));
  EXPECT_THAT(output, HasSubstr("Games ended: "));
  EXPECT_THAT(output, HasSubstr("\nGames are stored in cup.db.\n"));
  EXPECT_EQ(output.find('\x1b'), std::string::npos) << "no control characters into a pipe";
  EXPECT_TRUE(std::filesystem::exists(directory_ / "cup.db"));
}

TEST_F(TournamentRun, KilledAndStartedAgainItGoesOnToTheEnd) {
  write("cup.toml", two_random_bots);
  {
    Program program = run({"cup.toml", "--db", "games.db"});
    while (const auto line = program.next_line()) {
      if (results(*line) > 0) {
        break;
      }
    }
    program.signal(SIGKILL);
    program.wait();
  }
  Program again = run({"cup.toml", "--db", "games.db"});
  const std::string output = again.rest();
  EXPECT_EQ(again.wait(), 0) << output;
  EXPECT_EQ(results(output), 4u) << output;

  Program over = run({"cup.toml", "--db", "games.db"});
  const std::string table = over.rest();
  EXPECT_EQ(over.wait(), 0);
  const auto final_of = [](const std::string& text) { return text.substr(text.rfind("\n#  ")); };
  EXPECT_EQ(final_of(table), final_of(output)) << "a finished tournament shows its table again";
}

TEST_F(TournamentRun, AChangeInWhatIsStoredBesideItsGamesIsFound) {
  write("cup.toml", two_random_bots);
  Program program = run({"cup.toml"});
  const std::string output = program.rest();
  ASSERT_EQ(program.wait(), 0) << output;
  const auto differences = [this] {
    const auto reader = storage::open_sqlite_reader(directory_ / "cup.db").value();
    return ledger::check_tournaments(*reader).value();
  };
  EXPECT_THAT(differences(), testing::IsEmpty());
  struct Change {
    std::string made;
    std::string undone;
    std::string found;
  };
  for (const Change& change : std::vector<Change>{
           {"UPDATE final_standings SET points = points + 1 WHERE place = 0",
            "UPDATE final_standings SET points = points - 1 WHERE place = 0", "row 1"},
           {"UPDATE agents SET name = 'twp' WHERE name = 'two'",
            "UPDATE agents SET name = 'two' WHERE name = 'twp'", "pairing 0: stored one"},
           {"UPDATE entries SET until_round = 0 WHERE place = 0",
            "UPDATE entries SET until_round = NULL WHERE place = 0", "not in the schedule"},
           {"UPDATE tournaments SET settings = replace(settings, '\"two\"', '\"twp\"')",
            "UPDATE tournaments SET settings = replace(settings, '\"twp\"', '\"two\"')",
            "pairing 0: stored one"},
           {"UPDATE matches SET pairing = 1", "UPDATE matches SET pairing = 0",
            "pairing 1 is not in the schedule"}}) {
    test_support::RawSqlite(directory_ / "cup.db").run(change.made);
    EXPECT_THAT(differences(), testing::ElementsAre(testing::AllOf(HasSubstr("tournament cup: "),
                                                                   HasSubstr(change.found))))
        << change.made;
    test_support::RawSqlite(directory_ / "cup.db").run(change.undone);
    EXPECT_THAT(differences(), testing::IsEmpty()) << change.undone;
  }
}

TEST_F(TournamentRun, InterruptedItSaysHowToGoOn) {
  write("cup.toml", two_random_bots);
  Program program = run({"cup.toml"});
  while (const auto line = program.next_line()) {
    if (results(*line) > 0) {
      break;
    }
  }
  program.signal(SIGTERM);
  const std::string output = program.rest();
  EXPECT_EQ(program.wait(), 3) << output;
  EXPECT_THAT(output, HasSubstr("The same command with --db cup.db goes on from here."));
}

TEST_F(TournamentRun, AnotherTournamentOfTheSameNameInTheDatabaseIsRefused) {
  write("cup.toml", two_random_bots);
  Program first = run({"cup.toml", "--db", "games.db"});
  static_cast<void>(first.next_line());
  static_cast<void>(first.next_line());
  first.signal(SIGTERM);
  static_cast<void>(first.rest());
  first.wait();
  write("cup.toml", "noise = \"none\"\n" + two_random_bots);
  Program second = run({"cup.toml", "--db", "games.db"});
  const std::string output = second.rest();
  EXPECT_EQ(second.wait(), 1) << output;
  EXPECT_THAT(output, HasSubstr("has a tournament \"cup\" with other settings"));
}

TEST_F(TournamentRun, AWrongKeyStopsItWithFileLineAndWhatWasExpected) {
  write("cup.toml", "nam = \"cup\"\n" + two_random_bots);
  Program program = run({"cup.toml"});
  const std::string output = program.rest();
  EXPECT_EQ(program.wait(), 2);
  EXPECT_EQ(output, "poolhall: cup.toml:1:1: unknown key \"nam\"; did you mean \"name\"?\n");
}

TEST_F(TournamentRun, AnAddressBeyondThisMachineNeedsAYes) {
  write("cup.toml", two_random_bots);
  Program program = run({"cup.toml", "--listen", "0.0.0.0:0"});
  const std::string output = program.rest();
  EXPECT_EQ(program.wait(), 2);
  EXPECT_THAT(output, HasSubstr("--plain-beyond-loopback"));
}

}  // namespace
}  // namespace poolhall::tournament
