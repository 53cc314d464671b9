#include "clients/bots/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "clients/bots/aiming.hpp"
#include "clients/bots/pot_strokes.hpp"
#include "clients/bots/random_bot.hpp"
#include "clients/bots/stroke.hpp"

namespace poolhall::bots {
namespace {

// What a missed pot is worth on average, before anything is simulated.
constexpr double missed = -0.3;
constexpr std::size_t most_lines = 16;
constexpr std::size_t most_finalists = 24;
constexpr std::size_t first_samples = 6;

bool needs_call(const rules::GameState& state) {
  return state.settings.rules == rules::RuleSet::eight_ball &&
         state.kind != rules::TurnKind::break_shot;
}

rules::Call pot_call(const rules::GameState& state, BallId ball, PocketId pocket) {
  if (!needs_call(state)) {
    return {};
  }
  return {.kind = rules::Call::Kind::pocket, .ball = ball, .pocket = pocket};
}

rules::Call safety_call(const rules::GameState& state) {
  return needs_call(state) ? rules::Call{.kind = rules::Call::Kind::safety} : rules::Call{};
}

// The state with the cue ball placed, as far as placing goes: the call does not matter for it.
std::optional<rules::GameState> placed(const client::TurnView& turn,
                                       const std::optional<Point>& cue_ball) {
  auto state = rules::prepare_shot(turn.state, safety_call(turn.state), cue_ball, turn.info.table,
                                   turn.info.materials);
  if (!state) {
    return std::nullopt;
  }
  return *std::move(state);
}

std::optional<Point> cue_position(const rules::GameState& state) {
  const auto cue = std::ranges::find(state.balls, physics::cue_ball, &rules::BallPlace::id);
  if (cue == state.balls.end() || cue->where != rules::Whereabouts::on_table) {
    return std::nullopt;
  }
  return cue->position;
}

// ---- Where the cue ball may start ----

// Behind the ghost ball of every open pot, near and far, full and cut to either side.
void add_places_behind(const Layout& layout, std::span<const BallId> targets,
                       std::vector<Point>& places) {
  constexpr std::array<double, 3> runs{0.15, 0.35, 0.7};            // m
  constexpr std::array<double, 5> cuts{0, 0.35, -0.35, 0.8, -0.8};  // rad
  for (const auto& ball : layout.balls) {
    if (std::ranges::find(targets, ball.id) == targets.end()) {
      continue;
    }
    for (const auto& pocket : layout.pockets) {
      const Point course = pocket.centre - ball.position;
      const double run_to_pocket = std::sqrt(dot(course, course));
      if (run_to_pocket <= 0 ||
          !is_clear(layout, ball.position, pocket.centre, std::array{physics::cue_ball, ball.id})) {
        continue;
      }
      const Point u = (1 / run_to_pocket) * course;
      const Point ghost = ball.position - (2 * layout.radius) * u;
      for (const double run : runs) {
        for (const double cut : cuts) {
          const double c = std::cos(cut);
          const double s = std::sin(cut);
          places.push_back(ghost - run * Point{c * u.x - s * u.y, s * u.x + c * u.y});
        }
      }
    }
  }
}

std::vector<Point> kitchen_places(const client::TurnView& turn) {
  std::vector<Point> places;
  const auto& table = turn.info.table;
  constexpr int columns = 9;
  for (const double share : {0.98, 0.75, 0.5}) {
    for (int i = 1; i < columns; ++i) {
      places.push_back({table.width * i / columns, table.head_string * share});
    }
  }
  return places;
}

// Every place that is worth a look; those that are not allowed are sorted out by `placed`.
std::vector<std::optional<Point>> starts(const client::TurnView& turn, const Layout& layout,
                                         std::span<const BallId> targets) {
  if (!is_ball_in_hand(turn.state.kind)) {
    return {std::nullopt};
  }
  std::vector<Point> places;
  if (turn.state.kind != rules::TurnKind::ball_in_hand) {
    places = kitchen_places(turn);
  }
  add_places_behind(layout, targets, places);
  return {places.begin(), places.end()};
}

// ---- Straight pots ----

struct Line {
  PotLine line;
  std::optional<Point> placed_at{};
};

// From the kitchen the first ball struck must lie outside it.
bool is_reachable(const client::TurnView& turn, const PotLine& line) {
  return turn.state.kind != rules::TurnKind::ball_in_hand_behind_head_string ||
         line.object.y >= turn.info.table.head_string;
}

std::vector<Line> open_lines(const client::TurnView& turn) {
  const auto targets = target_balls(turn.state);
  const Layout layout = layout_of(turn.state, turn.info.table, turn.info.materials);
  const double error = aim_error(turn.info);
  std::vector<Line> lines;
  for (const auto& start : starts(turn, layout, targets)) {
    const auto state = placed(turn, start);
    const auto cue = state ? cue_position(*state) : std::nullopt;
    if (!cue) {
      continue;
    }
    for (const auto& line : pot_lines(layout, *cue, targets, error)) {
      if (is_reachable(turn, line)) {
        lines.push_back({line, start});
      }
    }
  }
  std::ranges::stable_sort(lines, std::ranges::greater{},
                           [](const Line& line) { return line.line.chance; });
  lines.resize(std::min(lines.size(), most_lines));
  return lines;
}

void add_pots_on(const Line& line, const client::TurnView& turn, Rehearsal& rehearsal,
                 std::vector<Candidate>& candidates) {
  constexpr std::array<double, 3> speeds{1.4, 2.1, 3.4};  // times the least
  const auto state = placed(turn, line.placed_at);
  if (!state) {
    return;
  }
  const auto& materials = turn.info.materials;
  const auto balls = rules::balls_on_table(*state);
  for (const double factor : speeds) {
    const double speed =
        std::clamp(factor * least_speed(line.line, materials), 0.4, 0.9 * materials.max_cue_speed);
    const auto aimed = aim(line.line, {.speed = speed}, balls, turn.info.table, materials);
    if (!aimed) {
      continue;
    }
    rehearsal.add_events(aimed->events);
    const client::Shot shot{aimed->stroke, line.placed_at,
                            pot_call(turn.state, line.line.ball, line.line.pocket)};
    if (const auto value = rehearsal.exact_value(shot)) {
      const double chance = line.line.chance;
      candidates.push_back({shot, chance * *value + (1 - chance) * missed});
    }
  }
}

// ---- Headings all around ----

std::vector<double> headings(const Layout& layout, Point cue, std::span<const BallId> targets,
                             Dice& dice) {
  constexpr int around = 48;
  std::vector<double> result;
  for (const auto& ball : layout.balls) {
    if (std::ranges::find(targets, ball.id) == targets.end()) {
      continue;
    }
    const Point to = ball.position - cue;
    const double distance = std::sqrt(dot(to, to));
    for (const double offset : {0.0, 0.5, -0.5, 0.85, -0.85}) {  // of two radii
      const double sine = std::min(offset * 2 * layout.radius / std::max(distance, 1e-9), 1.0);
      result.push_back(std::atan2(to.y, to.x) + std::asin(std::max(sine, -1.0)));
    }
  }
  const double turn = 2 * std::numbers::pi / around;
  const double first = dice.uniform(0, turn);
  for (int i = 0; i < around; ++i) {
    result.push_back(first + i * turn);
  }
  return result;
}

// A stroke tried as a safety, and if it happens to pot a wanted ball, as that pot too.
void add_both_calls(client::Shot shot, const client::TurnView& turn, Rehearsal& rehearsal,
                    std::span<const BallId> targets, std::vector<Candidate>& candidates) {
  const auto ruling = rehearsal.exact(shot);
  if (!ruling) {
    return;
  }
  candidates.push_back({shot, rehearsal.position_value().of(ruling->next, turn.info.seat)});
  if (!needs_call(turn.state)) {
    return;
  }
  for (const auto& down : ruling->pocketed) {
    if (std::ranges::find(targets, down.ball) != targets.end()) {
      shot.call = pot_call(turn.state, down.ball, down.pocket);
      if (const auto value = rehearsal.exact_value(shot)) {
        candidates.push_back({shot, *value});
      }
      return;
    }
  }
}

void add_around(const std::optional<Point>& start, const client::TurnView& turn,
                Rehearsal& rehearsal, Dice& dice, std::uint64_t budget,
                std::vector<Candidate>& candidates) {
  const auto state = placed(turn, start);
  const auto cue = state ? cue_position(*state) : std::nullopt;
  if (!cue) {
    return;
  }
  const auto targets = target_balls(turn.state);
  const Layout layout = layout_of(*state, turn.info.table, turn.info.materials);
  const auto balls = rules::balls_on_table(*state);
  for (const double speed : {1.2, 2.2, 0.6, 3.5}) {
    for (const double phi : headings(layout, *cue, targets, dice)) {
      if (rehearsal.events() >= budget) {
        return;
      }
      const auto stroke =
          clear_stroke({.phi = phi, .speed = speed}, balls, turn.info.table, turn.info.materials);
      if (stroke) {
        add_both_calls({*stroke, start, safety_call(turn.state)}, turn, rehearsal, targets,
                       candidates);
      }
    }
  }
}

}  // namespace

std::vector<Candidate> breaks(const client::TurnView& turn, Rehearsal& rehearsal,
                              std::uint64_t budget) {
  const auto& table = turn.info.table;
  const Layout layout = layout_of(turn.state, table, turn.info.materials);
  std::vector<Candidate> candidates;
  for (const double speed : {0.9, 0.6}) {       // of the most
    for (const double x : {0.5, 0.35, 0.65}) {  // of the width
      for (const double offset : {0.0, 0.6}) {  // of the radius, beside the apex ball's centre
        if (rehearsal.events() >= budget) {
          return candidates;
        }
        const Point start{x * table.width, 0.97 * table.head_string};
        const auto state = placed(turn, start);
        const Point to =
            Point{table.foot_spot_x + offset * layout.radius, table.foot_spot_y} - start;
        const StrokeWish wish{.phi = std::atan2(to.y, to.x),
                              .speed = speed * turn.info.materials.max_cue_speed};
        const auto stroke =
            state ? clear_stroke(wish, rules::balls_on_table(*state), table, turn.info.materials)
                  : std::nullopt;
        if (!stroke) {
          continue;
        }
        const client::Shot shot{*stroke, start, {}};
        if (const auto value = rehearsal.exact_value(shot)) {
          candidates.push_back({shot, *value});
        }
      }
    }
  }
  return candidates;
}

std::vector<Candidate> straight_pots(const client::TurnView& turn, Rehearsal& rehearsal,
                                     std::uint64_t budget) {
  std::vector<Candidate> candidates;
  for (const Line& line : open_lines(turn)) {
    if (rehearsal.events() >= budget) {
      break;
    }
    add_pots_on(line, turn, rehearsal, candidates);
  }
  return candidates;
}

std::vector<Candidate> all_around(const client::TurnView& turn, Rehearsal& rehearsal, Dice& dice,
                                  std::uint64_t budget) {
  constexpr std::uint64_t places = 6;
  std::vector<Candidate> candidates;
  if (!is_ball_in_hand(turn.state.kind)) {
    add_around(std::nullopt, turn, rehearsal, dice, budget, candidates);
    return candidates;
  }
  const std::uint64_t spent = rehearsal.events();
  for (std::uint64_t i = 1; i <= places && budget > spent; ++i) {
    add_around(random_placement(turn, dice), turn, rehearsal, dice,
               spent + (budget - spent) * i / places, candidates);
  }
  return candidates;
}

std::optional<Candidate> most_valuable(std::vector<Candidate> candidates, Rehearsal& rehearsal,
                                       std::uint64_t budget) {
  const auto best_first = [](const Candidate& p, const Candidate& q) { return p.value > q.value; };
  std::ranges::stable_sort(candidates, best_first);
  candidates.resize(std::min(candidates.size(), most_finalists));
  std::size_t samples = first_samples;
  for (std::size_t first = 0; first + samples <= Rehearsal::max_samples; samples *= 2) {
    for (Candidate& candidate : candidates) {
      // Everybody meets the noise at least once: an exact value says little.
      if (candidate.samples > 0 && rehearsal.events() >= budget) {
        continue;
      }
      const auto mean = rehearsal.value(candidate.shot, {first, samples});
      if (!mean) {
        candidate.value = -4;
        continue;
      }
      const auto before = static_cast<double>(candidate.samples);
      const auto more = static_cast<double>(samples);
      candidate.value = (before * (candidate.samples > 0 ? candidate.value : 0.0) + more * *mean) /
                        (before + more);
      candidate.samples += samples;
    }
    std::ranges::stable_sort(candidates, best_first);
    candidates.resize((candidates.size() + 1) / 2);
    first += samples;
    if (candidates.size() <= 1 || rehearsal.events() >= budget) {
      break;
    }
  }
  if (candidates.empty()) {
    return std::nullopt;
  }
  return candidates.front();
}

}  // namespace poolhall::bots
