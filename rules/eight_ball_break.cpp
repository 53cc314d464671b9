// The break of 8-ball and the choices that follow it.
#include <utility>

#include "rules/common_clauses.hpp"
#include "rules/eight_ball.hpp"
#include "rules/spotting.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules::eight_ball {
namespace {

struct Outcome {
  GameState next;
  Finding why;
};

Outcome outcome(GameState next, const Clause& clause,
                std::optional<std::size_t> event = std::nullopt) {
  return {std::move(next), finding(clause, event)};
}

// The turn after a break by a legal stroke that pocketed the 8.
Outcome after_eight(const Shot& shot, const GameState& after, const FoulReport& report) {
  const Seat breaker = shot.ready.to_move;
  const std::optional<std::size_t> event = shot.facts.gone_event(the_eight);
  if (applies(clauses::break_eight_foul, !report.fouls.empty())) {
    return outcome(decision_for(after, other(breaker),
                                {Decision::spot_eight, Decision::rerack_chooser_breaks}),
                   clauses::break_eight_foul, event);
  }
  return outcome(
      decision_for(after, breaker, {Decision::spot_eight, Decision::rerack_breaker_breaks}),
      clauses::break_eight_choice, event);
}

Outcome after_foul(const Shot& shot, const GameState& after) {
  const Seat opponent = other(shot.ready.to_move);
  if (!applies(clauses::break_scratch, !on_table(after, physics::cue_ball)) &&
      applies(clauses::break_foul_choice, true)) {
    return outcome(decision_for(after, opponent, {Decision::accept, Decision::accept_ball_in_hand}),
                   clauses::break_foul_choice);
  }
  return outcome(turn_for(after, opponent, TurnKind::ball_in_hand_behind_head_string),
                 clauses::break_scratch, shot.facts.gone_event(physics::cue_ball));
}

Outcome after_break(const Shot& shot, const GameState& after, const FoulReport& report,
                    const std::optional<FoulRecord>& illegal) {
  const Seat breaker = shot.ready.to_move;
  const Seat opponent = other(breaker);
  if (applies(clauses::illegal_break_choice, illegal.has_value())) {
    return outcome(decision_for(after, opponent,
                                {Decision::accept, Decision::rerack_chooser_breaks,
                                 Decision::rerack_breaker_breaks}),
                   clauses::illegal_break_choice);
  }
  if (applies(clauses::break_eight_choice, shot.facts.is_pocketed(the_eight))) {
    return after_eight(shot, after, report);
  }
  if (!report.fouls.empty()) {
    return after_foul(shot, after);
  }
  const bool goes_on = applies(clauses::break_goes_on, shot.facts.object_ball_pocketed());
  return {turn_for(after, goes_on ? breaker : opponent, TurnKind::shot),
          goes_on ? finding(clauses::break_goes_on, shot.facts.first_object_ball_down())
                  : said(clauses::break_goes_on, "no ball was pocketed: the opponent shoots")};
}

}  // namespace

Verdict judge_break(const Shot& shot) {
  FoulReport report =
      standard_fouls(shot.ready, shot.facts,
                     {.first_balls = {}, .right_ball_first = false, .rail_after_contact = false},
                     shot.venue.table);
  const std::optional<FoulRecord> illegal = illegal_break(shot.facts, "3.3");
  GameState after = shot.after;
  std::vector<Finding> notes = std::move(report.notes);
  if (applies(clauses::break_eight_off, shot.facts.is_off(the_eight))) {
    after = spotted(std::move(after), the_eight, shot.venue.table, shot.venue.materials);
    notes.push_back(finding(clauses::break_eight_off, shot.facts.gone_event(the_eight)));
  }
  Outcome result = after_break(shot, after, report, illegal);
  notes.push_back(std::move(result.why));
  if (illegal) {
    report.fouls.push_back(*illegal);
  }
  return {std::move(report.fouls), std::move(notes), report.first_contact, std::move(result.next)};
}

Verdict lost_turn(const GameState& state, const Venue& venue) {
  const bool eight_down = find_ball(state, the_eight)->where != Whereabouts::on_table;
  return after_lost_turn(
      {{}, {}, {}, eight_down ? spotted(state, the_eight, venue.table, venue.materials) : state});
}

GameState decide(const GameState& state, Decision decision, const Venue& venue) {
  if (auto common = decided_commonly(state, decision, venue)) {
    return *std::move(common);
  }
  // spot_eight: the breaker's without a foul, else the opponent's with ball in hand.
  return turn_for(
      spotted(state, the_eight, venue.table, venue.materials), state.to_move,
      state.to_move == state.breaker ? TurnKind::shot : TurnKind::ball_in_hand_behind_head_string);
}

}  // namespace poolhall::rules::eight_ball
