// Pockets with jaws and holes: when does a ball meet a rail, a jaw's arc or facing, or drop?
// Detects, never changes anything. An arc is met like a fixed ball of the jaw's radius.
//
//   const JawTable<double> jaws(table, radius);
//   BoundaryHit<double> hit = jaws.first_hit(segment, across, along, T, solver);
#pragma once

#include "physics/boundary.hpp"
#include "physics/contact_search.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::physics {

template <class Real>
class JawTable {
 public:
  JawTable() = default;
  JawTable(const Table& table, double radius)
      : geometry_(table_geometry<Real>(table, radius)), radius_(radius) {
    for (const JawArc<Real>& arc : geometry_.arcs) {
      include(arc.pocket, arc.centre, Real(arc.radius + radius_));
    }
    for (const Hole<Real>& hole : geometry_.holes) {
      include(hole.pocket, hole.centre, hole.radius);
    }
  }

  // The first surface or hole that the ball meets within T seconds of its segment, whose path's
  // bounding box is given. Rails and pockets that the box does not reach cost a few comparisons.
  [[nodiscard]] BoundaryHit<Real> first_hit(const Segment<Real>& s, const Span<Real>& across,
                                            const Span<Real>& along, const Real& T,
                                            RootSolver solver) const {
    BoundaryHit<Real> best;
    best.t = T;
    for (const Hole<Real>& hole : geometry_.holes) {
      const Zone& zone = zones_[static_cast<std::size_t>(hole.pocket)];
      if (zone.across.low <= across.high && across.low <= zone.across.high &&
          zone.along.low <= along.high && along.low <= zone.along.high) {
        meet_pocket(s, hole, solver, best);
      }
    }
    for (const StraightRail<Real>& rail : geometry_.rails) {
      const Span<Real>& reach = rail.axis == Axis::x ? across : along;
      const bool near =
          rail.side > Real(0) ? reach.high >= rail.centre_line : reach.low <= rail.centre_line;
      if (near) {
        meet_rail(s, rail, best);
      }
    }
    return best;
  }

  // A hit that a search in another precision found, in this one: see boundary.hpp.
  template <class Other>
  [[nodiscard]] BoundaryHit<Real> refined_hit(const BoundaryHit<Other>& hit,
                                              const Segment<Real>& s) const {
    BoundaryHit<Real> out{Real(hit.t), hit.kind, hit.rail, hit.pocket, {}, hit.surface, hit.index};
    const Vec2<Real> at = position_at(s, out.t);
    const Vec2<Real> v = velocity_at(s, out.t);
    if (hit.surface == Surface::facing) {
      const Facing<Real>& facing = geometry_.facings[hit.index];
      out.into = facing.into;
      if (hit.t != Other(0)) {
        out.t = nearer_root(out.t, Real(dot(facing.from - at, facing.into) - radius_),
                            Real(-dot(v, facing.into)));
      }
    } else if (hit.surface == Surface::arc) {
      const JawArc<Real>& arc = geometry_.arcs[hit.index];
      const Real reach = arc.radius + radius_;
      const Vec2<Real> d = at - arc.centre;
      if (hit.t != Other(0)) {
        out.t = nearer_root(out.t, Real(dot(d, d) - reach * reach), Real(Real(2) * dot(d, v)));
      }
      const Vec2<Real> out_of_arc = position_at(s, out.t) - arc.centre;
      out.into = (Real(-1) / length(out_of_arc)) * out_of_arc;
    }
    return out;
  }

  // Whether a ball may lie with its centre there, but for `slack`.
  [[nodiscard]] bool has_room(const Vec2<Real>& p, const Real& slack) const {
    bool in_zone = false;
    for (const Zone& zone : zones_) {
      in_zone = in_zone || (zone.across.low <= p.x && p.x <= zone.across.high &&
                            zone.along.low <= p.y && p.y <= zone.along.high);
    }
    const Real low = radius_ - slack;
    const bool inside =
        p.x >= low && p.x <= geometry_.width - low && p.y >= low && p.y <= geometry_.length - low;
    return (inside || in_zone) && clear_of_rails(p, slack) && clear_of_jaws(p, slack);
  }

 private:
  struct Zone {
    Span<Real> across{forever<Real>(), -forever<Real>()};
    Span<Real> along{forever<Real>(), -forever<Real>()};
  };

  void include(PocketId pocket, const Vec2<Real>& centre, const Real& reach) {
    Zone& zone = zones_[static_cast<std::size_t>(pocket)];
    zone.across.low = std::min(zone.across.low, Real(centre.x - reach));
    zone.across.high = std::max(zone.across.high, Real(centre.x + reach));
    zone.along.low = std::min(zone.along.low, Real(centre.y - reach));
    zone.along.high = std::max(zone.along.high, Real(centre.y + reach));
  }

  // A fixed circle as seen from the ball.
  [[nodiscard]] static PairMotion<Real> to_circle(const Segment<Real>& s, const Vec2<Real>& centre,
                                                  const Real& reach) {
    return {centre - s.position, Real(-1) * s.velocity, Real(-1) * s.acceleration, reach * reach};
  }

  void meet_pocket(const Segment<Real>& s, const Hole<Real>& hole, RootSolver solver,
                   BoundaryHit<Real>& best) const {
    const auto drop = first_contact(to_circle(s, hole.centre, hole.radius), best.t, solver);
    if (drop) {
      keep_earlier(best, {*drop, HitKind::pocket, {}, hole.pocket, {}, Surface::hole});
    }
    for (std::uint8_t i = 0; i < geometry_.arcs.size; ++i) {
      if (geometry_.arcs[i].pocket == hole.pocket) {
        meet_arc(s, i, solver, best);
      }
    }
    for (std::uint8_t i = 0; i < geometry_.facings.size; ++i) {
      if (geometry_.facings[i].pocket == hole.pocket) {
        meet_facing(s, i, best);
      }
    }
  }

  void meet_arc(const Segment<Real>& s, std::uint8_t index, RootSolver solver,
                BoundaryHit<Real>& best) const {
    const JawArc<Real>& arc = geometry_.arcs[index];
    const auto t =
        first_contact(to_circle(s, arc.centre, Real(arc.radius + radius_)), best.t, solver);
    if (!t) {
      return;
    }
    const Vec2<Real> out = position_at(s, *t) - arc.centre;
    const Vec2<Real> into = (Real(-1) / length(out)) * out;
    if (is_between(arc, out) && !passes_seam(arc, out, velocity_at(s, *t))) {
      keep_earlier(best, {*t, HitKind::rail, arc.rail, {}, into, Surface::arc, index});
    }
  }

  void meet_facing(const Segment<Real>& s, std::uint8_t index, BoundaryHit<Real>& best) const {
    const Facing<Real>& facing = geometry_.facings[index];
    const Real t = first_closing(Real(dot(facing.from - s.position, facing.into) - radius_),
                                 Real(-dot(s.velocity, facing.into)),
                                 Real(-dot(s.acceleration, facing.into)), forever<Real>());
    if (t > best.t) {
      return;
    }
    const Real way = dot(position_at(s, t) - facing.from, facing.along);
    if (way >= Real(0) && way <= facing.length) {
      keep_earlier(best, {t, HitKind::rail, facing.rail, {}, facing.into, Surface::facing, index});
    }
  }

  void meet_rail(const Segment<Real>& s, const StraightRail<Real>& rail,
                 BoundaryHit<Real>& best) const {
    const bool is_x = rail.axis == Axis::x;
    const Real at = is_x ? s.position.x : s.position.y;
    const Real v = is_x ? s.velocity.x : s.velocity.y;
    const Real a = is_x ? s.acceleration.x : s.acceleration.y;
    // From the nose: see boundary.hpp.
    const Real gap = rail.side * (rail.nose_line - at) - radius_;
    const Real t = first_closing(gap, Real(-rail.side * v), Real(-rail.side * a), forever<Real>());
    if (t > best.t) {
      return;
    }
    const Vec2<Real> there = position_at(s, t);
    const Real way = is_x ? there.y : there.x;
    if (way >= rail.begin && way <= rail.end) {
      keep_earlier(best, {t, HitKind::rail, rail.rail, {}, rail.into, Surface::line});
    }
  }

  // Whether the direction from the arc's centre lies between its ends. The tangent surfaces take
  // over there, so that the last bits do not matter; a ball must not slip between the two.
  [[nodiscard]] static bool is_between(const JawArc<Real>& arc, const Vec2<Real>& out) {
    const Real slack = Real(1e-9) * (arc.radius + length(out));
    return arc.first.x * out.y - arc.first.y * out.x >= -slack &&
           out.x * arc.last.y - out.y * arc.last.x >= -slack;
  }

  // Whether a ball runs over an end of the arc along the tangent that is the rail or facing there:
  // a ball frozen to a rail touches its arc at that one place and does not meet it. What rounding
  // of an ulp of the table's length can make a contact of counts as that.
  [[nodiscard]] static bool passes_seam(const JawArc<Real>& arc, const Vec2<Real>& out,
                                        const Vec2<Real>& v) {
    const Real bound = Real(2e-7);
    const Real size = length(out);
    const auto is_at = [&](const Vec2<Real>& end) {
      const Real aside = end.x * out.y - end.y * out.x;
      return aside < bound * size && -aside < bound * size;
    };
    return -dot(v, out) <= bound * length(v) * size && (is_at(arc.first) || is_at(arc.last));
  }

  [[nodiscard]] bool clear_of_rails(const Vec2<Real>& p, const Real& slack) const {
    for (const StraightRail<Real>& rail : geometry_.rails) {
      const Real at = rail.axis == Axis::x ? p.x : p.y;
      const Real way = rail.axis == Axis::x ? p.y : p.x;
      if (way >= rail.begin && way <= rail.end && rail.side * (rail.centre_line - at) < -slack) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool clear_of_jaws(const Vec2<Real>& p, const Real& slack) const {
    for (const JawArc<Real>& arc : geometry_.arcs) {
      const Vec2<Real> out = p - arc.centre;
      if (length(out) < arc.radius + radius_ - slack && is_between(arc, out)) {
        return false;
      }
    }
    for (const Facing<Real>& facing : geometry_.facings) {
      const Real way = dot(p - facing.from, facing.along);
      const Real gap = dot(facing.from - p, facing.into) - radius_;
      if (way >= Real(0) && way <= facing.length && gap < -slack && gap > -Real(4) * radius_) {
        return false;
      }
    }
    for (const Hole<Real>& hole : geometry_.holes) {
      if (length(p - hole.centre) < hole.radius - slack) {
        return false;
      }
    }
    return true;
  }

  TableGeometry<Real> geometry_{};
  Real radius_{};
  std::array<Zone, pocket_count> zones_{};
};

}  // namespace poolhall::physics
