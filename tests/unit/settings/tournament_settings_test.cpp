#include "server/settings/tournament_settings.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>

namespace poolhall::settings {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string two_entries = "[[entry]]\nhouse = \"greedy\"\n[[entry]]\nhouse = \"random\"\n";

std::string tournament_refusal(const std::string& source) {
  const auto settings = parse_tournament(source, "t.toml");
  return settings ? "accepted" : text(settings.error());
}

TEST(TournamentSettings, NameAndEntriesAreEnough) {
  const auto settings = parse_tournament("name = \"cup\"\n" + two_entries, "t.toml");
  ASSERT_TRUE(settings) << text(settings.error());
  EXPECT_EQ(settings->name, "cup");
  EXPECT_EQ(settings->rules, rules::RuleSet::eight_ball);
  EXPECT_EQ(settings->clock.game, std::chrono::seconds{600});
  EXPECT_FALSE(settings->clock.shot_cap);
  ASSERT_EQ(settings->entries.size(), 2u);
  EXPECT_EQ(settings->entries[0].name, "greedy");
  EXPECT_EQ(std::get<HouseEntry>(settings->entries[1].player).bot, "random");
}

TEST(TournamentSettings, EveryKeyReachesItsMemberInUnitsOfTheProgram) {
  const auto settings = parse_tournament(
      "name = \"cup\"\nrules = \"9-ball\"\ngames_per_match = 3\nmirrored = \"none\"\n"
      "noise = \"high\"\nrack_gap_mm = 0.1\nmax_concurrent_games = 7\n"
      "max_concurrent_games_per_entry = 2\nseed = 9007199254740991\ntie_breaks = [\"wins\"]\n"
      "[clock]\ngame_seconds = 90\nincrement_seconds = 0.5\nshot_cap_seconds = 20\n" +
          two_entries,
      "t.toml");
  ASSERT_TRUE(settings) << text(settings.error());
  EXPECT_EQ(settings->rules, rules::RuleSet::nine_ball);
  EXPECT_EQ(settings->games_per_match, 3u);
  EXPECT_EQ(settings->mirrored, MirroredGames::none);
  EXPECT_EQ(settings->noise, "high");
  EXPECT_DOUBLE_EQ(settings->rack_gap, 1e-4);
  EXPECT_EQ(settings->max_concurrent_games, 7u);
  EXPECT_EQ(settings->max_concurrent_games_per_entry, 2u);
  EXPECT_EQ(settings->seed, 9007199254740991u);
  EXPECT_THAT(settings->tie_breaks, ElementsAre("wins"));
  EXPECT_EQ(settings->clock.game, std::chrono::seconds{90});
  EXPECT_EQ(settings->clock.increment, std::chrono::milliseconds{500});
  EXPECT_EQ(settings->clock.shot_cap, std::chrono::seconds{20});
}

TEST(TournamentSettings, AnEntryIsAHouseBotACommandOrAnAgent) {
  const auto settings = parse_tournament(
      "name = \"cup\"\n"
      "[[entry]]\nname = \"light\"\nhouse = \"greedy\"\n"
      "options = {samples = 4, seed = 7, fast = true, mode = \"a b\", share = 0.5}\n"
      "[[entry]]\nname = \"mine\"\ncommand = \"exec ./mine --hard\"\n"
      "[[entry]]\nagent = \"Anna\"\n",
      "t.toml");
  ASSERT_TRUE(settings) << text(settings.error());
  EXPECT_EQ(settings->entries[0].name, "light");
  EXPECT_THAT(
      std::get<HouseEntry>(settings->entries[0].player).options,
      ElementsAre("--samples", "4", "--seed", "7", "--fast", "--mode", "a b", "--share", "0.5"));
  EXPECT_EQ(std::get<CommandEntry>(settings->entries[1].player).command, "exec ./mine --hard");
  EXPECT_EQ(settings->entries[2].name, "Anna");
  EXPECT_TRUE(std::holds_alternative<AgentEntry>(settings->entries[2].player));
}

TEST(TournamentSettings, AnEntryWithoutOrWithTwoPlayersIsRefusedAtItsLine) {
  const std::string start = "name = \"cup\"\n" + two_entries + "[[entry]]\n";
  EXPECT_EQ(tournament_refusal(start + "name = \"x\"\n"),
            "t.toml:6:1: entry: 0 of house, command and agent came, expected exactly one");
  EXPECT_THAT(tournament_refusal(start + "house = \"greedy\"\nagent = \"Anna\"\n"),
              HasSubstr("2 of house, command and agent came"));
  EXPECT_THAT(tournament_refusal(start + "command = \"x\"\n"),
              HasSubstr("no name came with command"));
  EXPECT_THAT(tournament_refusal(start + "agent = \"A\"\noptions = {a = 1}\n"),
              HasSubstr("options came without house"));
  EXPECT_THAT(tournament_refusal(start + "agent = \"A\"\nname = \"B\"\n"),
              HasSubstr("name came with agent"));
}

TEST(TournamentSettings, TwoEntriesOfOneNameAreRefused) {
  EXPECT_EQ(
      tournament_refusal("name = \"cup\"\n" + two_entries + "[[entry]]\nhouse = \"greedy\"\n"),
      "t.toml:6:1: entry: the name \"greedy\" came twice (letters' case does not count), expected "
      "a name of its own for every entry");
  EXPECT_THAT(
      tournament_refusal("name = \"cup\"\n" + two_entries + "[[entry]]\nagent = \"GREEDY\"\n"),
      HasSubstr("\"GREEDY\" came twice"))
      << "agents' names differ by more than that";
}

TEST(TournamentSettings, ATournamentNeedsAtLeastTwoEntries) {
  EXPECT_THAT(tournament_refusal("name = \"cup\"\n"),
              HasSubstr("entry: none came, expected 2 to 256"));
  EXPECT_THAT(tournament_refusal("name = \"cup\"\n[[entry]]\nhouse = \"greedy\"\n"),
              HasSubstr("entry: 1 came, expected 2 to 256"));
  EXPECT_THAT(tournament_refusal("name = \"cup\"\nentry = [1, 2]\n"),
              HasSubstr("the whole number 1 came, expected [[entry]] tables"));
  EXPECT_THAT(tournament_refusal("name = \"cup\"\nentry = 3\n"), HasSubstr("entry: none came"));
}

TEST(TournamentSettings, ATournamentNeedsAName) {
  EXPECT_THAT(tournament_refusal(two_entries), HasSubstr("name: nothing came, expected a name"));
}

TEST(TournamentSettings, MirroredGamesComeInPairs) {
  EXPECT_EQ(tournament_refusal("name = \"cup\"\ngames_per_match = 3\n" + two_entries),
            "t.toml:2:19: games_per_match: 3 came, expected an even number, since mirrored = "
            "\"rack\" plays every rack twice");
}

TEST(TournamentSettings, UnknownKeysOfAnEntryAreRefusedWithTheNearestName) {
  EXPECT_EQ(tournament_refusal(
                "name = \"cup\"\n[[entry]]\nhose = \"greedy\"\n[[entry]]\nhouse = \"b\"\n"),
            "t.toml:3:1: unknown key \"hose\"; did you mean \"house\"?");
  EXPECT_THAT(tournament_refusal("name = \"cup\"\ngames = 4\n" + two_entries),
              StartsWith("t.toml:2:1: unknown key \"games\"; did you mean \"games_per_match\"?"));
}

TEST(TournamentSettings, WrongValuesAreRefused) {
  for (const char* line : {"format = \"knockout\"",
                           "rules = \"snooker\"",
                           "games_per_match = 0",
                           "mirrored = true",
                           "noise = \"some\"",
                           "table = \"no such table\"",
                           "physics = 1",
                           "rack_gap_mm = -0.1",
                           "rack_gap_mm = nan",
                           "max_concurrent_games = 0",
                           "seed = -1",
                           "seed = 9007199254740992",
                           "tie_breaks = [\"wins\", \"wins\"]",
                           "tie_breaks = \"wins\"",
                           "tie_breaks = [\"median\"]",
                           "rounds = -1",
                           "pace = \"fast\"",
                           "gauntlet_runners = 0",
                           "sprt.alpha = 0.5",
                           "clock.game_seconds = 0",
                           "clock.shot_cap_seconds = 0"}) {
    EXPECT_THAT(tournament_refusal("name = \"cup\"\n" + std::string(line) + "\n" + two_entries),
                HasSubstr("came, expected"))
        << line;
  }
}

TEST(TournamentSettings, AFormatSaysWhatItAsksOfRoundsAndEntries) {
  EXPECT_THAT(tournament_refusal("name = \"cup\"\nformat = \"swiss\"\nrounds = 3\n" + two_entries),
              HasSubstr("rounds: 3 came, expected at most 2"));
  EXPECT_EQ(tournament_refusal("name = \"cup\"\nformat = \"swiss\"\nrounds = 2\n" + two_entries),
            "accepted");
  EXPECT_THAT(tournament_refusal("name = \"cup\"\nformat = \"gauntlet\"\ngauntlet_runners = 2\n" +
                                 two_entries),
              HasSubstr("gauntlet_runners: 2 came, expected fewer"));
  const std::string sprt = "name = \"cup\"\nformat = \"sprt\"\n";
  EXPECT_THAT(tournament_refusal(sprt + two_entries), HasSubstr("rounds: 0 came"));
  EXPECT_THAT(tournament_refusal(sprt + "rounds = 9\nsprt.elo0 = 40\n" + two_entries),
              HasSubstr("sprt.elo1: 30 came, expected more than sprt.elo0 = 40"));
  EXPECT_THAT(
      tournament_refusal(sprt + "rounds = 9\n" + two_entries + "[[entry]]\nagent = \"Anna\"\n"),
      HasSubstr("entry: 3 came, expected 2"));
  EXPECT_THAT(tournament_refusal(sprt + "rounds = 9\nmirrored = \"none\"\ngames_per_match = 3\n" +
                                 two_entries),
              HasSubstr("games_per_match: 3 came, expected an even number: an SPRT"));
  EXPECT_EQ(tournament_refusal(sprt + "rounds = 9\n" + two_entries), "accepted");
}

TEST(TournamentSettings, WordsStandForWhatIsMirroredAndUntilWhenAgentsMayEnter) {
  const auto with = [](const std::string& line) {
    return parse_tournament("name = \"cup\"\n" + line + "\n" + two_entries, "t.toml").value();
  };
  EXPECT_EQ(with("mirrored = \"rack\"").mirrored, MirroredGames::rack);
  EXPECT_EQ(with("mirrored = \"noise\"").mirrored, MirroredGames::noise);
  EXPECT_EQ(with("mirrored = \"none\"").mirrored, MirroredGames::none);
  EXPECT_EQ(with("join = \"never\"").join, Joining::never);
  EXPECT_EQ(with("join = \"start\"").join, Joining::start);
  EXPECT_EQ(with("join = \"late\"").join, Joining::late);
}

TEST(TournamentSettings, AFileOfMoreThanAMebibyteIsNotRead) {
  const std::string file = testing::TempDir() + "/too_long.toml";
  std::ofstream(file) << "name = \"cup\"\n" << two_entries << std::string(1 << 20, '\n');
  const auto settings = load_tournament(file);
  std::remove(file.c_str());
  ASSERT_FALSE(settings);
  EXPECT_THAT(text(settings.error()), HasSubstr("longer than 1048576 bytes"));
}

TEST(TournamentSettings, OptionsThatAreNoWordsOfACommandLineAreRefused) {
  for (const char* options : {"{\"--x\" = 1}", "{x = [1]}", "{x = false}", "{X = 1}", "[1]"}) {
    EXPECT_THAT(tournament_refusal("name = \"cup\"\n[[entry]]\nhouse = \"greedy\"\noptions = " +
                                   std::string(options) + "\n[[entry]]\nhouse = \"random\"\n"),
                HasSubstr("a table of the bot's options"))
        << options;
  }
}

}  // namespace
}  // namespace poolhall::settings
