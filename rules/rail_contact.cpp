#include "rules/rail_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace poolhall::rules {
namespace {

using physics::RailId;
using physics::Vec2;

// From a point to the part of the nose line that is the rail.
double distance_to(const physics::StraightRail<double>& rail, const Vec2<double>& p) {
  const bool across = rail.axis == physics::Axis::x;
  const double depth = rail.side * (rail.nose_line - (across ? p.x : p.y));
  const double along = across ? p.y : p.x;
  const double beyond = along - std::clamp(along, rail.begin, rail.end);
  return beyond == 0 ? depth : std::sqrt(depth * depth + beyond * beyond);
}

double distance_to(const physics::Facing<double>& facing, const Vec2<double>& p) {
  const double along = std::clamp(dot(p - facing.from, facing.along), 0.0, facing.length);
  return length(p - (facing.from + along * facing.along));
}

bool faces(const physics::JawArc<double>& arc, const Vec2<double>& p) {
  const Vec2<double> d = p - arc.centre;
  return arc.first.x * d.y - arc.first.y * d.x >= 0 && d.x * arc.last.y - d.y * arc.last.x >= 0;
}

}  // namespace

double RailDistances::gap(RailId rail, const Vec2<double>& position) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& straight : geometry_.rails) {
    if (straight.rail == rail) {
      nearest = std::min(nearest, distance_to(straight, position));
    }
  }
  for (const auto& arc : geometry_.arcs) {
    if (arc.rail == rail && faces(arc, position)) {
      nearest = std::min(nearest, length(position - arc.centre) - arc.radius);
    }
  }
  for (const auto& facing : geometry_.facings) {
    if (facing.rail == rail) {
      nearest = std::min(nearest, distance_to(facing, position));
    }
  }
  return nearest - geometry_.ball_radius;
}

std::vector<RailId> RailDistances::frozen(const Vec2<double>& position) const {
  std::vector<RailId> rails;
  for (const RailId rail : {RailId::head, RailId::head_left, RailId::head_right, RailId::foot_left,
                            RailId::foot_right, RailId::foot}) {
    if (gap(rail, position) <= frozen_gap) {
      rails.push_back(rail);
    }
  }
  return rails;
}

bool RailDistances::comes_away(RailId rail, const PathPiece& piece) const {
  const auto away_at = [&](double t) { return gap(rail, position_at(piece, t)) >= away_gap; };
  if (away_at(0) || away_at(piece.duration)) {
    return true;
  }
  // A ball that leaves and comes back within one piece is farthest where its speed across the
  // straight rail is zero; round a jaw it is looked for in steps.
  for (const Vec2<double>& across : {Vec2<double>{1, 0}, Vec2<double>{0, 1}}) {
    const double t = -dot(across, piece.velocity) / dot(across, piece.acceleration);
    if (t > 0 && t < piece.duration && away_at(t)) {
      return true;
    }
  }
  constexpr int steps = 32;
  for (int k = 1; k < steps; ++k) {
    if (away_at(piece.duration * k / steps)) {
      return true;
    }
  }
  return false;
}

}  // namespace poolhall::rules
