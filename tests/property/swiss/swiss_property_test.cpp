// The Swiss pairings of random tournaments against brute force and against what the rules promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>
#include <string>

#include "../../unit/swiss/random_swiss.hpp"
#include "../../unit/swiss/swiss_oracle.hpp"
#include "server/tournament/matching.hpp"

namespace poolhall::tournament {
namespace {

// How many tournaments: a few here, more by hand.
std::size_t tournaments(std::size_t by_default) {
  const char* wanted = std::getenv("POOLHALL_SWISS_TOURNAMENTS");
  return wanted == nullptr ? by_default : static_cast<std::size_t>(std::atoll(wanted));
}

OraclePairing as_sets(const SwissPairings& pairings) {
  OraclePairing sets{{}, pairings.bye};
  for (const SwissPair& pair : pairings.pairs) {
    sets.pairs.insert({pair.first, pair.second});
  }
  return sets;
}

TEST(SwissProperty, PairsAsBruteForceDoesWithUpToTenPlayers) {
  std::size_t rounds = 0;
  std::size_t impossible = 0;
  for (std::size_t seed = 1; seed <= tournaments(150); ++seed) {
    const std::size_t entries = 4 + seed % 7;
    RandomSwiss swiss(entries, seed);
    while (swiss.next_round()) {
      const auto best = oracle_pairing(swiss.entries(), swiss.present(), swiss.terms().rounds);
      ++rounds;
      if (!best) {
        ++impossible;
        continue;
      }
      const OraclePairing found = as_sets(swiss.pairings());
      ASSERT_EQ(found.pairs, best->pairs) << "tournament " << seed;
      ASSERT_EQ(found.bye, best->bye) << "tournament " << seed;
    }
  }
  EXPECT_GT(rounds, 3 * tournaments(150));
  RecordProperty("rounds", std::to_string(rounds));
  RecordProperty("impossible", std::to_string(impossible));
}

// Every legal pairing of the round, by the blossom algorithm's exactness: whether one exists.
bool can_be_legal(const std::vector<SwissPlayer>& players, const SwissTerms& terms) {
  WeightedGraph graph(players.size());
  for (std::size_t i = 0; i < players.size(); ++i) {
    for (std::size_t j = i + 1; j < players.size(); ++j) {
      if (!have_met(players[i], players[j]) && !breaks_clash(players[i], players[j], terms)) {
        const int no_bye = (players[i].had_bye || players[i].had_free_win ? 1 : 0) +
                           (players[j].had_bye || players[j].had_free_win ? 1 : 0);
        graph.set(i, j, 1000 + no_bye);
      }
    }
  }
  const auto matched = maximum_weight_matching(graph);
  std::size_t free = 0;
  bool eligible = true;
  for (std::size_t i = 0; i < players.size(); ++i) {
    if (!matched[i]) {
      ++free;
      eligible = eligible && !players[i].had_bye && !players[i].had_free_win;
    }
  }
  return free == players.size() % 2 && eligible;
}

struct Counts {
  std::size_t rounds = 0;
  std::size_t rematches = 0;
  std::size_t second_byes = 0;
  std::size_t clashes = 0;
  std::size_t unpaired = 0;
  std::size_t forced = 0;  // rounds without any legal pairing
  double longest = 0;
};

void count_round(const RandomSwiss& swiss, Counts& counts) {
  const auto players = swiss.players();
  const auto find = [&](EntryId id) -> const SwissPlayer& {
    return *std::find_if(players.begin(), players.end(),
                         [id](const SwissPlayer& player) { return player.entry.id == id; });
  };
  ++counts.rounds;
  if (!can_be_legal(players, swiss.terms())) {
    ++counts.forced;
    return;
  }
  std::size_t seen = swiss.pairings().bye ? 1 : 0;
  for (const SwissPair& pair : swiss.pairings().pairs) {
    const SwissPlayer& first = find(pair.first);
    const SwissPlayer& second = find(pair.second);
    counts.rematches += have_met(first, second) ? 1 : 0;
    counts.clashes += breaks_clash(first, second, swiss.terms()) ? 1 : 0;
    seen += 2;
  }
  counts.unpaired += players.size() - seen;
  if (swiss.pairings().bye) {
    const SwissPlayer& alone = find(*swiss.pairings().bye);
    counts.second_byes += alone.had_bye || alone.had_free_win ? 1 : 0;
  }
}

TEST(SwissProperty, NobodyMeetsTwiceOrHasTwoByesUnlessItMustBe) {
  Counts counts;
  for (std::size_t seed = 1; seed <= tournaments(30); ++seed) {
    RandomSwiss swiss(6 + seed * 29 % 59, seed);
    auto before = std::chrono::steady_clock::now();
    while (swiss.next_round()) {
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
      counts.longest = std::max(counts.longest, took.count());
      count_round(swiss, counts);
      before = std::chrono::steady_clock::now();
    }
  }
  EXPECT_EQ(counts.rematches, 0U);
  EXPECT_EQ(counts.second_byes, 0U);
  EXPECT_EQ(counts.clashes, 0U);
  EXPECT_EQ(counts.unpaired, 0U);
  EXPECT_LT(counts.forced, counts.rounds / 20);
  std::printf("%zu rounds, %zu without a legal pairing, the longest took %.2f s\n", counts.rounds,
              counts.forced, counts.longest);
}

TEST(MatchingProperty, IsAsHeavyAsTheHeaviestOfAllMatchings) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::size_t size = 2 + random() % 7;
    WeightedGraph graph(size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = i + 1; j < size; ++j) {
        if (random() % 4 != 0) {
          graph.set(i, j, 1 + random() % (trial % 2 == 0 ? 5 : 1000));
        }
      }
    }
    std::vector<Weight> best(std::size_t{1} << size, 0);  // by set of vertices
    for (std::size_t set = 1; set < best.size(); ++set) {
      for (std::size_t i = 0; i < size; ++i) {
        if ((set >> i & 1U) == 0) {
          continue;
        }
        best[set] = std::max(best[set], best[set ^ (std::size_t{1} << i)]);
        for (std::size_t j = i + 1; j < size; ++j) {
          const std::size_t both = (std::size_t{1} << i) | (std::size_t{1} << j);
          if ((set & both) == both && graph.weight(i, j) > 0) {
            best[set] = std::max<Weight>(best[set], best[set ^ both] + graph.weight(i, j));
          }
        }
      }
    }
    const auto matched = maximum_weight_matching(graph);
    Weight sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      if (matched[i]) {
        ASSERT_EQ(matched[*matched[i]], i);
        sum += i < *matched[i] ? graph.weight(i, *matched[i]) : Weight(0);
      }
    }
    ASSERT_EQ(sum, best.back()) << "trial " << trial;
  }
}

}  // namespace
}  // namespace poolhall::tournament
