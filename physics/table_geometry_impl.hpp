// Definitions of table_geometry.hpp; include that instead.
#pragma once

#include <array>
#include <utility>
#include <variant>

#include "physics/table_geometry.hpp"

namespace poolhall::physics::geometry_detail {

// Carries what is said of a pocket at the lower left to its mirror images.
template <class Real>
struct Mirror {
  Real width{};
  Real length{};
  bool swaps_axes = false;  // across the diagonal x = y, before the flips
  bool flips_x = false;
  bool flips_y = false;

  [[nodiscard]] Vec2<Real> point(const Vec2<Real>& p) const {
    const Vec2<Real> q = swaps_axes ? Vec2<Real>{p.y, p.x} : p;
    return {flips_x ? Real(width - q.x) : q.x, flips_y ? Real(length - q.y) : q.y};
  }
  [[nodiscard]] Vec2<Real> direction(const Vec2<Real>& p) const {
    const Vec2<Real> q = swaps_axes ? Vec2<Real>{p.y, p.x} : p;
    return {flips_x ? Real(-q.x) : q.x, flips_y ? Real(-q.y) : q.y};
  }
  [[nodiscard]] bool reverses_orientation() const { return (swaps_axes != flips_x) != flips_y; }
};

// How far the straight rails are cut back from the corners and from length / 2.
template <class Real>
struct RailEnds {
  Real corner{};      // from the corner of the nose lines
  Real side_begin{};  // y at which the long rails' head halves end
};

// One jaw: the arc and the facing that end one rail at one pocket.
template <class Real>
struct Jaw {
  Real rail_end{};
  JawArc<Real> arc{};
  Facing<Real> facing{};
};

template <class Real>
[[nodiscard]] Real tangent_of_degrees(const Real& degrees) {
  const Direction<Real> d = direction_of_degrees(degrees);
  return d.sine / d.cosine;
}

template <class Real>
void finish_facing(Facing<Real>& facing) {
  const Vec2<Real> span = facing.to - facing.from;
  facing.length = square_root(dot(span, span));
  facing.along = (Real(1) / facing.length) * span;
}

// The jaw of the head rail at the corner of the origin (physics.md 6).
template <class Real>
[[nodiscard]] Jaw<Real> corner_jaw(const JawPocket& pocket, double cushion_width) {
  const Real mouth = Real(pocket.width) / square_root(Real(2));
  const Real j(pocket.jaw_radius);
  const Real k(cushion_width);
  const Real f(pocket.angle);
  const Direction<Real> turn = direction_of_degrees(Real(Real(45) + f));
  Jaw<Real> jaw;
  jaw.rail_end = mouth + j / tangent_of_degrees(Real((Real(135) + f) / Real(2)));
  const Real reach = jaw.rail_end - mouth;
  jaw.arc.centre = {jaw.rail_end, -j};
  jaw.arc.radius = j;
  jaw.arc.first = {Real(0), Real(1)};
  jaw.arc.last = {-turn.cosine, turn.sine};
  jaw.facing.from = {mouth - reach * turn.sine, -reach * turn.cosine};
  jaw.facing.to = {mouth - k * turn.sine / turn.cosine, -k};
  jaw.facing.into = {turn.cosine, -turn.sine};
  finish_facing(jaw.facing);
  return jaw;
}

// The jaw of the left rail's head half at the side pocket.
template <class Real>
[[nodiscard]] Jaw<Real> side_jaw(const JawPocket& pocket, double cushion_width,
                                 const Real& length) {
  const Real mouth = (length - Real(pocket.width)) / Real(2);
  const Real j(pocket.jaw_radius);
  const Real k(cushion_width);
  const Real f(pocket.angle);
  const Direction<Real> turn = direction_of_degrees(f);
  Jaw<Real> jaw;
  jaw.rail_end = mouth - j / tangent_of_degrees(Real((Real(90) + f) / Real(2)));
  const Real reach = mouth - jaw.rail_end;
  jaw.arc.centre = {-j, jaw.rail_end};
  jaw.arc.radius = j;
  jaw.arc.first = {Real(1), Real(0)};
  jaw.arc.last = {turn.sine, turn.cosine};
  jaw.facing.from = {-reach * turn.cosine, mouth + reach * turn.sine};
  jaw.facing.to = {-k, mouth + k * turn.sine / turn.cosine};
  jaw.facing.into = {-turn.sine, -turn.cosine};
  finish_facing(jaw.facing);
  return jaw;
}

template <class Real>
void add_jaw(TableGeometry<Real>& geometry, const Jaw<Real>& jaw, const Mirror<Real>& mirror,
             PocketId pocket, RailId rail) {
  JawArc<Real> arc{pocket,
                   rail,
                   mirror.point(jaw.arc.centre),
                   jaw.arc.radius,
                   mirror.direction(jaw.arc.first),
                   mirror.direction(jaw.arc.last)};
  if (mirror.reverses_orientation())
    std::swap(arc.first, arc.last);
  geometry.arcs.push(arc);
  geometry.facings.push({pocket, rail, mirror.point(jaw.facing.from), mirror.point(jaw.facing.to),
                         mirror.direction(jaw.facing.into), mirror.direction(jaw.facing.along),
                         jaw.facing.length});
}

// The corners and sides as mirror images of head_left and of the head half of side_left.
struct CornerPlace {
  PocketId pocket;
  bool flips_x;
  bool flips_y;
  RailId short_rail;
  RailId long_rail;
};
inline constexpr std::array<CornerPlace, 4> corner_places{{
    {PocketId::head_left, false, false, RailId::head, RailId::head_left},
    {PocketId::head_right, true, false, RailId::head, RailId::head_right},
    {PocketId::foot_left, false, true, RailId::foot, RailId::foot_left},
    {PocketId::foot_right, true, true, RailId::foot, RailId::foot_right},
}};
struct SidePlace {
  PocketId pocket;
  bool flips_x;
  RailId head_rail;
  RailId foot_rail;
};
inline constexpr std::array<SidePlace, 2> side_places{{
    {PocketId::side_left, false, RailId::head_left, RailId::foot_left},
    {PocketId::side_right, true, RailId::head_right, RailId::foot_right},
}};

template <class Real>
[[nodiscard]] RailEnds<Real> add_pockets(TableGeometry<Real>& geometry, const NoPockets&) {
  return {Real(0), geometry.length / Real(2)};
}

template <class Real>
[[nodiscard]] RailEnds<Real> add_pockets(TableGeometry<Real>& geometry, const MouthLines& mouths) {
  const Real& width = geometry.width;
  const Real& length = geometry.length;
  const Real& radius = geometry.ball_radius;
  const Real half_root = square_root(Real(Real(1) / Real(2)));
  const Real corner = Real(mouths.corner) * half_root;
  const Real side_begin = (length - Real(mouths.side)) / Real(2);
  const auto add = [&](PocketId pocket, Vec2<Real> from, Vec2<Real> to, Vec2<Real> outward) {
    geometry.mouths.push({pocket, from, to, outward, dot(from, outward)});
  };
  for (const CornerPlace& place : corner_places) {
    const Mirror<Real> mirror{width, length, false, place.flips_x, place.flips_y};
    add(place.pocket, mirror.point({radius, corner}), mirror.point({corner, radius}),
        mirror.direction({-half_root, -half_root}));
  }
  for (const SidePlace& place : side_places) {
    const Mirror<Real> mirror{width, length, false, place.flips_x, false};
    add(place.pocket, mirror.point({radius, side_begin}),
        mirror.point({radius, length - side_begin}), mirror.direction({Real(-1), Real(0)}));
  }
  return {corner, side_begin};
}

template <class Real>
[[nodiscard]] RailEnds<Real> add_pockets(TableGeometry<Real>& geometry, const Jaws& jaws) {
  const Real& width = geometry.width;
  const Real& length = geometry.length;
  const Jaw<Real> corner = corner_jaw<Real>(jaws.corner, jaws.cushion_width);
  const Real corner_hole = -Real(jaws.corner.depth) / square_root(Real(2));
  for (const CornerPlace& place : corner_places) {
    const Mirror<Real> plain{width, length, false, place.flips_x, place.flips_y};
    const Mirror<Real> across{width, length, true, place.flips_x, place.flips_y};
    add_jaw(geometry, corner, plain, place.pocket, place.short_rail);
    add_jaw(geometry, corner, across, place.pocket, place.long_rail);
    geometry.holes.push(
        {place.pocket, plain.point({corner_hole, corner_hole}), Real(jaws.corner.radius)});
  }
  const Jaw<Real> side = side_jaw<Real>(jaws.side, jaws.cushion_width, length);
  for (const SidePlace& place : side_places) {
    const Mirror<Real> head{width, length, false, place.flips_x, false};
    const Mirror<Real> foot{width, length, false, place.flips_x, true};
    add_jaw(geometry, side, head, place.pocket, place.head_rail);
    add_jaw(geometry, side, foot, place.pocket, place.foot_rail);
    geometry.holes.push({place.pocket, head.point({-Real(jaws.side.depth), length / Real(2)}),
                         Real(jaws.side.radius)});
  }
  return {corner.rail_end, side.rail_end};
}

template <class Real>
void add_rails(TableGeometry<Real>& geometry, const RailEnds<Real>& ends) {
  const Real& width = geometry.width;
  const Real& length = geometry.length;
  const auto add = [&](RailId rail, Axis axis, int side, Real nose, Real begin, Real end) {
    const Real sign(side);
    const Vec2<Real> into = axis == Axis::x ? Vec2<Real>{sign, Real(0)} : Vec2<Real>{Real(0), sign};
    geometry.rails.push(
        {rail, axis, sign, nose, nose - sign * geometry.ball_radius, begin, end, into});
  };
  const Real side_end = length - ends.side_begin;
  const Real foot_end = length - ends.corner;
  add(RailId::head, Axis::y, -1, Real(0), ends.corner, width - ends.corner);
  add(RailId::head_left, Axis::x, -1, Real(0), ends.corner, ends.side_begin);
  add(RailId::head_right, Axis::x, 1, width, ends.corner, ends.side_begin);
  add(RailId::foot_left, Axis::x, -1, Real(0), side_end, foot_end);
  add(RailId::foot_right, Axis::x, 1, width, side_end, foot_end);
  add(RailId::foot, Axis::y, 1, length, ends.corner, width - ends.corner);
}

}  // namespace poolhall::physics::geometry_detail

namespace poolhall::physics {

template <class Real>
TableGeometry<Real> table_geometry(const Table& table, double ball_radius) {
  TableGeometry<Real> geometry;
  geometry.width = Real(table.width);
  geometry.length = Real(table.length);
  geometry.ball_radius = Real(ball_radius);
  geometry.head_string = Real(table.head_string);
  const geometry_detail::RailEnds<Real> ends = std::visit(
      [&](const auto& pockets) { return geometry_detail::add_pockets(geometry, pockets); },
      table.pockets);
  geometry_detail::add_rails(geometry, ends);
  return geometry;
}

}  // namespace poolhall::physics
