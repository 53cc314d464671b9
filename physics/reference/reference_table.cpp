#include "physics/reference/reference_table.hpp"

#include <boost/math/constants/constants.hpp>

namespace poolhall::physics::reference {

namespace {

Number radians(const Number& degrees) {
  return degrees * boost::math::constants::pi<Number>() / 180;
}

// A mirror image of the quarter of the table at the head's left corner.
struct Quarter {
  bool right, foot;
};
constexpr Quarter quarters[] = {{false, false}, {true, false}, {false, true}, {true, true}};

struct Mirror {
  Number width, length;
  Quarter quarter;

  [[nodiscard]] Vec2<Number> point(const Number& x, const Number& y) const {
    return {quarter.right ? Number(width - x) : x, quarter.foot ? Number(length - y) : y};
  }
  [[nodiscard]] RailId short_rail() const { return quarter.foot ? RailId::foot : RailId::head; }
  [[nodiscard]] RailId long_rail() const {
    if (quarter.foot) {
      return quarter.right ? RailId::foot_right : RailId::foot_left;
    }
    return quarter.right ? RailId::head_right : RailId::head_left;
  }
  [[nodiscard]] PocketId corner() const {
    if (quarter.foot) {
      return quarter.right ? PocketId::foot_right : PocketId::foot_left;
    }
    return quarter.right ? PocketId::head_right : PocketId::head_left;
  }
  [[nodiscard]] PocketId side() const {
    return quarter.right ? PocketId::side_right : PocketId::side_left;
  }
};

// The nose from `from` to `to` whose free side is the one of `towards`.
Nose nose(const Vec2<Number>& from, const Vec2<Number>& to, const Vec2<Number>& towards,
          RailId rail) {
  const Vec2<Number> along = to - from;
  const Number size = sqrt(dot(along, along));
  Vec2<Number> normal{-along.y / size, along.x / size};
  if (dot(towards - from, normal) < 0) {
    normal = {-normal.x, -normal.y};
  }
  return {from, to, normal, rail};
}

// Noses on the rectangle, each long rail in two halves, with `corner` left free at every corner
// and `side` left free on both sides of the middle of the long rails.
void add_straight_rails(ReferenceTable& out, const Mirror& m, const Number& corner,
                        const Number& side) {
  const Vec2<Number> middle{m.width / 2, m.length / 2};
  out.noses.push_back(
      nose(m.point(0, corner), m.point(0, m.length / 2 - side), middle, m.long_rail()));
  if (!m.quarter.right) {
    out.noses.push_back(
        nose(m.point(corner, 0), m.point(m.width - corner, 0), middle, m.short_rail()));
  }
}

void add_jaws(ReferenceTable& out, const Mirror& m, const Jaws& jaws) {
  const Number k = jaws.cushion_width;
  const Number f = jaws.corner.angle;
  const Number j = jaws.corner.jaw_radius;
  const Number root_two = sqrt(Number(2));
  const Number a = Number(jaws.corner.width) / root_two;
  const Number r = a + j / tan(radians((135 + f) / 2));
  const Number hole_at = -Number(jaws.corner.depth) / root_two;
  const Vec2<Number> corner_hole = m.point(hole_at, hole_at);
  const Number s45 = sin(radians(45 + f));
  const Number c45 = cos(radians(45 + f));
  const Number x0 = a - (r - a) * s45;
  const Number y0 = -(r - a) * c45;
  const Number x1 = a - k * s45 / c45;
  out.arcs.push_back({m.point(r, -j), j, m.short_rail()});
  out.arcs.push_back({m.point(-j, r), j, m.long_rail()});
  out.noses.push_back(nose(m.point(x0, y0), m.point(x1, -k), corner_hole, m.short_rail()));
  out.noses.push_back(nose(m.point(y0, x0), m.point(-k, x1), corner_hole, m.long_rail()));
  out.holes.push_back({corner_hole, jaws.corner.radius, m.corner()});

  const Number fs = radians(Number(jaws.side.angle));
  const Number js = jaws.side.jaw_radius;
  const Number b = (m.length - Number(jaws.side.width)) / 2;
  const Number s = b - js / tan(radians((90 + Number(jaws.side.angle)) / 2));
  const Vec2<Number> side_hole = m.point(-Number(jaws.side.depth), m.length / 2);
  out.arcs.push_back({m.point(-js, s), js, m.long_rail()});
  out.noses.push_back(nose(m.point(-(b - s) * cos(fs), b + (b - s) * sin(fs)),
                           m.point(-k, b + k * tan(fs)), side_hole, m.long_rail()));
  if (!m.quarter.foot) {
    out.holes.push_back({side_hole, jaws.side.radius, m.side()});
  }
  add_straight_rails(out, m, r, m.length / 2 - s);
}

}  // namespace

ReferenceTable reference_table(const Table& table, const Number& ball_radius) {
  ReferenceTable out;
  for (const Quarter& quarter : quarters) {
    const Mirror m{table.width, table.length, quarter};
    if (const auto* jaws = std::get_if<Jaws>(&table.pockets)) {
      add_jaws(out, m, *jaws);
      continue;
    }
    add_straight_rails(out, m, 0, 0);
    if (const auto* mouth = std::get_if<MouthLines>(&table.pockets)) {
      // x + y = corner / sqrt(2) + R at the origin; the normal is left at length sqrt(2).
      const Vec2<Number> inward{quarter.right ? -1 : 1, quarter.foot ? -1 : 1};
      const Number reach = Number(mouth->corner) / sqrt(Number(2)) + ball_radius;
      out.mouths.push_back({inward, dot(inward, m.point(0, 0)) + reach, m.corner()});
    }
  }
  if (const auto* mouth = std::get_if<MouthLines>(&table.pockets)) {
    const Number middle = Number(table.length) / 2;
    out.side_mouths.push_back({middle - Number(mouth->side) / 2, middle + Number(mouth->side) / 2});
  }
  return out;
}

}  // namespace poolhall::physics::reference
