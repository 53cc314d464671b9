#include "clients/bots/look_ahead.hpp"

#include <algorithm>

namespace poolhall::bots {

rules::Call call_of(const Position& position, BallId ball, PocketId pocket) {
  if (position.rules == rules::RuleSet::nine_ball || position.kind == rules::TurnKind::break_shot) {
    return {};
  }
  return {.kind = rules::Call::Kind::pocket, .ball = ball, .pocket = pocket};
}

rules::Call safety_of(const Position& position) {
  if (position.rules == rules::RuleSet::nine_ball || position.kind == rules::TurnKind::break_shot) {
    return {};
  }
  return {.kind = rules::Call::Kind::safety};
}

std::vector<LookAhead::Stroke> LookAhead::strokes(const Position& position, Trial& trial) const {
  std::vector<PotLine> lines;
  outlook_.find_lines(position, lines);
  lines.resize(std::min(lines.size(), settings_.lines));
  const double missed = outlook_.missed(position);
  std::vector<Stroke> strokes;
  for (const PotLine& line : lines) {
    const rules::Call call = call_of(position, line.ball, line.pocket);
    for (const auto& params : pot_strokes(line, position, grid_, trial)) {
      const Position next = trial.exact(position, params, call);
      const double value = outlook_.wins(next, position.to_move);
      strokes.push_back({params, call, line.chance * value + (1 - line.chance) * missed});
    }
  }
  std::ranges::stable_sort(strokes, std::ranges::greater{}, &Stroke::value);
  strokes.resize(std::min(strokes.size(), settings_.finalists));
  return strokes;
}

double LookAhead::mover_wins(const Position& position, Trial& trial, std::size_t salt) const {
  if (position.is_over || position.kind != rules::TurnKind::shot) {
    return outlook_.mover_wins(position);
  }
  double best = outlook_.missed(position);
  for (const Stroke& stroke : strokes(position, trial)) {
    double sum = 0;
    for (std::size_t i = 0; i < settings_.samples; ++i) {
      const auto& deviates = deviates_[(salt * settings_.samples + i) % deviates_.size()];
      const Position next = trial.noisy(position, stroke.params, stroke.call, noise_, deviates);
      sum += outlook_.wins(next, position.to_move);
    }
    best = std::max(best, sum / static_cast<double>(settings_.samples));
  }
  return best;
}

double LookAhead::wins(const Position& position, rules::Seat seat, Trial& trial,
                       std::size_t salt) const {
  const double mover = mover_wins(position, trial, salt);
  return position.to_move == seat ? mover : 1 - mover;
}

}  // namespace poolhall::bots
