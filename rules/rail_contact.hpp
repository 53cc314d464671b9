// Balls and rails: how far a ball is from a rail, its jaws included, and which rails it is frozen
// to at the start of a shot.
//
//   const RailDistances rails(table, materials);
//   for (RailId rail : rails.frozen(place.position)) ...
#pragma once

#include <vector>

#include "physics/ball.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "physics/table_geometry.hpp"
#include "rules/ball_path.hpp"

namespace poolhall::rules {

// A gap of at most this is frozen, m; the last digits are for rounding.
inline constexpr double frozen_gap = 1e-6 + 1e-12;
// A ball frozen to a rail counts there again after it has been so far away, m.
inline constexpr double away_gap = 1e-3 - 1e-12;

class RailDistances {
 public:
  // `table` must be possible (physics::check_scene).
  RailDistances(const physics::Table& table, const physics::Materials& materials)
      : geometry_(physics::table_geometry<double>(table, materials.ball_radius)) {}

  // m, between the surface of a ball at `position` and the cushion `rail` with its jaws.
  [[nodiscard]] double gap(physics::RailId rail, const physics::Vec2<double>& position) const;

  // Rails that a ball at `position` is frozen to.
  [[nodiscard]] std::vector<physics::RailId> frozen(const physics::Vec2<double>& position) const;

  // Whether the ball comes away from `rail` by `away_gap` on this piece of its path.
  [[nodiscard]] bool comes_away(physics::RailId rail, const PathPiece& piece) const;

 private:
  physics::TableGeometry<double> geometry_;
};

}  // namespace poolhall::rules
