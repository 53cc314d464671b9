// Every format on random results: the schedule grows, ends, keeps to its rules and is the same
// again from the same results.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "server/tournament/elimination.hpp"
#include "server/tournament/format.hpp"

namespace poolhall::tournament {
namespace {

constexpr std::array kinds{FormatKind::round_robin,        FormatKind::swiss,
                           FormatKind::single_elimination, FormatKind::double_elimination,
                           FormatKind::gauntlet,           FormatKind::ladder};

FormatSettings format_of(FormatKind kind) {
  FormatSettings format;
  format.kind = kind;
  format.rounds = kind == FormatKind::ladder ? 6 : 0;
  return format;
}

MatchResult result_of(const std::vector<double>& first_scores) {
  MatchResult result;
  for (const double score : first_scores) {
    result.games.push_back({static_cast<std::uint32_t>(result.games.size()), score});
  }
  return result;
}

// Plays a tournament: in each step one of the known matches that are not over ends.
class Play {
 public:
  Play(FormatKind kind, std::size_t entries, std::uint64_t seed)
      : format_(format_of(kind)), field_(entries), random_(seed) {
    now_ = schedule(format_, field_, happened_);
  }

  [[nodiscard]] bool step() {
    std::vector<const Pairing*> open;
    for (const Pairing& pairing : now_.pairings) {
      if (!happened_.results.contains(pairing.number)) {
        open.push_back(&pairing);
      }
    }
    if (open.empty()) {
      return false;
    }
    const std::uint32_t number = open[random_() % open.size()]->number;
    happened_.begun.insert(number);
    happened_.results[number] = result();
    before_ = now_;
    now_ = schedule(format_, field_, happened_, before_);
    return true;
  }
  // Somebody leaves; the round is the one that would be drawn next.
  void withdraw(std::size_t entry) {
    field_[entry].until = now_.rounds_drawn;
    now_ = schedule(format_, field_, happened_, now_);
  }

  std::size_t enter_late(std::uint32_t round) {
    field_.push_back({.from = round});
    now_ = schedule(format_, field_, happened_, now_);
    return field_.size() - 1;
  }

  [[nodiscard]] const Schedule& now() const { return now_; }
  [[nodiscard]] const Schedule& before() const { return before_; }
  [[nodiscard]] Schedule from_scratch() const { return schedule(format_, field_, happened_); }
  [[nodiscard]] const Happened& happened() const { return happened_; }
  [[nodiscard]] std::uint64_t random() { return random_(); }

 private:
  MatchResult result() {
    MatchResult result;
    const bool was_played = random_() % 25 != 0;
    for (std::uint32_t game = 0; game < 3; ++game) {
      result.games.push_back({game,
                              random_() % 20 == 0  ? 0.5
                              : random_() % 2 == 0 ? 1.0
                                                   : 0.0,
                              was_played});
    }
    return result;
  }

  FormatSettings format_;
  std::vector<EntrySpan> field_;
  Happened happened_;
  std::mt19937_64 random_;
  Schedule now_;
  Schedule before_;
};

TEST(FormatProperty, SchedulesGrowEndAndAreTheSameFromTheSameResults) {
  for (const FormatKind kind : kinds) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const std::size_t entries = 2 + seed % 8 + (kind == FormatKind::swiss ? 4 : 0);
      Play play(kind, entries, seed);
      std::size_t steps = 0;
      while (play.step()) {
        ASSERT_LT(++steps, 2000U) << name(kind);
        const auto& before = play.before().pairings;
        std::map<std::uint32_t, Pairing> now;
        for (const Pairing& pairing : play.now().pairings) {
          now[pairing.number] = pairing;
        }
        for (const Pairing& pairing : before) {
          ASSERT_TRUE(now.contains(pairing.number) && now[pairing.number] == pairing) << name(kind);
        }
        const Schedule again = play.from_scratch();
        ASSERT_EQ(again.pairings, play.now().pairings) << name(kind);
        ASSERT_EQ(again.off, play.now().off);
        ASSERT_EQ(again.is_complete, play.now().is_complete);
        ASSERT_EQ(again.sprt.has_value(), kind == FormatKind::sprt);
        if (again.sprt) {
          ASSERT_EQ(again.sprt->verdict, play.now().sprt->verdict);
          ASSERT_EQ(again.sprt->pairs, play.now().sprt->pairs);
          ASSERT_EQ(again.sprt->log_likelihood_ratio, play.now().sprt->log_likelihood_ratio);
        }
      }
      EXPECT_TRUE(play.now().is_complete) << name(kind) << ' ' << entries;
      std::set<std::uint32_t> numbers;
      for (const Pairing& pairing : play.now().pairings) {
        EXPECT_TRUE(numbers.insert(pairing.number).second);
        EXPECT_NE(pairing.first, pairing.second);
      }
    }
  }
}

TEST(FormatProperty, WhoHasWithdrawnGetsNoMatchesThatHadNotBegun) {
  for (const FormatKind kind : kinds) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Play play(kind, 6, seed);
      for (int i = 0; i < 3; ++i) {
        static_cast<void>(play.step());
      }
      std::set<std::uint32_t> known;
      for (const Pairing& pairing : play.now().pairings) {
        known.insert(pairing.number);
      }
      const std::size_t gone = play.random() % 6;
      play.withdraw(gone);
      while (play.step()) {
      }
      EXPECT_TRUE(play.now().is_complete) << name(kind) << " seed " << seed;
      for (const Pairing& pairing : play.now().pairings) {
        if (index(pairing.first) == gone || index(pairing.second) == gone) {
          EXPECT_TRUE(known.contains(pairing.number)) << name(kind);
        }
      }
    }
  }
}

TEST(FormatProperty, ALateEntryPlaysFromItsRoundAndChangesNoRoundBefore) {
  for (const FormatKind kind : {FormatKind::swiss, FormatKind::ladder}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Play play(kind, 5 + seed % 4, seed);
      for (std::uint64_t i = 0; i < seed % 4 && play.step(); ++i) {
      }
      const auto round = late_round(kind, play.now());
      ASSERT_TRUE(round);
      const auto before = play.now().pairings;
      const std::uint32_t rounds = play.now().rounds;
      const std::size_t late = play.enter_late(*round);
      ASSERT_EQ(play.now().pairings, before);
      bool has_played = false;
      while (play.step()) {
        ASSERT_TRUE(same_pairings(play.from_scratch(), play.now())) << name(kind) << ' ' << seed;
        for (const Pairing& pairing : play.now().pairings) {
          if (index(pairing.first) == late || index(pairing.second) == late) {
            ASSERT_GE(pairing.round, *round);
            has_played = true;
          }
        }
      }
      EXPECT_TRUE(play.now().is_complete);
      EXPECT_EQ(play.now().rounds, rounds) << "nobody makes it longer by coming late";
      EXPECT_FALSE(late_round(kind, play.now()));
      EXPECT_TRUE(has_played) << name(kind) << ' ' << seed;
    }
  }
}

TEST(EliminationProperty, ADrawnGameIsPlayedAgainOnceAndThenALotDecides) {
  FormatSettings format;
  format.kind = FormatKind::single_elimination;
  std::size_t better = 0;
  for (format.seed = 1; format.seed <= 64; ++format.seed) {
    const std::vector<EntrySpan> field(2);
    Happened happened;
    for (std::uint32_t attempt = 0; attempt < 2; ++attempt) {
      const Schedule now = schedule(format, field, happened);
      ASSERT_EQ(now.pairings.size(), attempt + 1);
      ASSERT_TRUE(now.lots.empty());
      happened.begun.insert(attempt);
      happened.results[attempt] = {{{0, 0.5, true}}};
    }
    const Schedule now = schedule(format, field, happened);
    EXPECT_EQ(now.pairings.size(), 2U);
    EXPECT_NE(now.pairings[0].first, now.pairings[1].first) << "the break is turned round";
    EXPECT_TRUE(now.is_complete);
    ASSERT_EQ(now.lots.size(), 1U);
    EXPECT_EQ(now.places[index(now.lots[0].winner)], 0U);
    EXPECT_EQ(now.places[index(now.lots[0].loser)], 1U);
    EXPECT_EQ(schedule(format, field, happened).lots, now.lots);
    better += index(now.lots[0].winner) == 0 ? 1 : 0;
  }
  EXPECT_GT(better, 16U);
  EXPECT_LT(better, 48U);
}

TEST(EliminationProperty, ALevelMatchWithoutADrawnGameIsPlayedEightTimesAtMost) {
  FormatSettings format;
  format.kind = FormatKind::double_elimination;
  Happened happened;
  for (std::uint32_t attempt = 0; attempt < 8; ++attempt) {
    ASSERT_TRUE(schedule(format, std::vector<EntrySpan>(2), happened).lots.empty());
    happened.begun.insert(attempt);
    happened.results[attempt] = {{{0, 1, true}, {1, 0, true}}};
  }
  EXPECT_EQ(schedule(format, std::vector<EntrySpan>(2), happened).lots.size(), 1U);
}

TEST(SprtProperty, PairsThatWereNotBothPlayedDoNotCount) {
  FormatSettings format;
  format.kind = FormatKind::sprt;
  format.rounds = 3;
  const std::vector<EntrySpan> field(2);
  Happened happened;
  for (std::uint32_t match = 0; match < 3; ++match) {
    happened.begun.insert(match);
  }
  happened.results[0] = {{{0, 1, true}, {1, 1, false}, {2, 1, true}, {3, 0, true}}};
  happened.results[1] = {{{1, 1, true}, {2, 0, true}, {3, 1, true}}};  // 0 could not be played
  happened.results[2] = {{{0, 1, false}, {1, 1, false}, {2, 1, false}, {3, 0, false}}};
  const Schedule now = schedule(format, field, happened);
  EXPECT_TRUE(now.is_complete);
  EXPECT_EQ(now.sprt->pairs, 2U);
}

// By entry, matches lost in elimination (level ones are played again, then there is a lot).
std::vector<std::size_t> losses(const Play& play, std::size_t entries) {
  std::vector<std::size_t> lost(entries, 0);
  for (const Pairing& pairing : play.now().pairings) {
    const MatchResult& result = play.happened().results.at(pairing.number);
    const double lead = result.first_points() - result.second_points();
    if (lead != 0) {
      ++lost[index(lead > 0 ? pairing.second : pairing.first)];
    }
  }
  for (const Lot& lot : play.now().lots) {
    ++lost[index(lot.loser)];
  }
  return lost;
}

TEST(EliminationProperty, OneLossPutsOutOfASingleAndTwoOutOfADoubleElimination) {
  for (const FormatKind kind : {FormatKind::single_elimination, FormatKind::double_elimination}) {
    const std::size_t lives = kind == FormatKind::single_elimination ? 1 : 2;
    for (std::size_t entries = 2; entries <= 33; ++entries) {
      Play play(kind, entries, entries);
      while (play.step()) {
      }
      const auto lost = losses(play, entries);
      std::size_t still_in = 0;
      for (std::size_t i = 0; i < entries; ++i) {
        EXPECT_LE(lost[i], lives);
        still_in += lost[i] < lives ? 1 : 0;
        EXPECT_EQ(lost[i] < lives, play.now().places[i] == 0) << entries << " entries";
      }
      EXPECT_EQ(still_in, 1U) << name(kind) << ' ' << entries;
    }
  }
}

TEST(EliminationProperty, TheBracketHasEachMatchOnceWithWhoGoesOnFromIt) {
  for (const FormatKind kind : {FormatKind::single_elimination, FormatKind::double_elimination}) {
    for (std::size_t entries = 2; entries <= 17; ++entries) {
      Play play(kind, entries, entries);
      do {
        std::map<std::uint32_t, const BracketPlace*> places;
        for (const BracketPlace& place : play.now().bracket) {
          for (const std::uint32_t number : place.pairings) {
            EXPECT_TRUE(places.emplace(number, &place).second);
            EXPECT_TRUE(place.is_played);
          }
        }
        for (const Pairing& pairing : play.now().pairings) {
          ASSERT_TRUE(places.contains(pairing.number));
          const BracketPlace& place = *places[pairing.number];
          EXPECT_EQ(std::set({place.one, place.two}),
                    std::set({std::optional(pairing.first), std::optional(pairing.second)}));
          EXPECT_EQ(place.round, pairing.round);
        }
      } while (play.step());
      const BracketPlace& last = play.now().bracket.back();
      EXPECT_EQ(last.side,
                kind == FormatKind::single_elimination ? BracketSide::winners : BracketSide::final);
      ASSERT_TRUE(last.winner);
      EXPECT_EQ(play.now().places[index(*last.winner)], 0U) << name(kind) << ' ' << entries;
    }
  }
}

TEST(EliminationProperty, TheFirstSeedsHaveTheByesAndMeetLast) {
  for (std::size_t entries = 2; entries <= 64; ++entries) {
    const auto tree = single_elimination_tree(entries);
    std::size_t byes = 0;
    for (const BracketMatch& match : tree) {
      if (match.one.kind == BracketSource::Kind::seed && match.two.of >= entries) {
        ++byes;
        EXPECT_LT(match.one.of, tree.size() + 1 - entries);
      }
    }
    EXPECT_EQ(byes, tree.size() + 1 - entries);
  }
}

TEST(GauntletProperty, RunnersMeetEveryOtherAndTheOthersNobodyElse) {
  FormatSettings format;
  format.kind = FormatKind::gauntlet;
  format.runners = 2;
  const Schedule now = schedule(format, std::vector<EntrySpan>(7), {});
  std::set<std::pair<EntryId, EntryId>> met;
  std::set<std::pair<std::uint32_t, EntryId>> busy;
  for (const Pairing& pairing : now.pairings) {
    const auto pair = std::minmax(pairing.first, pairing.second);
    EXPECT_LT(index(pair.first), 2U);
    EXPECT_GE(index(pair.second), 2U);
    EXPECT_TRUE(met.insert(pair).second);
    EXPECT_TRUE(busy.insert({pairing.round, pairing.first}).second);
    EXPECT_TRUE(busy.insert({pairing.round, pairing.second}).second);
  }
  EXPECT_EQ(met.size(), 10U);
}

TEST(GauntletProperty, EverybodyIsFirstAsOftenAsSecondOrOnceMoreOrLess) {
  FormatSettings format;
  format.kind = FormatKind::gauntlet;
  for (std::size_t entries = 2; entries < 40; ++entries) {
    for (format.runners = 1; format.runners < entries; ++format.runners) {
      std::vector<int> lead(entries, 0);
      for (const Pairing& pairing :
           schedule(format, std::vector<EntrySpan>(entries), {}).pairings) {
        ++lead[index(pairing.first)];
        --lead[index(pairing.second)];
      }
      const auto [least, most] = std::minmax_element(lead.begin(), lead.end());
      ASSERT_GE(*least, -1) << format.runners << " of " << entries;
      ASSERT_LE(*most, 1) << format.runners << " of " << entries;
    }
  }
}

TEST(LadderProperty, NeighboursByRatingMeetAndWinnersRise) {
  FormatSettings format;
  format.kind = FormatKind::ladder;
  format.rounds = 40;
  const std::vector<EntrySpan> field(5);
  Happened happened;
  Schedule now = schedule(format, field, happened);
  while (!now.is_complete) {
    for (const Pairing& pairing : now.pairings) {
      // The later entry always wins.
      const bool first_wins = index(pairing.first) > index(pairing.second);
      happened.results[pairing.number] = result_of({first_wins ? 1.0 : 0.0});
    }
    now = schedule(format, field, happened);
  }
  EXPECT_EQ(now.places, (std::vector<std::uint32_t>{4, 3, 2, 1, 0}));
  const Standings table = standings(5, {}, table_rules(format, now, happened, {}));
  ASSERT_TRUE(table.has_ladder);
  for (const StandingsRow& row : table.rows) {
    EXPECT_EQ(row.ladder.value().rating, now.ladder[index(row.entry)].rating);
    EXPECT_EQ(row.ladder->deviation, now.ladder[index(row.entry)].deviation);
  }
  EXPECT_GT(table.rows[0].ladder->rating, table.rows[4].ladder->rating);
}

TEST(SprtSchedule, EndsWhenTheTestDecidesInTheOrderOfTheScheduleWhateverEndsFirst) {
  FormatSettings format;
  format.kind = FormatKind::sprt;
  format.rounds = 2000;
  format.sprt = {.elo0 = 0, .elo1 = 100};
  const std::vector<EntrySpan> field(2);
  Happened in_order;
  Happened with_later_ones;
  std::mt19937_64 random(3);
  std::size_t matches = 0;
  for (;; ++matches) {
    const auto number = static_cast<std::uint32_t>(matches);
    const bool turned = number % 2 == 1;
    std::vector<double> scores;
    for (int game = 0; game < 2; ++game) {
      const bool one_wins = random() % 10 < 7;
      scores.push_back(one_wins != turned ? 1 : 0);
    }
    in_order.results[number] = result_of(scores);
    if (schedule(format, field, in_order).is_complete) {
      break;
    }
  }
  with_later_ones = in_order;
  for (std::uint32_t later = 0; later < 5; ++later) {
    with_later_ones.results[static_cast<std::uint32_t>(matches) + 1 + later] = result_of({0, 0});
  }
  const Schedule one = schedule(format, field, in_order);
  const Schedule two = schedule(format, field, with_later_ones);
  EXPECT_EQ(one.sprt->verdict, ratings::SprtVerdict::h1);
  EXPECT_EQ(one.pairings.size(), matches + 1);
  EXPECT_EQ(two.pairings, one.pairings);
  EXPECT_EQ(two.sprt->pairs, one.sprt->pairs);
  EXPECT_EQ(two.sprt->log_likelihood_ratio, one.sprt->log_likelihood_ratio);
}

}  // namespace
}  // namespace poolhall::tournament
