// The ghost ball: which balls can be sent straight into which pockets, and how likely that is
// under noise. Geometry only; the simulator has the last word (rehearsal.hpp).
//
//   std::vector<PotLine> lines = pot_lines(layout, cue_position, targets, aim_error);
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "physics/ball.hpp"
#include "physics/materials.hpp"
#include "physics/noise.hpp"
#include "physics/table.hpp"
#include "rules/game_state.hpp"

namespace poolhall::bots {

using physics::BallId;
using physics::PocketId;
using Point = physics::Vec2<double>;

// The line that a ball's centre crosses when it is pocketed.
struct PocketTarget {
  PocketId pocket{};
  Point centre{};         // m, of that line
  Point outward{};        // unit vector, normal to it
  double half_width = 0;  // m
};

// Table and balls at rest, as far as lines of play need them.
struct Layout {
  double width = 0;   // m
  double length = 0;  // m
  double radius = 0;  // m, of the balls
  std::vector<PocketTarget> pockets;
  std::vector<physics::Ball<double>> balls;  // on the table, cue ball included
};

[[nodiscard]] std::vector<PocketTarget> pocket_targets(const physics::Table& table, double radius);
[[nodiscard]] Layout layout_of(const rules::GameState& state, const physics::Table& table,
                               const physics::Materials& materials);

struct PotLine {
  BallId ball{};
  PocketId pocket{};
  Point cue{};            // m, where the cue ball starts
  Point ghost{};          // m, where it must be at contact
  Point object{};         // m, the object ball
  Point aim{};            // unit vector from cue to ghost
  Point course{};         // unit vector from the object ball to the pocket
  double cue_run = 0;     // m, from cue to ghost
  double object_run = 0;  // m, from the object ball to the pocket
  double cos_cut = 1;
  double chance = 0;  // 0..1, estimate under the noise of the heading
};

// The line of `object` into `pocket` for the cue ball at `cue`, other balls left out; nothing where
// the ghost ball has no room or the cut or the entry is too thin. `chance` is not set. Of the
// layout only the table's measures count.
[[nodiscard]] std::optional<PotLine> line_to(const Layout& layout, Point cue,
                                             const physics::Ball<double>& object,
                                             const PocketTarget& pocket);
// Its chance where `aim_error` is the standard deviation of the heading in rad.
[[nodiscard]] double chance_of(const PotLine& line, const PocketTarget& pocket, double radius,
                               double aim_error);
// Distance of `p` from the segment from `from` to `to`.
[[nodiscard]] double distance_to_segment(Point p, Point from, Point to);

// All open lines for the cue ball at `cue`, best first. `aim_error` is the standard deviation of
// the heading in rad.
[[nodiscard]] std::vector<PotLine> pot_lines(const Layout& layout, Point cue,
                                             std::span<const BallId> targets, double aim_error);

// Whether a ball can roll from `from` to `to` past all balls but `ignored`.
[[nodiscard]] bool is_clear(const Layout& layout, Point from, Point to,
                            std::span<const BallId> ignored);

// The balls that the player to move wants to pot: those that may be called, or in nine-ball the
// lowest on the table.
[[nodiscard]] std::vector<BallId> target_balls(const rules::GameState& state);

}  // namespace poolhall::bots
