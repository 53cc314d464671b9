#include "physics/cue_stick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "physics/cushion_contact.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::physics {
namespace {

// Distance of a point to the solid cylinder, 0 inside.
double distance_to(const CueStick& stick, const Vec3<double>& point) {
  const Vec3<double> from_tip = point - stick.tip;
  const double along = dot(from_tip, stick.backwards);
  const Vec3<double> radial = from_tip - along * stick.backwards;
  const double beside = std::max(0.0, std::sqrt(dot(radial, radial)) - cue_stick_radius);
  const double beyond = std::max({0.0, -along, along - cue_stick_length});
  return std::sqrt(beside * beside + beyond * beyond);
}

// Widths of the gaps that the pockets leave in the nose lines: along each rail from the corner,
// and in the middle of the long rails.
struct NoseGaps {
  double corner = 0;
  double side = 0;
};

NoseGaps gaps(const NoPockets&) {
  return {};
}
NoseGaps gaps(const MouthLines& mouths) {
  return {mouths.corner / std::sqrt(2.0), mouths.side};
}
NoseGaps gaps(const Jaws& jaws) {
  return {jaws.corner.width / std::sqrt(2.0), jaws.side.width};
}

struct NoseLine {
  RailId rail;
  Axis axis;
  double nose;
  double begin;
  double end;
};

std::array<NoseLine, rail_count> nose_lines(const Table& table) {
  const NoseGaps gap = std::visit([](const auto& p) { return gaps(p); }, table.pockets);
  const double width = table.width;
  const double length = table.length;
  const double head_end = (length - gap.side) / 2;
  const double foot_begin = (length + gap.side) / 2;
  return {{{RailId::head, Axis::y, 0, gap.corner, width - gap.corner},
           {RailId::head_left, Axis::x, 0, gap.corner, head_end},
           {RailId::head_right, Axis::x, width, gap.corner, head_end},
           {RailId::foot_left, Axis::x, 0, foot_begin, length - gap.corner},
           {RailId::foot_right, Axis::x, width, foot_begin, length - gap.corner},
           {RailId::foot, Axis::y, length, gap.corner, width - gap.corner}}};
}

// Whether the axis, where it crosses the nose line in plan, passes less than a stick's radius
// above it; both are lines in space, and their distance counts.
bool passes_too_low(const CueStick& stick, const NoseLine& line, double nose_height) {
  const bool is_long = line.axis == Axis::x;
  const double across = is_long ? stick.backwards.x : stick.backwards.y;
  if (across == 0)
    return false;
  const double s = (line.nose - (is_long ? stick.tip.x : stick.tip.y)) / across;
  if (s < -touching_tolerance || s > cue_stick_length)
    return false;
  const double place =
      is_long ? stick.tip.y + s * stick.backwards.y : stick.tip.x + s * stick.backwards.x;
  if (place < line.begin || place > line.end)
    return false;
  const double above = stick.tip.z + s * stick.backwards.z - nose_height;
  const double slope = std::sqrt(across * across + stick.backwards.z * stick.backwards.z);
  return above * std::abs(across) / slope < cue_stick_radius - touching_tolerance;
}

}  // namespace

CueStick cue_stick(const CueShot<double>& shot, const Vec2<double>& ball, double ball_radius) {
  const Vec2<double> left{-shot.heading.sine, shot.heading.cosine};
  const Vec2<double> back{-shot.heading.cosine, -shot.heading.sine};
  const double c = contact_depth(shot, ball_radius);
  const Vec2<double> tip = ball + shot.a * left + c * back;
  return {{tip.x, tip.y, ball_radius + shot.b},
          {shot.elevation.cosine * back.x, shot.elevation.cosine * back.y, shot.elevation.sine}};
}

std::optional<std::string> obstacle_of(const CueStick& stick, const BallSet<double>& balls,
                                       const Table& table, const Materials& materials) {
  const double radius = materials.ball_radius;
  for (const Ball<double>& ball : balls) {
    if (ball.id == cue_ball || ball.state == MotionState::pocketed)
      continue;
    const Vec3<double> centre{ball.position.x, ball.position.y, radius};
    if (distance_to(stick, centre) < radius - touching_tolerance) {
      return "ball " + std::to_string(number(ball.id));
    }
  }
  const double height = nose_height_or_default(table, materials);
  for (const NoseLine& line : nose_lines(table)) {
    if (passes_too_low(stick, line, height))
      return "the " + std::string(name(line.rail)) + " rail";
  }
  return std::nullopt;
}

}  // namespace poolhall::physics
