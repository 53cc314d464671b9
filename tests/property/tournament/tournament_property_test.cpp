#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "server/tournament/crosstable.hpp"
#include "server/tournament/director.hpp"
#include "server/tournament/round_robin.hpp"
#include "server/tournament/seeds.hpp"
#include "server/tournament/standings.hpp"

namespace poolhall::tournament {
namespace {

const std::vector<TieBreak> all_tie_breaks{TieBreak::direct_encounter, TieBreak::sonneborn_berger,
                                           TieBreak::wins};

TEST(RoundRobinProperty, EveryPairMeetsOnceAndNobodyTwiceInARound) {
  for (std::size_t entries = 2; entries <= 65; ++entries) {
    std::set<std::pair<EntryId, EntryId>> met;
    std::set<std::pair<std::uint32_t, EntryId>> busy;
    std::uint32_t number = 0;
    for (const Pairing& pairing : round_robin(entries)) {
      EXPECT_EQ(pairing.number, number++);
      EXPECT_LT(index(pairing.first), entries);
      EXPECT_LT(index(pairing.second), entries);
      EXPECT_TRUE(met.insert(std::minmax(pairing.first, pairing.second)).second);
      EXPECT_TRUE(busy.insert({pairing.round, pairing.first}).second);
      EXPECT_TRUE(busy.insert({pairing.round, pairing.second}).second);
      EXPECT_LT(pairing.round, entries - 1 + entries % 2);
    }
    EXPECT_EQ(met.size(), entries * (entries - 1) / 2) << entries;
  }
}

TEST(RoundRobinProperty, FirstBreaksDifferByAtMostOneForEveryEntry) {
  for (std::size_t entries = 2; entries <= 65; ++entries) {
    std::vector<int> balance(entries, 0);
    for (const Pairing& pairing : round_robin(entries)) {
      ++balance[index(pairing.first)];
      --balance[index(pairing.second)];
    }
    for (const int each : balance) {
      EXPECT_LE(std::abs(each), entries % 2 == 0 ? 1 : 0) << entries << " entries";
    }
  }
}

TEST(PairingSeedProperty, SeedsAreDistinctAndFitIntoADouble) {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2026}, ~std::uint64_t{0}}) {
    std::set<std::uint64_t> seen;
    for (std::uint32_t pairing = 0; pairing < 10'000; ++pairing) {
      EXPECT_LT(pairing_seed(seed, pairing), std::uint64_t{1} << 53);
      EXPECT_TRUE(seen.insert(pairing_seed(seed, pairing)).second);
    }
  }
}

struct Played {
  std::size_t entries;
  std::vector<PlayedGame> games;
};

Played any_games() {
  Played played{*rc::gen::inRange<std::size_t>(2, 8), {}};
  const auto count = *rc::gen::inRange<std::size_t>(0, 50);
  for (std::size_t i = 0; i < count; ++i) {
    const auto breaker = *rc::gen::inRange<std::size_t>(0, played.entries);
    const auto step = *rc::gen::inRange<std::size_t>(1, played.entries);
    PlayedGame game;
    game.breaker = entry_id(breaker);
    game.other = entry_id((breaker + step) % played.entries);
    game.winner = *rc::gen::element(std::optional(game.breaker), std::optional(game.other),
                                    std::optional<EntryId>{});
    played.games.push_back(game);
  }
  return played;
}

RC_GTEST_PROP(StandingsProperty, EveryGameGivesOnePointInAll, ()) {
  const Played played = any_games();
  const Standings table = standings(played.entries, played.games, all_tie_breaks);
  double points = 0;
  std::uint32_t wins = 0;
  std::uint32_t losses = 0;
  for (const StandingsRow& row : table.rows) {
    points += row.points;
    wins += row.wins;
    losses += row.losses;
    RC_ASSERT(row.points == row.wins + 0.5 * row.draws);
  }
  RC_ASSERT(points == static_cast<double>(played.games.size()));
  RC_ASSERT(wins == losses);
}

RC_GTEST_PROP(StandingsProperty, RowsDescendInPointsAndRanksAreTheirPlaces, ()) {
  const Played played = any_games();
  const Standings table = standings(played.entries, played.games, all_tie_breaks);
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    RC_ASSERT(table.rows[i - 1].points >= table.rows[i].points);
    RC_ASSERT(table.rows[i].rank == i + 1 || table.rows[i].rank == table.rows[i - 1].rank);
  }
}

RC_GTEST_PROP(StandingsProperty, RenumberingTheEntriesOnlyRenumbersTheTable, ()) {
  const Played played = any_games();
  std::vector<std::size_t> renumbered(played.entries);
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    renumbered[i] = i;
  }
  for (std::size_t i = renumbered.size(); i > 1; --i) {
    std::swap(renumbered[i - 1], renumbered[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  const auto other_number = [&](EntryId entry) { return entry_id(renumbered[index(entry)]); };
  std::vector<PlayedGame> games = played.games;
  for (PlayedGame& game : games) {
    game.breaker = other_number(game.breaker);
    game.other = other_number(game.other);
    if (game.winner) {
      game.winner = other_number(*game.winner);
    }
  }
  std::map<EntryId, StandingsRow> rows;
  for (const StandingsRow& row : standings(played.entries, games, all_tie_breaks).rows) {
    rows[row.entry] = row;
  }
  for (const StandingsRow& row : standings(played.entries, played.games, all_tie_breaks).rows) {
    const StandingsRow& same = rows.at(other_number(row.entry));
    RC_ASSERT(row.rank == same.rank);
    RC_ASSERT(row.points == same.points);
    RC_ASSERT(row.tie_breaks == same.tie_breaks);
    RC_ASSERT(row.rating.status == same.rating.status);
  }
}

RC_GTEST_PROP(StandingsProperty, TheOrderOfTheGamesDoesNotMatter, ()) {
  const Played played = any_games();
  std::vector<PlayedGame> reversed(played.games.rbegin(), played.games.rend());
  const Standings one = standings(played.entries, played.games, all_tie_breaks);
  const Standings two = standings(played.entries, reversed, all_tie_breaks);
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    RC_ASSERT(one.rows[i].entry == two.rows[i].entry);
    RC_ASSERT(one.rows[i].rank == two.rows[i].rank);
  }
}

RC_GTEST_PROP(CrosstableProperty, TheTwoSidesOfACellAddUpToItsGames, ()) {
  const Played played = any_games();
  const Crosstable table = crosstable(played.entries, played.games);
  for (std::size_t i = 0; i < played.entries; ++i) {
    for (std::size_t j = 0; j < played.entries; ++j) {
      const CrosstableCell& cell = table.at(entry_id(i), entry_id(j));
      const CrosstableCell& mirror = table.at(entry_id(j), entry_id(i));
      RC_ASSERT(cell.games == mirror.games);
      RC_ASSERT(cell.points + mirror.points == cell.games);
    }
  }
}

// Whatever the limits and whichever match ends next, every match is begun once, the limits hold
// and the tournament ends.
RC_GTEST_PROP(DirectorProperty, EveryMatchIsBegunOnceWithinTheLimits, ()) {
  const auto entries = *rc::gen::inRange<std::size_t>(2, 9);
  const ConcurrencyLimits limits{*rc::gen::inRange<std::uint32_t>(1, 6),
                                 *rc::gen::inRange<std::uint32_t>(1, 4)};
  Director director(round_robin(entries), limits);
  std::vector<Pairing> running;
  std::set<std::uint32_t> begun;
  while (!director.all_over()) {
    for (const Pairing& pairing : director.begin_due()) {
      RC_ASSERT(begun.insert(pairing.number).second);
      running.push_back(pairing);
    }
    RC_ASSERT(!running.empty());
    RC_ASSERT(running.size() <= limits.games);
    std::map<EntryId, std::uint32_t> busy;
    for (const Pairing& pairing : running) {
      RC_ASSERT(++busy[pairing.first] <= limits.games_per_entry);
      RC_ASSERT(++busy[pairing.second] <= limits.games_per_entry);
    }
    const auto next = *rc::gen::inRange<std::size_t>(0, running.size());
    director.end(running[next].number);
    running.erase(running.begin() + static_cast<std::ptrdiff_t>(next));
  }
  RC_ASSERT(begun.size() == entries * (entries - 1) / 2);
}

}  // namespace
}  // namespace poolhall::tournament
