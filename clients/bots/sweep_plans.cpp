// Headings all around: banks, kicks, combinations and safeties, whatever the table's shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "clients/bots/look_ahead.hpp"
#include "clients/bots/plans.hpp"
#include "clients/bots/stroke.hpp"

namespace poolhall::bots {
namespace {

constexpr std::array<double, 5> speeds{0.7, 1.3, 2.2, 3.6, 5.5};  // m/s
constexpr std::size_t headings_an_item = 8;
constexpr std::size_t most_of_a_kind = 24;

struct Pot {
  BallId ball{};
  PocketId pocket{};
  double value = 0;
};

// What came of one heading at one speed, without noise.
struct Cell {
  protocol::ShotParams stroke{};
  bool is_possible = false;
  double safe = 0;       // value of it as a safety, or without a call
  double push_out = -1;  // and as a push-out, where allowed
  std::vector<Pot> pots{};
};

Cell tried(const Position& ready, const protocol::ShotParams& stroke, const PlanSources& sources,
           Trial& trial) {
  Cell cell{stroke, true, 0, -1, {}};
  const auto value = [&](const rules::Call& call) {
    return sources.outlook.wins(trial.exact(ready, stroke, call), ready.to_move);
  };
  cell.safe = value(safety_of(ready));
  const auto down = trial.down();
  if (ready.push_out_allowed) {
    cell.push_out = value({.kind = rules::Call::Kind::push_out});
  }
  if (ready.rules == rules::RuleSet::eight_ball) {
    const BallMask on = balls_on(ready);
    for (const auto& [ball, pocket] : down) {
      if ((only(ball) & on) != 0) {
        cell.pots.push_back({ball, pocket, value(call_of(ready, ball, pocket))});
      }
    }
  }
  return cell;
}

// The cells of one speed, heading by heading.
std::vector<Cell> ring(const Position& ready, double speed, std::size_t headings,
                       const PlanSources& sources) {
  std::vector<Cell> cells(headings);
  const auto balls = ball_set(ready);
  const auto& hall = sources.hall;
  const std::size_t items = (headings + headings_an_item - 1) / headings_an_item;
  sources.workshop.for_each(items, [&](Trial& trial, std::size_t item) {
    std::optional<protocol::ShotParams> raised;
    const std::size_t end = std::min(headings, (item + 1) * headings_an_item);
    for (std::size_t i = item * headings_an_item; i < end; ++i) {
      const double phi =
          2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(headings);
      if (raised) {
        raised->phi = phi * 180 / std::numbers::pi;
      }
      if (!raised ||
          !physics::check_shot(physics::cue_shot(*raised), balls, hall.table, hall.materials)) {
        raised = clear_stroke({.phi = phi, .speed = speed}, balls, hall.table, hall.materials);
      }
      if (raised) {
        cells[i] = tried(ready, *raised, sources, trial);
      }
    }
  });
  return cells;
}

double pot_value(const Cell& cell, const Pot& pot) {
  for (const Pot& other : cell.pots) {
    if (other.ball == pot.ball && other.pocket == pot.pocket) {
      return other.value;
    }
  }
  return cell.safe;  // missed, and the opponent's turn as after a safety
}

// Weights of a heading's neighbours under the noise of the heading, from the heading itself.
std::vector<double> weights_of(double aim_error, std::size_t headings) {
  const double step = 2 * std::numbers::pi / static_cast<double>(headings);
  std::vector<double> weights{1};
  for (std::size_t k = 1; k < headings / 2; ++k) {
    const double z = static_cast<double>(k) * step / std::max(aim_error, 1e-6);
    if (z > 2.5) {
      break;
    }
    weights.push_back(std::exp(-z * z / 2));
  }
  return weights;
}

template <class Value>
double smoothed(const std::vector<Cell>& cells, std::size_t i, const std::vector<double>& weights,
                Value value) {
  const std::size_t n = cells.size();
  double sum = 0;
  double weight = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    for (const std::size_t j : {(i + k) % n, (i + n - k) % n}) {
      if (cells[j].is_possible && (k > 0 || j == i)) {
        sum += weights[k] * value(cells[j]);
        weight += weights[k];
      }
    }
  }
  return weight > 0 ? sum / weight : 0;
}

Plan plan_of(const Position& ready, const Cell& cell, const rules::Call& call, double value) {
  return {client::Shot{cell.stroke, {}, call}, ready, value, {}};
}

// Neighbours are nearly the same shot: of a row of them only the best.
void keep_best(std::vector<Plan>& plans, std::size_t most) {
  std::ranges::stable_sort(plans, std::ranges::greater{}, &Plan::value);
  std::vector<Plan> kept;
  for (Plan& plan : plans) {
    const auto is_near = [&](const Plan& other) {
      const double turn = std::remainder(other.shot.stroke.phi - plan.shot.stroke.phi, 360.0);
      return other.shot.stroke.v == plan.shot.stroke.v && other.shot.call == plan.shot.call &&
             std::abs(turn) < 1.0;
    };
    if (kept.size() < most && std::ranges::none_of(kept, is_near)) {
      kept.push_back(std::move(plan));
    }
  }
  plans = std::move(kept);
}

}  // namespace

std::vector<Plan> sweep_plans(const Position& position, const PlanSources& sources,
                              std::size_t headings) {
  const auto weights = weights_of(sources.noise.phi, headings);
  std::vector<Plan> quiet;
  std::vector<Plan> pots;
  for (const double speed : speeds) {
    const auto cells = ring(position, speed, headings, sources);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Cell& cell = cells[i];
      if (!cell.is_possible) {
        continue;
      }
      quiet.push_back(plan_of(position, cell, safety_of(position),
                              smoothed(cells, i, weights, [](const Cell& c) { return c.safe; })));
      if (position.push_out_allowed) {
        quiet.push_back(
            plan_of(position, cell, {.kind = rules::Call::Kind::push_out},
                    smoothed(cells, i, weights, [](const Cell& c) { return c.push_out; })));
      }
      for (const Pot& pot : cell.pots) {
        pots.push_back(
            plan_of(position, cell, call_of(position, pot.ball, pot.pocket),
                    smoothed(cells, i, weights, [&](const Cell& c) { return pot_value(c, pot); })));
      }
    }
  }
  keep_best(quiet, most_of_a_kind);
  keep_best(pots, most_of_a_kind);
  std::ranges::move(pots, std::back_inserter(quiet));
  return quiet;
}

}  // namespace poolhall::bots
