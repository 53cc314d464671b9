#include "tests/bench/counted.hpp"

#include <gtest/gtest.h>

#include "physics/roots.hpp"

namespace poolhall::bench {
namespace {

template <class Run>
OperationCount counted(const Run& run) {
  const OperationCount before = Counted::count();
  run();
  return Counted::count() - before;
}

TEST(Counted, EachOperationCountsOnceAndASignNotAtAll) {
  Counted x(3);
  const OperationCount n = counted([&x] {
    x = -(x * x + Counted(1) - x / Counted(2));
    x += Counted(1);
    x = sqrt(abs(x));
  });
  EXPECT_EQ(n.multiplications, 1u);
  EXPECT_EQ(n.additions, 3u);
  EXPECT_EQ(n.divisions, 1u);
  EXPECT_EQ(n.roots, 1u);
  EXPECT_EQ(n.comparisons, 0u);
  EXPECT_EQ(n.total(), 6u);
}

TEST(Counted, ComparisonsOfEveryKindCountOnce) {
  const Counted p(1), q(2);
  const OperationCount n = counted([&] {
    EXPECT_TRUE(p < q);
    EXPECT_FALSE(p >= q);
    EXPECT_FALSE(p == q);
    EXPECT_TRUE(p != q);
  });
  EXPECT_EQ(n.comparisons, 4u);
  EXPECT_EQ(n.total(), 4u);
}

TEST(Counted, GivesTheValuesOfDouble) {
  const auto counted_roots = physics::quadratic_roots(Counted(1), Counted(-3), Counted(1.5));
  const auto roots = physics::quadratic_roots(1.0, -3.0, 1.5);
  EXPECT_EQ(static_cast<double>(counted_roots.first), roots.first);
  EXPECT_EQ(static_cast<double>(counted_roots.second), roots.second);
}

// q1^2 - 4 q2 q0, its root, their sum, two quotients with a product each, and which is smaller.
TEST(Counted, CountsAQuadraticAsByHand) {
  const OperationCount n = counted(
      [] { static_cast<void>(physics::quadratic_roots(Counted(1), Counted(-3), Counted(1))); });
  EXPECT_EQ(n.roots, 1u);
  EXPECT_EQ(n.divisions, 2u);
  EXPECT_EQ(n.multiplications, 3u + 2u);
  EXPECT_EQ(n.additions, 1u + 1u);
  EXPECT_EQ(n.comparisons, 5u);  // q2 with 0, the discriminant, q1, the sum; one with the other
}

}  // namespace
}  // namespace poolhall::bench
