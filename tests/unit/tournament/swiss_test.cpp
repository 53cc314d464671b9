// Single rules of the Swiss system, and its export.
#include <gmock/gmock.h>

#include <algorithm>

#include "server/tournament/format.hpp"
#include "server/tournament/swiss_pairing.hpp"
#include "server/tournament/trf.hpp"

namespace poolhall::tournament {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr auto first = BreakSide::first;
constexpr auto second = BreakSide::second;

SwissRound game(std::size_t opponent, BreakSide side, int half_points) {
  return {RoundKind::played, entry_id(opponent - 1), side, half_points};
}

// Entries by their numbers from 1.
SwissEntry entry(std::uint32_t number, std::vector<SwissRound> rounds) {
  return {entry_id(number - 1), number, std::move(rounds)};
}

SwissPairings pair(const std::vector<SwissEntry>& entries, const std::vector<std::uint32_t>& here,
                   std::uint32_t rounds) {
  std::vector<SwissPlayer> players;
  for (const std::uint32_t number : here) {
    players.push_back(swiss_player(entries[number - 1], entries));
  }
  return pair_swiss_round(players, {.rounds = rounds});
}

SwissPair meets(std::size_t breaks, std::size_t other) {
  return {entry_id(breaks - 1), entry_id(other - 1)};
}

TEST(Swiss, TheFirstRoundPairsTheUpperHalfWithTheLowerAndAlternatesTheBreak) {
  std::vector<SwissEntry> entries;
  for (std::uint32_t number = 1; number <= 7; ++number) {
    entries.push_back(entry(number, {}));
  }
  const SwissPairings round = pair(entries, {1, 2, 3, 4, 5, 6, 7}, 4);
  EXPECT_THAT(round.pairs, UnorderedElementsAre(meets(1, 4), meets(5, 2), meets(3, 6)));
  EXPECT_EQ(round.bye, entry_id(6));
}

// C5 before the pairs of the brackets: the bye goes to the lowest score that can have it.
TEST(Swiss, TheByeGoesToTheLowestScoreEvenIfAHigherBracketThenPairsWorse) {
  const std::vector<SwissEntry> entries{entry(1, {game(4, first, 2), game(2, second, 2)}),
                                        entry(2, {game(5, second, 2), game(1, first, 0)}),
                                        entry(3, {game(6, first, 2), game(4, second, 2)}),
                                        entry(4, {game(1, second, 0), game(3, first, 0)}),
                                        entry(5, {game(2, first, 0), game(6, second, 2)}),
                                        entry(6, {game(3, second, 0), game(5, first, 0)})};
  const SwissPairings round = pair(entries, {1, 2, 3, 5, 6}, 3);
  EXPECT_THAT(round.pairs, UnorderedElementsAre(meets(1, 5), meets(3, 2)));
  EXPECT_EQ(round.bye, entry_id(5));
}

TEST(Swiss, OfThoseWithTheSameScoreTheByeGoesToTheOneWhoHasPlayedMost) {
  const std::vector<SwissEntry> entries{
      entry(1, {game(3, first, 2)}), entry(2, {game(4, second, 2)}), entry(3, {game(1, second, 0)}),
      entry(4, {game(2, first, 0)}), entry(5, {SwissRound{}})};
  const SwissPairings round = pair(entries, {1, 2, 3, 4, 5}, 3);
  EXPECT_THAT(round.pairs, UnorderedElementsAre(meets(2, 1), meets(3, 5)));
  EXPECT_EQ(round.bye, entry_id(3));
}

TEST(Swiss, TheLastTwoMeetAgainWhenTheyHaveMet) {
  const SwissRound bye{RoundKind::bye, {}, {}, 2};
  const std::vector<SwissEntry> entries{entry(1, {game(2, first, 2), bye, game(3, second, 2)}),
                                        entry(2, {game(1, second, 0), game(3, first, 2), bye}),
                                        entry(3, {bye, game(2, second, 0), game(1, first, 0)})};
  const SwissPairings two = pair(entries, {1, 2}, 5);
  EXPECT_EQ(two.pairs.size(), 1U);
  EXPECT_FALSE(two.bye);
}

TEST(Swiss, AnAbsolutePreferenceIsGrantedBeforeAStrongOne) {
  const std::vector<SwissEntry> entries{
      entry(1, {game(3, first, 2)}), entry(2, {game(4, second, 2)}), entry(3, {game(1, second, 0)}),
      entry(4, {game(2, first, 0)})};
  SwissPlayer one = swiss_player(entry(1, {game(3, first, 2), game(4, first, 2)}), entries);
  SwissPlayer two = swiss_player(entry(2, {game(4, first, 2)}), entries);
  EXPECT_EQ(one.strength, Strength::absolute);
  EXPECT_EQ(two.strength, Strength::strong);
  EXPECT_EQ(allocated_side(two, one, first), first);
  EXPECT_EQ(allocated_side(one, two, first), second);
}

TEST(Trf, WritesTheColumnsOfFidesFormat) {
  Happened happened;
  FormatSettings format;
  format.kind = FormatKind::swiss;
  format.rounds = 2;
  const std::vector<EntrySpan> field(3);
  const Schedule drawn = schedule(format, field, happened);
  ASSERT_EQ(drawn.pairings.size(), 1U);
  happened.results[0] = {{{0, 1, true}, {1, 0.5, true}}};
  const Schedule now = schedule(format, field, happened);
  const std::string text =
      trf16({"cup", 2}, {"anna", "bert", "carl"}, now,
            standings(3, {}, table_rules(format, now, happened, {TieBreak::wins})));
  EXPECT_THAT(text, HasSubstr("012 cup\n"));
  EXPECT_THAT(text, HasSubstr("XXR 2\nXXC white1\n"));
  const std::string anna =
      "001    1      anna                                                               1.0    1"
      "     2 w 1\n";
  EXPECT_THAT(text, HasSubstr(anna));
  EXPECT_EQ(anna.size(), 100U);  // 99 columns: the result stands in the last
  EXPECT_THAT(text, HasSubstr("  0000 - U\n"));
}

TEST(Trf, RanksAreThoseOfTheStandings) {
  FormatSettings format;
  format.kind = FormatKind::swiss;
  format.rounds = 1;
  const std::vector<EntrySpan> field(4);
  Happened happened;
  const Schedule drawn = schedule(format, field, happened);
  std::vector<PlayedGame> games;
  for (const Pairing& pairing : drawn.pairings) {
    const bool drew = pairing.number == 0;  // one game each; else the first one won two
    happened.results[pairing.number] = {{{0, 1, true}, {1, drew ? 0.0 : 1.0, true}}};
    for (std::uint32_t number = 0; number < 2; ++number) {
      PlayedGame game{pairing.number, number, pairing.first, pairing.second};
      game.winner = drew && number == 1 ? pairing.second : pairing.first;
      games.push_back(game);
    }
  }
  const Schedule now = schedule(format, field, happened);
  const Standings table = standings(4, games, table_rules(format, now, happened, {TieBreak::wins}));
  const Names names{"anna", "bert", "carl", "dora"};
  const std::string text = trf16({"cup", 1}, names, now, table);
  const std::vector<std::string> ranks{"   1", "   2", "   2", "   4"};
  for (std::size_t place = 0; place < 4; ++place) {
    const std::size_t line =
        text.find("001    " + std::to_string(index(table.rows[place].entry) + 1));
    ASSERT_NE(line, std::string::npos);
    EXPECT_EQ(text.substr(line + 85, 4), ranks[place]) << text;  // columns 86-89
  }
}

}  // namespace
}  // namespace poolhall::tournament
