#include "server/match/fairness.hpp"

#include <gtest/gtest.h>

#include "server/storage/sqlite_database.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::match {
namespace {

using storage::Micros;

// A match that goes on, with one game in it, and a finished one of a pair with mirrored noise.
class Fairness : public testing::Test {
 protected:
  Fairness() {
    const auto file = directory_ / "test.db";
    {
      auto database = storage::open_sqlite(file).value();
      add_players(*database);
      PlayedGame(*database, order_of(1), 5).play(4);
      add_mirrored_pair(*database, 12);
    }
    reader_ = storage::open_sqlite_reader(file).value();
  }

  [[nodiscard]] storage::MatchRecord match(std::int64_t id) {
    return reader_->match(protocol::MatchId{id}).value().value();
  }

  template <class Action>
  void for_turns_of(std::int64_t match_id, const Action& action) {
    const auto games = reader_->games_of(protocol::MatchId{match_id}).value();
    for (const storage::GameRecord& game : games) {
      must(reader_->each_turn(game.id, [&](const storage::TurnRecord& turn) {
        action(game, turn);
        return true;
      }));
    }
  }

  test_support::TemporaryDirectory directory_;
  std::unique_ptr<storage::Reader> reader_;
};

TEST_F(Fairness, CountsNoShotWhoseNoiseIsSecret) {
  const FairnessReport report = fairness(*reader_, {match(1)}).value();
  EXPECT_EQ(report.matches, 1U);
  EXPECT_EQ(report.unrevealed, 1U);
  EXPECT_EQ(report.games, 1U);
  EXPECT_EQ(report.shots, 0U);
  EXPECT_EQ(report.agents.size(), 2U);
}

TEST_F(Fairness, AddsUpTheTimesOfEachAgent) {
  const FairnessReport report = fairness(*reader_, {match(1), match(2)}).value();
  ASSERT_EQ(report.agents.size(), 2U);
  for (const AgentTimes& times : report.agents) {
    Micros used{0};
    Micros forgiven{0};
    std::size_t turns = 0;
    for (const std::int64_t id : {1, 2}) {
      for_turns_of(id, [&](const storage::GameRecord& game, const storage::TurnRecord& turn) {
        if (game.agents[index(turn.seat)] == times.agent) {
          used += turn.clock.used;
          forgiven += turn.clock.forgiven;
          ++turns;
        }
      });
    }
    EXPECT_GT(turns, 0U);
    EXPECT_EQ(times.thought.count(), turns);
    EXPECT_EQ(times.thought.total(), used);
    EXPECT_EQ(times.charged, used - forgiven);
    EXPECT_GT(forgiven, Micros{0});
  }
}

TEST_F(Fairness, FindsTheNoiseOfAPairThatSharesItTheSame) {
  const FairnessReport report = fairness(*reader_, {match(2)}).value();
  std::uint64_t shots = 0;
  for_turns_of(2, [&](const storage::GameRecord&, const storage::TurnRecord& turn) {
    shots += turn.shot ? 1 : 0;
  });
  EXPECT_EQ(report.unrevealed, 0U);
  EXPECT_EQ(report.games, 2U);
  EXPECT_GE(shots, 2U);
  EXPECT_EQ(report.shots, shots);
  EXPECT_EQ(report.shared_shots, shots);
  ASSERT_TRUE(report.deviates.value);
  EXPECT_NEAR(*report.deviates.value, 1, 1e-12);
}

TEST(Durations, HaveTheLeastThatAShareDoesNotExceed) {
  Durations durations;
  EXPECT_EQ(durations.percentile(0.5), Micros{0});
  for (const int ms : {4, 1, 3, 2})
    durations.add(Micros{ms});
  durations.sort();
  EXPECT_EQ(durations.percentile(0), Micros{1});
  EXPECT_EQ(durations.percentile(0.5), Micros{2});
  EXPECT_EQ(durations.percentile(0.51), Micros{3});
  EXPECT_EQ(durations.percentile(1), Micros{4});
}

}  // namespace
}  // namespace poolhall::match
