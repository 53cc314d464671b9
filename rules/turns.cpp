#include "rules/turns.hpp"

#include <utility>

#include "rules/common_clauses.hpp"

namespace poolhall::rules {

GameState turn_for(GameState state, Seat to_move, TurnKind kind) {
  ++state.turn;
  state.to_move = to_move;
  state.kind = kind;
  state.options.clear();
  return state;
}

GameState decision_for(GameState state, Seat chooser, std::vector<Decision> options) {
  state = turn_for(std::move(state), chooser, TurnKind::decision);
  state.options = std::move(options);
  return state;
}

GameState game_over(GameState state, const GameResult& result) {
  state.result = result;
  return state;
}

GameState racked(GameState state, Seat breaker, const Venue& venue) {
  const GameRules& rules = game_rules(state.settings.rules);
  RackRandom random(state.settings.rack_seed, state.rack);
  const std::vector<BallId> order = rules.rack_order(random);
  const std::vector<physics::Vec2<double>> places =
      rack_places(rules.rack_rows, state.settings, random, venue.table, venue.materials);
  state.balls.assign(rules.object_balls + 1, BallPlace{});
  // In hand; until it is placed it waits in the middle of the kitchen.
  state.balls[0] = {physics::cue_ball,
                    Whereabouts::on_table,
                    {venue.table.width / 2, venue.table.head_string / 2},
                    {}};
  for (std::size_t i = 0; i < order.size(); ++i) {
    state.balls[physics::number(order[i])] = {order[i], Whereabouts::on_table, places[i], {}};
  }
  state.memory = rules.fresh_memory;
  state.breaker = breaker;
  state.to_move = breaker;
  state.kind = TurnKind::break_shot;
  state.options.clear();
  return state;
}

Verdict after_lost_turn(Verdict verdict) {
  const Seat opponent = other(verdict.next.to_move);
  if (applies(clauses::lost_break_passes, verdict.next.kind == TurnKind::break_shot)) {
    verdict.next = turn_for(std::move(verdict.next), opponent, TurnKind::break_shot);
    verdict.next.breaker = opponent;
    verdict.notes.push_back(finding(clauses::lost_break_passes));
    return verdict;
  }
  verdict.next = turn_for(std::move(verdict.next), opponent, TurnKind::ball_in_hand);
  verdict.notes.push_back(finding(clauses::ball_in_hand_after_foul));
  return verdict;
}

std::optional<GameState> decided_commonly(const GameState& state, Decision decision,
                                          const Venue& venue) {
  const Seat chooser = state.to_move;
  switch (decision) {
    case Decision::accept:
      return turn_for(state, chooser,
                      on_table(state, physics::cue_ball)
                          ? TurnKind::shot
                          : TurnKind::ball_in_hand_behind_head_string);
    case Decision::accept_ball_in_hand:
      return turn_for(state, chooser, TurnKind::ball_in_hand_behind_head_string);
    case Decision::rerack_chooser_breaks:
    case Decision::rerack_breaker_breaks: {
      GameState next = turn_for(state, chooser, TurnKind::break_shot);
      ++next.rack;
      return racked(std::move(next),
                    decision == Decision::rerack_chooser_breaks ? chooser : state.breaker, venue);
    }
    default:
      return std::nullopt;
  }
}

Verdict with_stalemate(Verdict verdict, const GameState& before, std::uint32_t turns_without_pocket,
                       const Venue& venue) {
  GameState& next = verdict.next;
  next.turns_without_pocket = turns_without_pocket;
  if (next.result || !applies(clauses::stalemate_rerack, turns_without_pocket >= stalemate_turns)) {
    return verdict;
  }
  next.turns_without_pocket = 0;
  if (applies(clauses::stalemate_draw, before.stalemates > 0)) {
    next = game_over(std::move(next), {std::nullopt, EndReason::stalemate});
    verdict.notes.push_back(finding(clauses::stalemate_draw));
  } else {
    ++next.rack;
    next = racked(std::move(next), before.breaker, venue);
    verdict.notes.push_back(finding(clauses::stalemate_rerack));
  }
  next.stalemates = before.stalemates + 1;
  return verdict;
}

bool on_table(const GameState& state, BallId ball) {
  const BallPlace* place = find_ball(state, ball);
  return place != nullptr && place->where == Whereabouts::on_table;
}

std::vector<BallId> object_balls_on_table(const GameState& state) {
  std::vector<BallId> balls;
  for (const BallPlace& place : state.balls) {
    if (place.where == Whereabouts::on_table && place.id != physics::cue_ball) {
      balls.push_back(place.id);
    }
  }
  return balls;
}

}  // namespace poolhall::rules
