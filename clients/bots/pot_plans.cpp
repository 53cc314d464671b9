// Pots along lines, with the cue ball where it lies or in hand.
#include <algorithm>
#include <array>
#include <cmath>

#include "clients/bots/look_ahead.hpp"
#include "clients/bots/plans.hpp"
#include "clients/bots/random_bot.hpp"

namespace poolhall::bots {
namespace {

constexpr std::size_t most_lines_lying = 14;     // of a cue ball that lies
constexpr std::size_t most_lines_in_hand = 100;  // of all places together
constexpr std::size_t most_plans = 240;

struct PlacedLine {
  PotLine line{};
  Position ready{};
  bool in_hand = false;
};

Position placed_kind(Position position) {
  position.kind = rules::TurnKind::shot;
  return position;
}

// Behind the ghost ball of every pocket that the ball can reach, near and far, full and cut.
void add_places_for(const Position& position, BallId ball, const PlanSources& sources,
                    std::vector<Point>& places) {
  constexpr std::array<double, 3> runs{0.12, 0.3, 0.65};                       // m
  constexpr std::array<double, 7> cuts{0, 0.3, -0.3, 0.6, -0.6, 0.95, -0.95};  // rad
  const Point object = position.at[physics::number(ball)];
  for (const PocketTarget& pocket : sources.hall.pockets) {
    const Point course = pocket.centre - object;
    const double run_to_pocket = std::sqrt(dot(course, course));
    if (run_to_pocket <= 0 || dot(course, pocket.outward) <= 0) {
      continue;
    }
    const Point u = (1 / run_to_pocket) * course;
    const Point ghost = object - (2 * sources.hall.radius()) * u;
    for (const double run : runs) {
      for (const double cut : cuts) {
        const double c = std::cos(cut);
        const double s = std::sin(cut);
        places.push_back(ghost - run * Point{c * u.x - s * u.y, s * u.x + c * u.y});
      }
    }
  }
}

void add_kitchen_places(const PlanSources& sources, std::vector<Point>& places) {
  constexpr int columns = 9;
  const auto& table = sources.hall.table;
  for (const double share : {0.98, 0.6}) {
    for (int i = 1; i < columns; ++i) {
      places.push_back({table.width * i / columns, table.head_string * share});
    }
  }
}

std::vector<PlacedLine> lines_in_hand(const Position& position, const PlanSources& sources) {
  std::vector<PlacedLine> all;
  std::vector<PotLine> lines;
  const bool kitchen = position.kind == rules::TurnKind::ball_in_hand_behind_head_string;
  for (const Point& place : good_places(position, sources, 1000)) {
    const auto ready = with_cue_ball(position, place, sources.hall);
    if (!ready) {
      continue;
    }
    sources.outlook.find_lines(*ready, lines);
    for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 2); ++i) {
      if (!kitchen || lines[i].object.y >= sources.hall.table.head_string) {
        all.push_back({lines[i], *ready, true});
      }
    }
  }
  std::ranges::stable_sort(all, std::ranges::greater{},
                           [](const PlacedLine& placed) { return placed.line.chance; });
  // Nearly all of them are sure: of each part of the list every so many, not its head alone.
  const std::size_t sure = static_cast<std::size_t>(
      std::ranges::count_if(all, [](const PlacedLine& p) { return p.line.chance > 0.97; }));
  if (sure > most_lines_in_hand) {
    std::vector<PlacedLine> some;
    for (std::size_t i = 0; i < most_lines_in_hand; ++i) {
      some.push_back(all[i * sure / most_lines_in_hand]);
    }
    return some;
  }
  all.resize(std::min(all.size(), most_lines_in_hand));
  return all;
}

std::vector<PlacedLine> lines_as_it_lies(const Position& position, const PlanSources& sources) {
  std::vector<PotLine> lines;
  sources.outlook.find_lines(position, lines);
  lines.resize(std::min(lines.size(), most_lines_lying));
  std::vector<PlacedLine> all;
  for (const PotLine& line : lines) {
    all.push_back({line, position, false});
  }
  return all;
}

StrokeGrid in_hand_grid() {
  return {{1.3, 1.9, 2.8, 4.2}, {-0.5, -0.2, 0.1, 0.5}, {0}};
}

std::vector<Plan> plans_on(const PlacedLine& placed, const PlanSources& sources,
                           const StrokeGrid& grid, Trial& trial) {
  const Position& ready = placed.ready;
  const double chance = placed.line.chance;
  const double missed = sources.outlook.missed(ready);
  const rules::Call call = call_of(ready, placed.line.ball, placed.line.pocket);
  std::vector<Plan> plans;
  for (const auto& stroke : pot_strokes(placed.line, ready, grid, trial)) {
    const Position next = trial.exact(ready, stroke, call);
    const double value = sources.outlook.wins(next, ready.to_move);
    client::Shot shot{stroke, {}, call};
    if (placed.in_hand) {
      shot.cue_ball = ready.cue();
    }
    plans.push_back({shot, ready, chance * value + (1 - chance) * missed, {}});
  }
  return plans;
}

}  // namespace

std::vector<Point> good_places(const Position& position, const PlanSources& sources,
                               std::size_t most) {
  std::vector<Point> places;
  if (position.kind != rules::TurnKind::ball_in_hand) {
    add_kitchen_places(sources, places);
  }
  const BallMask on = balls_on(position);
  for (unsigned left = on; left != 0; left &= left - 1) {
    add_places_for(position, BallId(static_cast<std::uint8_t>(std::countr_zero(left))), sources,
                   places);
  }
  struct Rated {
    Point place{};
    double value = 0;
  };
  std::vector<Rated> rated;
  for (const Point& place : places) {
    if (const auto ready = with_cue_ball(position, place, sources.hall)) {
      rated.push_back({place, sources.outlook.mover_wins(placed_kind(*ready))});
    }
  }
  std::ranges::stable_sort(rated, std::ranges::greater{}, &Rated::value);
  rated.resize(std::min(rated.size(), most));
  std::vector<Point> good;
  for (const Rated& one : rated) {
    good.push_back(one.place);
  }
  return good;
}

std::vector<Plan> pot_plans(const Position& position, const PlanSources& sources) {
  const bool in_hand = is_ball_in_hand(position.kind);
  const auto lines =
      in_hand ? lines_in_hand(position, sources) : lines_as_it_lies(position, sources);
  const StrokeGrid grid = in_hand ? in_hand_grid() : wide_grid(sources.hall.materials);
  std::vector<std::vector<Plan>> parts(lines.size());
  sources.workshop.for_each(lines.size(), [&](Trial& trial, std::size_t i) {
    parts[i] = plans_on(lines[i], sources, grid, trial);
  });
  std::vector<Plan> plans;
  for (auto& part : parts) {
    std::ranges::move(part, std::back_inserter(plans));
  }
  std::ranges::stable_sort(plans, std::ranges::greater{}, &Plan::value);
  plans.resize(std::min(plans.size(), most_plans));
  return plans;
}

}  // namespace poolhall::bots
