// Where a ball's centre is stopped by a table, in the reference's arithmetic (physics.md 6).
#pragma once

#include <vector>

#include "physics/reference/reference_number.hpp"
#include "physics/table.hpp"
#include "physics/vector.hpp"

namespace poolhall::physics::reference {

// A cushion's nose: met when the centre is one ball radius from it, its foot between the ends.
struct Nose {
  Vec2<Number> from, to;
  Vec2<Number> inward;  // unit normal, into the table
  RailId rail{};
};

// A jaw's arc: met like a fixed ball of its radius.
struct Arc {
  Vec2<Number> centre;
  Number radius;
  RailId rail;
};

// A straight pocket line of the centre: pocketed when `inward . r - offset` falls through zero
// (mouth lines at the corners).
struct MouthLine {
  Vec2<Number> inward;
  Number offset;
  PocketId pocket;
};

// A stretch of a long rail that is no rail but a mouth: along it the centre is pocketed where it
// would have met the nose line.
struct SideMouth {
  Number low, high;  // y
};

// A hole: pocketed when the centre crosses the circle inwards.
struct Hole {
  Vec2<Number> centre;
  Number radius;
  PocketId pocket;
};

struct ReferenceTable {
  std::vector<Nose> noses;
  std::vector<Arc> arcs;
  std::vector<MouthLine> mouths;
  std::vector<SideMouth> side_mouths;  // one for both long rails, or none
  std::vector<Hole> holes;
};

[[nodiscard]] ReferenceTable reference_table(const Table& table, const Number& ball_radius);

}  // namespace poolhall::physics::reference
