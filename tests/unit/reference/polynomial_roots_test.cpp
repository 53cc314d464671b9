#include "physics/reference/polynomial_roots.hpp"

#include <gtest/gtest.h>

namespace poolhall::physics::reference {
namespace {

// The polynomial with these roots and the leading coefficient `lead`.
Polynomial with_roots(const std::vector<Number>& roots, const Number& lead) {
  Polynomial p{lead};
  for (const Number& root : roots) {
    Polynomial next(p.size() + 1);
    for (std::size_t i = 0; i < p.size(); ++i) {
      next[i + 1] += p[i];
      next[i] -= root * p[i];
    }
    p = next;
  }
  return p;
}

TEST(PolynomialRoots, FindsEveryFallOfAQuarticAndNoRise) {
  const Polynomial p = with_roots({1, 2, 3, 4}, 1);  // falls at 1 and 3, rises at 2 and 4
  const std::vector<Fall> found = falls(p, 10);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(abs(found[0].t - 1), Number("1e-98"));
  EXPECT_LT(abs(found[1].t - 3), Number("1e-98"));
}

TEST(PolynomialRoots, FindsRootsOneTrillionthOfATrillionthApart) {
  const Number gap("1e-24");
  const std::vector<Fall> found = falls(with_roots({1, 1 + gap, 2, 3}, 1), 10);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(abs(found[0].t - 1), Number("1e-70"));
}

TEST(PolynomialRoots, TouchingZeroFromAboveIsNoFall) {
  EXPECT_TRUE(falls(with_roots({1, 1}, 1), 10).empty());
}

TEST(PolynomialRoots, ATripleRootIsPassed) {
  const std::vector<Fall> found = falls(with_roots({2, 2, 2}, -1), 10);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(abs(found[0].t - 2), Number("1e-30"));
}

TEST(PolynomialRoots, StartingAtZeroAndFallingIsNowAndRisingIsNot) {
  for (const Polynomial& p : {Polynomial{0, -1}, Polynomial{0, 0, -1}, Polynomial{-1, -1}}) {
    const std::vector<Fall> found = falls(p, 10);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].t, 0);
    EXPECT_EQ(found[0].until, 10);
  }
  EXPECT_TRUE(falls({0, 1}, 10).empty());
  EXPECT_TRUE(falls({0, 0, 1}, 10).empty());
}

TEST(PolynomialRoots, WhatTurnsBackBelowZeroFallsWhereItTurns) {
  const std::vector<Fall> found = falls({-2, 2, -1}, 10);  // -1 - (t - 1)^2
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(abs(found[0].t - 1), Number("1e-98"));
  EXPECT_EQ(found[0].from, found[0].t);
}

TEST(PolynomialRoots, AFallNamesTheStretchOnWhichItFalls) {
  const std::vector<Fall> found = falls(with_roots({1, 2, 4}, -1), 10);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].from, 0);
  EXPECT_GT(found[0].until, 1);
  EXPECT_LT(found[0].until, 2);
  EXPECT_GT(found[1].from, 2);
  EXPECT_EQ(found[1].until, 10);
}

TEST(PolynomialRoots, ASlopeThatTouchesZeroInTheMiddleOfTheSpanStillFalls) {
  EXPECT_EQ(falls(with_roots({2, 2, 2}, -1), 4).size(), 1u);
}

TEST(PolynomialRoots, RootsBeyondTheEndDoNotCount) {
  EXPECT_TRUE(falls(with_roots({11}, -1), 10).empty());
}

}  // namespace
}  // namespace poolhall::physics::reference
