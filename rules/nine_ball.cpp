#include "rules/nine_ball.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "rules/common_clauses.hpp"
#include "rules/spotting.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules {
namespace nine_ball {
namespace {

constexpr BallId the_one{1};
constexpr BallId the_nine{9};

// An impossible state that remembers another game counts as one without fouls.
NineBallMemory memory_of(const GameState& state) {
  const auto* memory = std::get_if<NineBallMemory>(&state.memory);
  return memory == nullptr ? NineBallMemory{} : *memory;
}

// 1 on the foot spot, 9 in the middle, the rest random.
std::vector<BallId> rack_order(RackRandom& random) {
  std::vector<unsigned> rest{2, 3, 4, 5, 6, 7, 8};
  random.shuffle(rest);
  std::vector<BallId> order{the_one};
  for (const unsigned n : rest) {
    if (order.size() == 4) {
      order.push_back(the_nine);
    }
    order.push_back(BallId(static_cast<std::uint8_t>(n)));
  }
  return order;
}

std::vector<BallId> first_balls(const GameState& state) {
  std::vector<BallId> balls = object_balls_on_table(state);
  if (state.kind == TurnKind::decision) {
    balls.clear();
  } else if (balls.size() > 1 && applies(clauses::lowest_first, true)) {
    balls.resize(1);
  }
  return balls;
}

std::vector<BallId> callable_balls(const GameState& /*state*/) {
  return {};
}

std::vector<Call::Kind> legal_calls(const GameState& state) {
  if (state.kind == TurnKind::decision) {
    return {};
  }
  if (applies(clauses::push_out_once, memory_of(state).push_out_allowed)) {
    return {Call::Kind::none, Call::Kind::push_out};
  }
  return {Call::Kind::none};
}

tl::unexpected<Refusal> impossible(std::string field, std::string reason) {
  return tl::unexpected(Refusal{RefusalCode::bad_state, std::move(field), std::move(reason)});
}

Expected<void> check(const GameState& state) {
  if (!std::holds_alternative<NineBallMemory>(state.memory)) {
    return impossible("/rules", "the state remembers another game than nine-ball");
  }
  const NineBallMemory memory = memory_of(state);
  const unsigned most = state.result ? 3 : 2;
  for (std::size_t seat = 0; seat < 2; ++seat) {
    if (memory.fouls_in_a_row[seat] > most) {
      return impossible("/fouls_in_a_row/" + std::to_string(seat),
                        std::to_string(memory.fouls_in_a_row[seat]) + " fouls in a row, at most " +
                            std::to_string(most) + " are possible");
    }
  }
  if (state.result) {
    return {};
  }
  if (memory.push_out_allowed && state.kind != TurnKind::shot) {
    return impossible("/push_out_allowed", "a push-out is possible on an ordinary shot only");
  }
  if (!on_table(state, the_nine)) {
    return impossible("/balls/9", "the 9 is down, but the game goes on");
  }
  if (state.kind == TurnKind::decision &&
      state.options != std::vector{Decision::shoot, Decision::pass_back}) {
    return impossible("/options", "nine-ball offers shoot and pass_back and nothing else");
  }
  return {};
}

// Fouls in a row after a shot or a lost turn of `seat`.
NineBallMemory counted(const NineBallMemory& before, Seat seat, std::size_t fouls) {
  NineBallMemory memory = before;
  std::uint8_t& row = memory.fouls_in_a_row[index(seat)];
  if (fouls > 0) {
    ++row;
  } else if (applies(clauses::fouls_forgotten, true)) {
    row = 0;
  }
  memory.push_out_allowed = false;
  return memory;
}

Duties duties_of(const Shot& shot) {
  Duties duties{.first_balls = first_balls(shot.ready)};
  if (shot.ready.kind == TurnKind::break_shot) {
    duties.rail_after_contact = false;
  }
  if (applies(clauses::push_out_no_duty, shot.call.kind == Call::Kind::push_out)) {
    duties.strike_a_ball = false;
    duties.right_ball_first = false;
    duties.rail_after_contact = false;
  }
  return duties;
}

// What follows a foul of the player to move; `state` counts it already.
Verdict fouled(Verdict verdict, Seat shooter) {
  const unsigned row = memory_of(verdict.next).fouls_in_a_row[index(shooter)];
  if (applies(clauses::three_fouls, row >= 3)) {
    verdict.notes.push_back(finding(clauses::three_fouls));
    verdict.next = game_over(std::move(verdict.next), {other(shooter), EndReason::three_fouls});
    return verdict;
  }
  if (applies(clauses::two_fouls, row == 2)) {
    verdict.notes.push_back(finding(clauses::two_fouls));
  }
  return verdict;
}

Verdict after_foul(Verdict verdict, Seat shooter) {
  verdict = fouled(std::move(verdict), shooter);
  if (!verdict.next.result) {
    const bool in_hand = applies(clauses::ball_in_hand_after_foul, true);
    verdict.notes.push_back(finding(clauses::ball_in_hand_after_foul));
    verdict.next = turn_for(std::move(verdict.next), other(shooter),
                            in_hand ? TurnKind::ball_in_hand : TurnKind::shot);
  }
  return verdict;
}

Verdict after_legal_shot(const Shot& shot, Verdict verdict) {
  const Seat shooter = shot.ready.to_move;
  if (applies(clauses::push_out_choice, shot.call.kind == Call::Kind::push_out)) {
    verdict.notes.push_back(finding(clauses::push_out_choice));
    verdict.next = decision_for(std::move(verdict.next), other(shooter),
                                {Decision::shoot, Decision::pass_back});
    return verdict;
  }
  const bool goes_on = applies(clauses::keeps_turn, shot.facts.object_ball_pocketed());
  verdict.notes.push_back(
      goes_on ? finding(clauses::keeps_turn, shot.facts.first_object_ball_down())
              : said(clauses::keeps_turn, "no ball was pocketed: the opponent shoots"));
  verdict.next =
      turn_for(std::move(verdict.next), goes_on ? shooter : other(shooter), TurnKind::shot);
  if (shot.ready.kind == TurnKind::break_shot) {
    NineBallMemory memory = memory_of(verdict.next);
    memory.push_out_allowed = true;
    verdict.next.memory = memory;
  }
  return verdict;
}

Verdict judge(const Shot& shot) {
  const Seat shooter = shot.ready.to_move;
  FoulReport report = standard_fouls(shot.ready, shot.facts, duties_of(shot), shot.venue.table);
  if (shot.ready.kind == TurnKind::break_shot) {
    if (const auto illegal = illegal_break(shot.facts, "2.3")) {
      report.fouls.push_back(*illegal);
    }
  }
  Verdict verdict{std::move(report.fouls), std::move(report.notes), report.first_contact,
                  shot.after};
  verdict.next.memory = counted(memory_of(shot.ready), shooter, verdict.fouls.size());
  const bool push_out = shot.call.kind == Call::Kind::push_out;
  const bool nine_down = shot.facts.is_pocketed(the_nine);
  if (verdict.fouls.empty() && !push_out && applies(clauses::nine_wins, nine_down)) {
    verdict.notes.push_back(finding(clauses::nine_wins, shot.facts.gone_event(the_nine)));
    verdict.next = game_over(std::move(verdict.next), {shooter, EndReason::nine_pocketed});
    return verdict;
  }
  if (applies(clauses::nine_spotted, nine_down || shot.facts.is_off(the_nine))) {
    verdict.next =
        spotted(std::move(verdict.next), the_nine, shot.venue.table, shot.venue.materials);
    verdict.notes.push_back(finding(clauses::nine_spotted, shot.facts.gone_event(the_nine)));
  }
  return verdict.fouls.empty() ? after_legal_shot(shot, std::move(verdict))
                               : after_foul(std::move(verdict), shooter);
}

Verdict lost_turn(const GameState& state, const Venue& /*venue*/) {
  Verdict verdict{{}, {}, {}, state};
  verdict.next.memory = counted(memory_of(state), state.to_move, 1);
  verdict = fouled(std::move(verdict), state.to_move);
  return verdict.next.result ? verdict : after_lost_turn(std::move(verdict));
}

GameState decide(const GameState& state, Decision decision, const Venue& /*venue*/) {
  return turn_for(state, decision == Decision::shoot ? state.to_move : other(state.to_move),
                  TurnKind::shot);
}

}  // namespace
}  // namespace nine_ball

const GameRules& nine_ball_rules() {
  static const GameRules rules{RuleSet::nine_ball,     9,
                               {1, 2, 3, 2, 1},        nine_ball::rack_order,
                               NineBallMemory{},       clauses::nine_ball,
                               nine_ball::check,       nine_ball::callable_balls,
                               nine_ball::first_balls, nine_ball::legal_calls,
                               nine_ball::judge,       nine_ball::lost_turn,
                               nine_ball::decide};
  return rules;
}

}  // namespace poolhall::rules
