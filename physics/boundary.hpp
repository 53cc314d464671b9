// Where the centre of a ball may be: the rectangle one radius inside the noses, with the corners
// cut off along the mouth lines where there are pockets. Detects, never changes anything.
//
//   const auto bounds = boundary<double>(table, radius);
//   BoundaryHit<double> hit = first_hit(bounds, segment, across, along, segment.duration);
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "physics/motion.hpp"
#include "physics/roots.hpp"
#include "physics/table.hpp"

namespace poolhall::physics {

template <class Real>
struct Boundary {
  Vec2<Real> low{};  // the centre's extremes
  Vec2<Real> high{};
  Vec2<Real> size{};  // width and length of the table
  Real middle{};      // y where the long rails part
  bool has_mouths = false;
  Real corner_line{};  // x + y of the head-left mouth line, and so for its mirror images
  Real corner_end{};   // where that line meets the rails: corner / sqrt(2)
  Real side_half{};    // half the width of a side mouth
};

template <class Real>
[[nodiscard]] Boundary<Real> boundary(const Table& table, const Real& radius) {
  using std::sqrt;
  Boundary<Real> b;
  b.size = {Real(table.width), Real(table.length)};
  b.low = {radius, radius};
  b.high = b.size - b.low;
  b.middle = b.size.y / Real(2);
  if (const auto* mouths = std::get_if<MouthLines>(&table.pockets)) {
    b.has_mouths = true;
    b.corner_end = Real(mouths->corner) / sqrt(Real(2));
    b.corner_line = b.corner_end + radius;
    b.side_half = Real(mouths->side) / Real(2);
  }
  return b;
}

enum class HitKind : std::uint8_t { none, pocket, rail };

// What was met: a line of the frame (rail or mouth), a jaw's facing or arc, a hole's circle.
enum class Surface : std::uint8_t { line, facing, arc, hole };

template <class Real>
struct BoundaryHit {
  Real t{};  // s after the segment's start
  HitKind kind = HitKind::none;
  RailId rail{};
  PocketId pocket{};
  Vec2<Real> into{};  // unit vector into the cushion
  Surface surface = Surface::line;
  std::uint8_t index = 0;  // of the facing or arc
};

// Whether `y` lies between the ends of a side mouth, ends included.
template <class Real>
[[nodiscard]] bool in_side_mouth(const Boundary<Real>& b, const Real& y) {
  const Real off = y - b.middle;
  return b.has_mouths && off <= b.side_half && -off <= b.side_half;
}

// Keeps the earlier hit; at one instant a pocket comes before a rail, then the lower id.
template <class Real>
void keep_earlier(BoundaryHit<Real>& best, const BoundaryHit<Real>& hit) {
  if (hit.t < best.t || (hit.t == best.t && hit.kind < best.kind)) {
    best = hit;
  }
}

// The smallest and largest coordinate of x0 + v t + a t^2 / 2 on [0, T].
template <class Real>
struct Span {
  Real low{};
  Real high{};
};
template <class Real>
[[nodiscard]] Span<Real> span(const Real& x, const Real& v, const Real& a, const Real& T) {
  const Real end = x + T * (v + T / Real(2) * a);
  Span<Real> s = x < end ? Span<Real>{x, end} : Span<Real>{end, x};
  if ((v > Real(0)) != (v + T * a > Real(0)) && a != Real(0)) {
    const Real apex = x - v * v / (Real(2) * a);
    s.low = apex < s.low ? apex : s.low;
    s.high = apex > s.high ? apex : s.high;
  }
  return s;
}

// A long rail or the side mouth in it. `gap`, `v`, `a`: the ball's way to it, shrinking.
template <class Real>
void hit_long_side(const Boundary<Real>& b, const Segment<Real>& s, bool left, const Real& gap,
                   BoundaryHit<Real>& best) {
  const Real v = left ? s.velocity.x : Real(-s.velocity.x);
  const Real a = left ? s.acceleration.x : Real(-s.acceleration.x);
  const PocketId pocket = left ? PocketId::side_left : PocketId::side_right;
  if (b.has_mouths && gap <= Real(0) && v == Real(0) && a == Real(0)) {
    // Along the nose line into the mouth's end: pocketed there.
    const bool below = s.position.y < b.middle;
    const Real way =
        (below ? Real(b.middle - s.position.y) : Real(s.position.y - b.middle)) - b.side_half;
    if (way > Real(0)) {
      const Real t =
          first_closing(way, below ? Real(-s.velocity.y) : s.velocity.y,
                        below ? Real(-s.acceleration.y) : s.acceleration.y, forever<Real>());
      keep_earlier(best, {t, HitKind::pocket, {}, pocket, {}, Surface::line});
    }
    return;
  }
  const Real t = first_closing(gap, v, a, forever<Real>());
  if (t > best.t) {
    return;
  }
  const Real y = position_at(s, t).y;
  if (in_side_mouth(b, y)) {
    keep_earlier(best, {t, HitKind::pocket, {}, pocket, {}, Surface::line});
    return;
  }
  const bool head = y < b.middle;
  const RailId rail = left ? (head ? RailId::head_left : RailId::foot_left)
                           : (head ? RailId::head_right : RailId::foot_right);
  keep_earlier(best, {t, HitKind::rail, rail, {}, {Real(left ? -1 : 1), Real(0)}, Surface::line});
}

// A head or foot rail; the corners' mouth lines have been asked before.
template <class Real>
void hit_short_side(const Segment<Real>& s, bool head, const Real& gap, BoundaryHit<Real>& best) {
  const Real v = head ? s.velocity.y : Real(-s.velocity.y);
  const Real a = head ? s.acceleration.y : Real(-s.acceleration.y);
  keep_earlier(best, {first_closing(gap, v, a, forever<Real>()),
                      HitKind::rail,
                      head ? RailId::head : RailId::foot,
                      {},
                      {Real(0), Real(head ? -1 : 1)},
                      Surface::line});
}

// The mouth line of the corner at the low or high end of either axis.
template <class Real>
void hit_corner(const Boundary<Real>& b, const Segment<Real>& s, bool left, bool head,
                BoundaryHit<Real>& best) {
  const auto inwards_x = [left](const Real& x) { return left ? x : Real(-x); };
  const auto inwards_y = [head](const Real& y) { return head ? y : Real(-y); };
  const Real x = left ? s.position.x : Real(b.size.x - s.position.x);
  const Real y = head ? s.position.y : Real(b.size.y - s.position.y);
  const Real t = first_closing(
      Real(x + y - b.corner_line), Real(inwards_x(s.velocity.x) + inwards_y(s.velocity.y)),
      Real(inwards_x(s.acceleration.x) + inwards_y(s.acceleration.y)), forever<Real>());
  const PocketId pocket = head ? (left ? PocketId::head_left : PocketId::head_right)
                               : (left ? PocketId::foot_left : PocketId::foot_right);
  keep_earlier(best, {t, HitKind::pocket, {}, pocket, {}, Surface::line});
}

// Gaps to the far sides are taken from the noses: near them both differences are exact, and a ball
// that lies an ulp off the rail is not taken to touch it, as it would be by the rounded `high`.
//
// The first rail or mouth that the ball meets within T seconds of its segment. Sides that its
// path's bounding box does not reach cost one comparison.
template <class Real>
[[nodiscard]] BoundaryHit<Real> first_hit(const Boundary<Real>& b, const Segment<Real>& s,
                                          const Span<Real>& x, const Span<Real>& y, const Real& T) {
  BoundaryHit<Real> best;
  best.t = T;
  const bool left = x.low <= b.low.x, right = x.high >= b.high.x;
  const bool head = y.low <= b.low.y, foot = y.high >= b.high.y;
  if (b.has_mouths) {
    const Real reach = b.corner_line;
    const bool far_right = x.high >= b.size.x - reach, far_foot = y.high >= b.size.y - reach;
    if (x.low <= reach && y.low <= reach)
      hit_corner(b, s, true, true, best);
    if (far_right && y.low <= reach)
      hit_corner(b, s, false, true, best);
    if (x.low <= reach && far_foot)
      hit_corner(b, s, true, false, best);
    if (far_right && far_foot)
      hit_corner(b, s, false, false, best);
  }
  if (head)
    hit_short_side(s, true, Real(s.position.y - b.low.y), best);
  if (left)
    hit_long_side(b, s, true, Real(s.position.x - b.low.x), best);
  if (right)
    hit_long_side(b, s, false, Real((b.size.x - s.position.x) - b.low.x), best);
  if (foot)
    hit_short_side(s, false, Real((b.size.y - s.position.y) - b.low.y), best);
  return best;
}

// Puts the ball's centre exactly on the line where it touches the rail.
template <class Real>
void put_on_rail(Ball<Real>& ball, const Boundary<Real>& b, RailId rail) {
  switch (rail) {
    case RailId::head:
      ball.position.y = b.low.y;
      break;
    case RailId::foot:
      ball.position.y = b.high.y;
      break;
    case RailId::head_left:
    case RailId::foot_left:
      ball.position.x = b.low.x;
      break;
    case RailId::head_right:
    case RailId::foot_right:
      ball.position.x = b.high.x;
      break;
  }
}

// A rail's hit in the precision of `s`: one step of Newton's, which the search has left nothing but
// rounding to do. Mouths keep their time: the ball is gone.
template <class Exact, class Real>
[[nodiscard]] BoundaryHit<Exact> refined_hit(const Boundary<Exact>& b, const BoundaryHit<Real>& hit,
                                             const Segment<Exact>& s) {
  BoundaryHit<Exact> out{
      Exact(hit.t), hit.kind, hit.rail, hit.pocket, {Exact(hit.into.x), Exact(hit.into.y)},
      hit.surface,  hit.index};
  if (hit.kind != HitKind::rail || hit.t == Real(0)) {
    return out;
  }
  const bool is_x = hit.into.x != Real(0);
  const Exact line = is_x ? (hit.into.x < Real(0) ? b.low.x : b.high.x)
                          : (hit.into.y < Real(0) ? b.low.y : b.high.y);
  const Vec2<Exact> at = position_at(s, out.t);
  const Vec2<Exact> v = velocity_at(s, out.t);
  out.t = nearer_root(out.t, Exact((is_x ? at.x : at.y) - line), is_x ? v.x : v.y);
  return out;
}

}  // namespace poolhall::physics
