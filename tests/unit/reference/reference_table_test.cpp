#include "physics/reference/reference_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace poolhall::physics::reference {
namespace {

bool has_nose(const ReferenceTable& table, double x0, double y0, double x1, double y1) {
  const auto near = [](const Vec2<Number>& p, double x, double y) {
    return abs(p.x - x) < Number("6e-7") && abs(p.y - y) < Number("6e-7");
  };
  return std::any_of(table.noses.begin(), table.noses.end(), [&](const Nose& nose) {
    return (near(nose.from, x0, y0) && near(nose.to, x1, y1)) ||
           (near(nose.from, x1, y1) && near(nose.to, x0, y0));
  });
}

TEST(ReferenceTable, Bar7HasTheVerticesOfTheDesign) {
  Table table;
  table.width = 0.9906;
  table.length = 1.9812;
  Jaws jaws;
  jaws.corner = {.118, 5.3, .0417, .062, .02095};
  jaws.side = {.137, 7.14, .0685, .0645, .00795};
  table.pockets = jaws;
  const ReferenceTable found = reference_table(table, 0.028575);
  EXPECT_TRUE(has_nose(found, 0, .091002, 0, .915084));
  EXPECT_TRUE(has_nose(found, .091002, 0, .899598, 0));
  EXPECT_TRUE(has_nose(found, .02225, -.0508, .07762, -.004831));
  EXPECT_TRUE(has_nose(found, -.0508, .928463, -.006962, .922972));
  EXPECT_EQ(found.holes.size(), 6u);
  EXPECT_EQ(found.arcs.size(), 12u);
}

}  // namespace
}  // namespace poolhall::physics::reference
