// Breaks: places in the kitchen, the part of the rack that is struck, speed and spin, at random.
#include <algorithm>
#include <cmath>

#include "clients/bots/plans.hpp"
#include "clients/bots/stroke.hpp"

namespace poolhall::bots {
namespace {

struct BreakDraw {
  Point place{};
  StrokeWish wish{};
};

BreakDraw drawn(const Position& position, const Hall& hall, Dice& dice) {
  const double radius = hall.radius();
  const double fastest = hall.materials.max_cue_speed;
  BreakDraw draw;
  draw.place = {dice.uniform(2 * radius, hall.table.width - 2 * radius),
                hall.table.head_string * (dice.below(4) == 0 ? dice.uniform(0.3, 1) : 0.99)};
  // Mostly the apex ball; now and then another ball of the rack.
  std::vector<std::size_t> balls;
  for (unsigned left = position.on_table & ~1U; left != 0; left &= left - 1) {
    balls.push_back(static_cast<std::size_t>(std::countr_zero(left)));
  }
  std::ranges::sort(balls, {}, [&](std::size_t n) { return position.at[n].y; });
  const bool apex = position.rules == rules::RuleSet::nine_ball || dice.below(3) != 0;
  const std::size_t struck = apex ? 0 : dice.below(std::min<std::size_t>(balls.size(), 6));
  const Point to = position.at[balls[struck]] - draw.place;
  const double reach = 2 * radius / std::max(std::sqrt(dot(to, to)), 2 * radius);
  const double widest = 0.6 * hall.materials.miscue_limit * radius;
  draw.wish.phi = std::atan2(to.y, to.x) + std::asin(reach * dice.uniform(-0.85, 0.85));
  draw.wish.speed = fastest * (dice.below(2) == 0 ? 0.97 : dice.uniform(0.45, 0.97));
  draw.wish.follow = widest * dice.uniform(-1, 1);
  draw.wish.side = dice.below(3) == 0 ? 0.7 * widest * dice.uniform(-1, 1) : 0;
  return draw;
}

}  // namespace

std::vector<Plan> break_plans(const Position& position, const PlanSources& sources, Dice dice,
                              std::size_t count) {
  const auto& hall = sources.hall;
  std::vector<Plan> plans;
  for (std::size_t i = 0; i < count; ++i) {
    const BreakDraw draw = drawn(position, hall, dice);
    const auto ready = with_cue_ball(position, draw.place, hall);
    const auto stroke = ready
                            ? clear_stroke(draw.wish, ball_set(*ready), hall.table, hall.materials)
                            : std::nullopt;
    if (stroke) {
      plans.push_back({client::Shot{*stroke, draw.place, {}}, *ready, 0, {}});
    }
  }
  return plans;
}

}  // namespace poolhall::bots
