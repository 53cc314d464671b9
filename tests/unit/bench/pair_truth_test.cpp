#include "tests/bench/pair_truth.hpp"

#include <gtest/gtest.h>

#include "tests/bench/pair_solvers.hpp"

namespace poolhall::bench {
namespace {

constexpr double radius = 0.03125;  // a power of two, so that 2R and its square are exact
constexpr double two_r = 2 * radius;

// The second disc at `d` from the first, which lies still at the origin.
DiscPair pair(physics::Vec2<double> d, physics::Vec2<double> v, physics::Vec2<double> a = {},
              double horizon = 10) {
  return {{}, {d, v, a}, radius, horizon};
}

double contact_time(const DiscPair& p) {
  const PairTruth truth = true_contact(p);
  EXPECT_TRUE(truth.contact);
  return static_cast<double>(truth.t);
}

TEST(PairTruth, HeadOnAtConstantSpeed) {
  EXPECT_DOUBLE_EQ(contact_time(pair({1, 0}, {-2, 0})), (1 - two_r) / 2);
}

TEST(PairTruth, ADeceleratingPairMeetsAtTheEarlierRoot) {
  const double way = 1 - two_r;
  EXPECT_DOUBLE_EQ(contact_time(pair({1, 0}, {-2, 0}, {2, 0})),
                   2 * way / (2 + std::sqrt(4 - 4 * way)));
  EXPECT_FALSE(true_contact(pair({1, 0}, {-1, 0}, {1, 0})).contact);
}

TEST(PairTruth, NothingBeyondTheHorizon) {
  EXPECT_FALSE(true_contact(pair({1, 0}, {-1, 0}, {}, 0.9)).contact);
  EXPECT_TRUE(true_contact(pair({1, 0}, {-1, 0}, {}, 0.95)).contact);
}

TEST(PairTruth, ExactlyTouchingPairsMeetNowIfTheyApproachAndNeverIfTheyRecede) {
  EXPECT_EQ(contact_time(pair({two_r, 0}, {-1e-9, 3})), 0.0);
  EXPECT_EQ(contact_time(pair({two_r, 0}, {0, 0}, {-1, 0})), 0.0);
  EXPECT_FALSE(true_contact(pair({two_r, 0}, {1e-9, 0})).contact);
  EXPECT_FALSE(true_contact(pair({two_r, 0}, {0, 0}, {1, 0})).contact);
  EXPECT_FALSE(true_contact(pair({two_r, 0}, {0, 1})).contact);
}

TEST(PairTruth, APairThatTurnsBackMeetsFromAboveOrWhereItTurns) {
  EXPECT_DOUBLE_EQ(contact_time(pair({two_r, 0}, {1, 0}, {-2, 0})), 1.0);
  EXPECT_DOUBLE_EQ(contact_time(pair({two_r - 0x1p-33, 0}, {0x1p-33, 0}, {-2, 0})), 0x1p-34);
}

TEST(PairTruth, AGrazeIsDecidedByTheLastBit) {
  const double above = std::nextafter(two_r, 1), below = std::nextafter(two_r, 0);
  EXPECT_FALSE(true_contact(pair({1, two_r}, {-1, 0})).contact);
  EXPECT_FALSE(true_contact(pair({1, above}, {-1, 0})).contact);
  const PairTruth hit = true_contact(pair({1, below}, {-1, 0}));
  EXPECT_TRUE(hit.contact);
  EXPECT_NE(hit.decided_by, DecidedBy::bits_64);
  EXPECT_EQ(hit.until, 1);
}

TEST(PairTruth, EqualMotionsNeverMeet) {
  EXPECT_FALSE(true_contact(pair({two_r, 0}, {0, 0})).contact);
  EXPECT_FALSE(true_contact(pair({two_r / 2, 0}, {0, 0})).contact);
}

TEST(PairTruth, AnotherRootIsNotTheContactAndNoAnswerIsNone) {
  const DiscPair through = pair({1, 0}, {-1, 0});
  const PairTruth truth = true_contact(through);
  EXPECT_TRUE(agrees(truth, 1 - two_r));
  EXPECT_TRUE(agrees(truth, 1 - two_r + 1e-9));
  EXPECT_FALSE(agrees(truth, 1 + two_r));  // where they part again
  EXPECT_FALSE(agrees(truth, std::nullopt));
  EXPECT_TRUE(agrees(true_contact(pair({1, 0}, {1, 0})), std::nullopt));
}

TEST(PairTruth, OnlyWhatAnUlpDecidesIsMarginal) {
  const DiscPair graze = pair({1, std::nextafter(two_r, 1)}, {-1, 0});
  EXPECT_FALSE(is_marginal(graze, 1.0L, 1));  // an ulp down it only touches
  EXPECT_TRUE(is_marginal(graze, 1.0L, 2));
  const DiscPair clear = pair({1, two_r + 1e-14}, {-1, 0});
  EXPECT_FALSE(is_marginal(clear, 1.0L, 4));
  EXPECT_FALSE(is_marginal(pair({1, 0}, {-1, 0}), std::nullopt, 4));
}

TEST(PairTruth, GapIsTheDistanceLessBothRadii) {
  EXPECT_EQ(gap_in_metres(pair({1, 0}, {-1, 0}), 0.5L), 0.5L - two_r);
}

TEST(PairSolvers, TheDefaultIsWrongNowhereButWithinTheRoundingOfItsInput) {
  const PairSolver solver = pair_solvers().front();
  ASSERT_EQ(solver.must_hold, MustHold::yes);
  for (const PairClass pair_class : pair_classes) {
    std::vector<DiscPair> pairs;
    for (std::uint64_t i = 0; i < 400; ++i) {
      pairs.push_back(random_pair(pair_class, 11, i));
    }
    const PairAnswers found = solver.answers(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_TRUE(agrees(true_contact(pairs[i]), found.times[i]) ||
                  is_marginal(pairs[i], found.times[i], 4))
          << name(pair_class) << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace poolhall::bench
