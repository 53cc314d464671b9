#include "clients/bots/pot_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "rules/referee.hpp"

namespace poolhall::bots {
namespace {

// A ball may come to a mouth at no more than about 75 degrees from its normal.
constexpr double min_cos_entry = 0.26;
// Thinner cuts than about 80 degrees are not worth a try.
constexpr double min_cos_cut = 0.17;
// What the aim misses even without noise, so that short and full shots come first.
constexpr double own_aim_error = 3e-4;  // rad

double length(Point p) {
  return std::sqrt(dot(p, p));
}

// The ends of the mouth at the lower left corner and of the left side mouth, as the ball's centre
// sees them. From these all six pockets follow by mirrors.
struct Mouths {
  double corner_near = 0;  // m: the corner line runs from (far, near) to (near, far)
  double corner_far = 0;   // m
  double corner_half = 0;  // m
  double side_x = 0;       // m
  double side_half = 0;    // m
};

Mouths mouths(const physics::MouthLines& lines, double radius) {
  const double end = lines.corner / std::numbers::sqrt2;
  return {radius, end, (end - radius) / std::numbers::sqrt2, radius, lines.side / 2};
}

Mouths mouths(const physics::Jaws& jaws, double radius) {
  // Between the noses; a ball passes where its centre keeps one radius from both.
  return {0, jaws.corner.width / std::numbers::sqrt2, jaws.corner.width / 2 - radius, 0,
          jaws.side.width / 2 - radius};
}

}  // namespace

double distance_to_segment(Point p, Point from, Point to) {
  const Point along = to - from;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - from, along) / square, 0.0, 1.0) : 0.0;
  return length(p - (from + t * along));
}

std::optional<PotLine> line_to(const Layout& layout, Point cue, const physics::Ball<double>& object,
                               const PocketTarget& pocket) {
  const Point to_pocket = pocket.centre - object.position;
  const double object_run = length(to_pocket);
  if (object_run <= 0) {
    return std::nullopt;
  }
  const Point course = (1 / object_run) * to_pocket;
  const Point ghost = object.position - (2 * layout.radius) * course;
  const bool inside = ghost.x >= layout.radius && ghost.x <= layout.width - layout.radius &&
                      ghost.y >= layout.radius && ghost.y <= layout.length - layout.radius;
  const Point to_ghost = ghost - cue;
  const double cue_run = length(to_ghost);
  if (!inside || cue_run <= 0 || dot(course, pocket.outward) < min_cos_entry) {
    return std::nullopt;
  }
  const Point aim = (1 / cue_run) * to_ghost;
  const double cos_cut = dot(aim, course);
  if (cos_cut < min_cos_cut) {
    return std::nullopt;
  }
  return PotLine{.ball = object.id,
                 .pocket = pocket.pocket,
                 .cue = cue,
                 .ghost = ghost,
                 .object = object.position,
                 .aim = aim,
                 .course = course,
                 .cue_run = cue_run,
                 .object_run = object_run,
                 .cos_cut = cos_cut};
}

// An error d in the heading moves the contact sideways by d * cue_run, which turns the object
// ball by that over 2R cos(cut); the pot succeeds while the object ball stays within the mouth.
double chance_of(const PotLine& line, const PocketTarget& pocket, double radius, double aim_error) {
  const double error = std::hypot(aim_error, own_aim_error);
  const double turned = error * line.cue_run / (2 * radius * line.cos_cut);
  const double spread = std::max(turned * line.object_run, 1e-9);
  const double half = pocket.half_width * dot(line.course, pocket.outward);
  return std::erf(half / (spread * std::numbers::sqrt2));
}

std::vector<PocketTarget> pocket_targets(const physics::Table& table, double radius) {
  Mouths m;
  if (const auto* lines = std::get_if<physics::MouthLines>(&table.pockets)) {
    m = mouths(*lines, radius);
  } else if (const auto* jaws = std::get_if<physics::Jaws>(&table.pockets)) {
    m = mouths(*jaws, radius);
  } else {
    return {};
  }
  const double corner = (m.corner_near + m.corner_far) / 2;
  const double w = table.width;
  const double l = table.length;
  const double d = 1 / std::numbers::sqrt2;
  return {
      {PocketId::head_left, {corner, corner}, {-d, -d}, m.corner_half},
      {PocketId::head_right, {w - corner, corner}, {d, -d}, m.corner_half},
      {PocketId::side_left, {m.side_x, l / 2}, {-1, 0}, m.side_half},
      {PocketId::side_right, {w - m.side_x, l / 2}, {1, 0}, m.side_half},
      {PocketId::foot_left, {corner, l - corner}, {-d, d}, m.corner_half},
      {PocketId::foot_right, {w - corner, l - corner}, {d, d}, m.corner_half},
  };
}

Layout layout_of(const rules::GameState& state, const physics::Table& table,
                 const physics::Materials& materials) {
  Layout layout{.width = table.width,
                .length = table.length,
                .radius = materials.ball_radius,
                .pockets = pocket_targets(table, materials.ball_radius),
                .balls = {}};
  const auto balls = rules::balls_on_table(state);
  layout.balls.assign(balls.begin(), balls.end());
  return layout;
}

bool is_clear(const Layout& layout, Point from, Point to, std::span<const BallId> ignored) {
  return std::ranges::none_of(layout.balls, [&](const physics::Ball<double>& ball) {
    return std::ranges::find(ignored, ball.id) == ignored.end() &&
           distance_to_segment(ball.position, from, to) < 2 * layout.radius;
  });
}

std::vector<PotLine> pot_lines(const Layout& layout, Point cue, std::span<const BallId> targets,
                               double aim_error) {
  std::vector<PotLine> lines;
  for (const auto& object : layout.balls) {
    if (std::ranges::find(targets, object.id) == targets.end()) {
      continue;
    }
    for (const auto& pocket : layout.pockets) {
      auto line = line_to(layout, cue, object, pocket);
      const std::array<BallId, 2> movers{physics::cue_ball, object.id};
      if (!line || !is_clear(layout, object.position, pocket.centre, movers) ||
          !is_clear(layout, cue, line->ghost, movers)) {
        continue;
      }
      line->chance = chance_of(*line, pocket, layout.radius, aim_error);
      lines.push_back(*line);
    }
  }
  std::ranges::stable_sort(lines, std::ranges::greater{}, &PotLine::chance);
  return lines;
}

std::vector<BallId> target_balls(const rules::GameState& state) {
  if (state.settings.rules == rules::RuleSet::eight_ball) {
    return rules::callable_balls(state);
  }
  for (const auto& ball : state.balls) {
    if (ball.id != physics::cue_ball && ball.where == rules::Whereabouts::on_table) {
      return {ball.id};
    }
  }
  return {};
}

}  // namespace poolhall::bots
