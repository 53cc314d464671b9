#include "physics/table_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace poolhall::physics {
namespace {

constexpr double geometry_ball_radius = 0.028575;

TableGeometry<double> geometry_of(const char* name) {
  return table_geometry<double>(preset_table(name).value(), geometry_ball_radius);
}

const StraightRail<double>& rail(const TableGeometry<double>& geometry, RailId id) {
  return *std::find_if(geometry.rails.begin(), geometry.rails.end(),
                       [&](const auto& r) { return r.rail == id; });
}

const Facing<double>& facing(const TableGeometry<double>& geometry, PocketId pocket, RailId id) {
  return *std::find_if(geometry.facings.begin(), geometry.facings.end(),
                       [&](const auto& f) { return f.pocket == pocket && f.rail == id; });
}

double distance(const Vec2<double>& p, const Vec2<double>& q) {
  return std::hypot(p.x - q.x, p.y - q.y);
}

TEST(TableGeometry, WithoutPocketsHasSixRailsThatCloseTheRectangle) {
  Table table = preset_table("olympiad").value();
  table.pockets = NoPockets{};
  const auto geometry = table_geometry<double>(table, geometry_ball_radius);
  EXPECT_EQ(geometry.rails.size, rail_count);
  EXPECT_TRUE(geometry.mouths.empty());
  EXPECT_TRUE(geometry.arcs.empty());
  EXPECT_TRUE(geometry.facings.empty());
  EXPECT_TRUE(geometry.holes.empty());
  EXPECT_EQ(rail(geometry, RailId::head_left).begin, 0);
  EXPECT_EQ(rail(geometry, RailId::head_left).end, table.length / 2);
  EXPECT_EQ(rail(geometry, RailId::foot_left).begin, table.length / 2);
  EXPECT_EQ(rail(geometry, RailId::foot_left).end, table.length);
  EXPECT_EQ(rail(geometry, RailId::foot).centre_line, table.length - geometry_ball_radius);
  EXPECT_EQ(rail(geometry, RailId::head_right).into, (Vec2<double>{1, 0}));
}

TEST(TableGeometry, OlympiadCornerMouthsMeetTheRailsWhereTheNosesEnd) {
  const auto geometry = geometry_of("olympiad");
  ASSERT_EQ(geometry.mouths.size, pocket_count);
  for (const MouthLine<double>& mouth : geometry.mouths) {
    EXPECT_NEAR(dot(mouth.to, mouth.outward), mouth.offset, 1e-15);
    EXPECT_NEAR(dot(mouth.outward, mouth.outward), 1, 1e-15);
  }
  const MouthLine<double>& corner = geometry.mouths[0];
  EXPECT_EQ(corner.pocket, PocketId::head_left);
  EXPECT_NEAR(corner.from.x + corner.from.y, 0.11 / std::sqrt(2.0) + geometry_ball_radius, 1e-16);
  EXPECT_EQ(corner.from.x, geometry_ball_radius);
  EXPECT_NEAR(corner.from.y, rail(geometry, RailId::head_left).begin, 1e-17);
  EXPECT_NEAR(corner.to.x, rail(geometry, RailId::head).begin, 1e-17);
}

TEST(TableGeometry, OlympiadSideMouthsFillTheGapOfTheLongRails) {
  const auto geometry = geometry_of("olympiad");
  const MouthLine<double>& side = geometry.mouths[4];
  EXPECT_EQ(side.pocket, PocketId::side_left);
  EXPECT_EQ(side.from.x, geometry_ball_radius);
  EXPECT_EQ(side.from.y, rail(geometry, RailId::head_left).end);
  EXPECT_EQ(side.to.y, rail(geometry, RailId::foot_left).begin);
  EXPECT_NEAR(side.to.y - side.from.y, 0.12, 1e-15);
}

// The check values of the design.
TEST(TableGeometry, Bar7HasTheRailsAndFacingsOfTheDesign) {
  const auto geometry = geometry_of("bar7");
  EXPECT_NEAR(rail(geometry, RailId::head_left).begin, 0.091002, 1e-6);
  EXPECT_NEAR(rail(geometry, RailId::head_left).end, 0.915084, 1e-6);
  EXPECT_NEAR(rail(geometry, RailId::head).begin, 0.091002, 1e-6);
  EXPECT_NEAR(rail(geometry, RailId::head).end, 0.899598, 1e-6);
  const auto& corner = facing(geometry, PocketId::head_left, RailId::head);
  EXPECT_NEAR(corner.to.x, 0.02225, 1e-5);
  EXPECT_NEAR(corner.to.y, -0.0508, 1e-15);
  EXPECT_NEAR(corner.from.x, 0.07762, 1e-5);
  EXPECT_NEAR(corner.from.y, -0.004831, 1e-6);
  const auto& side = facing(geometry, PocketId::side_left, RailId::head_left);
  EXPECT_NEAR(side.to.x, -0.0508, 1e-15);
  EXPECT_NEAR(side.to.y, 0.928463, 1e-6);
  EXPECT_NEAR(side.from.x, -0.006962, 1e-6);
  EXPECT_NEAR(side.from.y, 0.922972, 1e-6);
}

TEST(TableGeometry, JawArcsAreTangentToRailAndFacing) {
  const auto geometry = geometry_of("bar7");
  ASSERT_EQ(geometry.arcs.size, 12U);
  ASSERT_EQ(geometry.facings.size, 12U);
  ASSERT_EQ(geometry.holes.size, 6U);
  for (std::size_t i = 0; i < geometry.arcs.size; ++i) {
    const JawArc<double>& arc = geometry.arcs[i];
    const Facing<double>& wall = geometry.facings[i];
    EXPECT_EQ(arc.pocket, wall.pocket);
    EXPECT_EQ(arc.rail, wall.rail);
    EXPECT_NEAR(distance(arc.centre, wall.from), arc.radius, 1e-15);
    // The radius to the facing's end is normal to the facing, out of the cushion.
    const Vec2<double> out = (1 / arc.radius) * (wall.from - arc.centre);
    EXPECT_NEAR(dot(out, wall.along), 0, 1e-13);
    EXPECT_NEAR(dot(out, wall.into), -1, 1e-13);
    // One end of the arc faces the facing, the other the rail, and it turns counter-clockwise.
    const bool first_is_facing = distance(arc.first, out) < 1e-12;
    EXPECT_NEAR(distance(first_is_facing ? arc.first : arc.last, out), 0, 1e-12);
    const Vec2<double> at_rail = first_is_facing ? arc.last : arc.first;
    const StraightRail<double>& straight = rail(geometry, arc.rail);
    EXPECT_NEAR(dot(at_rail, straight.into), -1, 1e-15);
    EXPECT_GT(arc.first.x * arc.last.y - arc.first.y * arc.last.x, 0);
    // It touches the rail at its end.
    const Vec2<double> touch = arc.centre + arc.radius * at_rail;
    const bool is_long = straight.axis == Axis::x;
    EXPECT_NEAR(is_long ? touch.x : touch.y, straight.nose_line, 1e-15);
    const double along = is_long ? touch.y : touch.x;
    EXPECT_NEAR(std::min(std::abs(along - straight.begin), std::abs(along - straight.end)), 0,
                1e-15);
  }
}

TEST(TableGeometry, HolesLieBehindTheNoseLines) {
  for (const char* name : {"bar7", "wpa8", "wpa9"}) {
    const auto geometry = geometry_of(name);
    for (const Hole<double>& hole : geometry.holes) {
      const bool is_side =
          hole.pocket == PocketId::side_left || hole.pocket == PocketId::side_right;
      EXPECT_TRUE(hole.centre.x < 0 || hole.centre.x > geometry.width);
      EXPECT_EQ(hole.centre.y < 0 || hole.centre.y > geometry.length, !is_side);
      EXPECT_EQ(hole.radius, is_side ? 0.0645 : 0.062);
    }
  }
}

TEST(TableGeometry, WiderTypesGiveTheSameTable) {
  for (const std::string& name : preset_table_names()) {
    const Table table = preset_table(name).value();
    const auto narrow = table_geometry<double>(table, geometry_ball_radius);
    const auto wide = table_geometry<long double>(table, geometry_ball_radius);
    ASSERT_EQ(narrow.facings.size, wide.facings.size);
    for (std::size_t i = 0; i < narrow.facings.size; ++i) {
      EXPECT_NEAR(narrow.facings[i].from.x, static_cast<double>(wide.facings[i].from.x), 4e-16);
      EXPECT_NEAR(narrow.facings[i].to.y, static_cast<double>(wide.facings[i].to.y), 8e-16);
    }
    for (std::size_t i = 0; i < narrow.rails.size; ++i) {
      EXPECT_NEAR(narrow.rails[i].end, static_cast<double>(wide.rails[i].end), 4e-16);
    }
  }
}

}  // namespace
}  // namespace poolhall::physics
