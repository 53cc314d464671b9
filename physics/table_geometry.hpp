// The lines and circles at which something happens to a ball of a given radius: flat arrays of
// fixed size, made once from a Table.
//
//   const TableGeometry<double> geometry = table_geometry<double>(table, materials.ball_radius);
//   for (const StraightRail<double>& rail : geometry.rails) ...
//
// A table without pockets has its six straight rails and nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "physics/math.hpp"
#include "physics/table.hpp"
#include "physics/vector.hpp"

namespace poolhall::physics {

// The first `size` places of an array.
template <class T, std::size_t capacity>
struct FixedList {
  std::array<T, capacity> items{};
  std::size_t size = 0;

  constexpr void push(const T& item) { items[size++] = item; }
  [[nodiscard]] constexpr const T* begin() const { return items.data(); }
  [[nodiscard]] constexpr const T* end() const { return items.data() + size; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return items[i]; }
  [[nodiscard]] constexpr bool empty() const { return size == 0; }
};

// The coordinate that is constant along a rail: x for the long rails, y for head and foot.
enum class Axis : std::uint8_t { x, y };

// A ball touches the rail when its centre is on the line `axis` = `centre_line`, one ball radius
// inside the nose line, while the other coordinate is in [begin, end].
template <class Real>
struct StraightRail {
  RailId rail{};
  Axis axis = Axis::x;
  Real side{};         // +1 or -1: the cushion lies towards greater or smaller coordinates
  Real nose_line{};    // m
  Real centre_line{};  // m, nose_line - side R
  Real begin{};        // m
  Real end{};          // m
  Vec2<Real> into{};   // unit vector into the cushion
};

// A ball is pocketed when its centre reaches the segment from the inside.
template <class Real>
struct MouthLine {
  PocketId pocket{};
  Vec2<Real> from{};
  Vec2<Real> to{};
  Vec2<Real> outward{};  // unit normal, out of the table
  Real offset{};         // dot(point of the line, outward)
};

// Met like a fixed ball of radius `radius`, where the direction from `centre` to the ball's
// centre is between `first` and `last`, counter-clockwise, less than half a turn.
template <class Real>
struct JawArc {
  PocketId pocket{};
  RailId rail{};  // the cushion that it ends
  Vec2<Real> centre{};
  Real radius{};
  Vec2<Real> first{};  // unit vector
  Vec2<Real> last{};   // unit vector
};

// A straight piece of cushion between a jaw's arc and the pocket: met when the centre is one
// ball radius inside the segment.
template <class Real>
struct Facing {
  PocketId pocket{};
  RailId rail{};
  Vec2<Real> from{};   // at the arc
  Vec2<Real> to{};     // at the back of the cushion
  Vec2<Real> into{};   // unit vector into the cushion
  Vec2<Real> along{};  // unit vector from `from` to `to`
  Real length{};       // m
};

// A ball is pocketed when its centre crosses the circle inwards.
template <class Real>
struct Hole {
  PocketId pocket{};
  Vec2<Real> centre{};
  Real radius{};
};

template <class Real>
struct TableGeometry {
  Real width{};
  Real length{};
  Real ball_radius{};
  Real head_string{};  // the kitchen is y < head_string
  FixedList<StraightRail<Real>, rail_count> rails{};
  FixedList<MouthLine<Real>, pocket_count> mouths{};
  FixedList<JawArc<Real>, 2 * pocket_count> arcs{};
  FixedList<Facing<Real>, 2 * pocket_count> facings{};
  FixedList<Hole<Real>, pocket_count> holes{};
};

// `table` must have passed check_table.
template <class Real>
[[nodiscard]] TableGeometry<Real> table_geometry(const Table& table, double ball_radius);

}  // namespace poolhall::physics

#include "physics/table_geometry_impl.hpp"
