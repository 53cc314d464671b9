// A shot of 8-ball after the break: groups, called shots, safeties and the 8.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "rules/common_clauses.hpp"
#include "rules/eight_ball.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules::eight_ball {
namespace {

// The ball that was pocketed as it should: the called ball in the called pocket; on a safety the
// first ball that might have been called.
std::optional<PocketedBall> scoring_ball(const Shot& shot) {
  const std::vector<BallId> callable = balls_on(shot.ready);
  for (const PocketedBall& down : shot.facts.pocketed) {
    if (shot.call.kind == Call::Kind::pocket) {
      const bool elsewhere = applies(clauses::called_pocket, down.pocket != shot.call.pocket);
      if (down.ball == shot.call.ball && !elsewhere) {
        return down;
      }
    } else if (std::find(callable.begin(), callable.end(), down.ball) != callable.end()) {
      return down;
    }
  }
  return std::nullopt;
}

struct LossClause {
  EndReason reason;
  const Clause* clause;
  bool fact;
};

// Every way in which the shot loses the game, in the order of the rules.
std::vector<LossClause> losses(const Shot& shot, const FoulReport& report) {
  const ShotFacts& facts = shot.facts;
  const bool down = facts.is_pocketed(the_eight);
  const bool safety = shot.call.kind == Call::Kind::safety;
  std::optional<Group> group = group_of_seat(shot.ready, shot.ready.to_move);
  const bool was_cleared = is_cleared(shot.ready, group);
  if (!group && shot.call.kind == Call::Kind::pocket) {
    group = rules::group_of(shot.call.ball);
  }
  const bool last_stroke = !was_cleared && is_cleared(shot.after, group);
  const std::array<LossClause, 6> all{
      {{EndReason::eight_early, &clauses::eight_early, down && !was_cleared && !last_stroke},
       {EndReason::eight_wrong_pocket, &clauses::eight_wrong_pocket,
        down && was_cleared && !safety && !facts.is_pocketed_in(the_eight, shot.call.pocket)},
       {EndReason::eight_with_last, &clauses::eight_with_last, down && last_stroke},
       {EndReason::eight_on_safety, &clauses::eight_on_safety, down && safety},
       {EndReason::eight_on_foul, &clauses::eight_on_foul, down && !report.fouls.empty()},
       {EndReason::eight_off_table, &clauses::eight_off_table, facts.is_off(the_eight)}}};
  std::vector<LossClause> found;
  for (const LossClause& loss : all) {
    if (applies(*loss.clause, loss.fact)) {
      found.push_back(loss);
    }
  }
  return found;
}

// The end of the game, if the 8 decided it.
std::optional<Verdict> judge_eight(const Shot& shot, const FoulReport& report) {
  const Seat shooter = shot.ready.to_move;
  const std::optional<std::size_t> event = shot.facts.gone_event(the_eight);
  const std::vector<LossClause> lost = losses(shot, report);
  Verdict verdict{report.fouls, report.notes, report.first_contact, shot.after};
  if (!lost.empty()) {
    for (const LossClause& loss : lost) {
      verdict.notes.push_back(finding(*loss.clause, event));
    }
    verdict.next = game_over(std::move(verdict.next), {other(shooter), lost.front().reason});
    return verdict;
  }
  if (applies(clauses::eight_wins, shot.facts.is_pocketed(the_eight))) {
    verdict.notes.push_back(finding(clauses::eight_wins, event));
    verdict.next = game_over(std::move(verdict.next), {shooter, EndReason::eight_pocketed});
    return verdict;
  }
  return std::nullopt;
}

EightBallMemory with_group(Seat shooter, Group group) {
  if (shooter == Seat::first) {
    return {group};
  }
  return {group == Group::solids ? Group::stripes : Group::solids};
}

// Why `next` shoots after a shot without a foul.
Finding why_next(const Shot& shot, const std::optional<PocketedBall>& scored, Seat next) {
  if (next == shot.ready.to_move) {
    return finding(clauses::goes_on, scored ? std::optional{scored->event} : std::nullopt);
  }
  if (shot.call.kind == Call::Kind::safety) {
    return finding(clauses::safety_ends_turn);
  }
  return said(clauses::goes_on, ball_words(shot.call.ball) + " was not pocketed in " +
                                    std::string(physics::name(shot.call.pocket)) +
                                    " as called: the opponent shoots");
}

Verdict play_on(const Shot& shot, FoulReport report) {
  const Seat shooter = shot.ready.to_move;
  Verdict verdict{std::move(report.fouls), std::move(report.notes), report.first_contact,
                  shot.after};
  if (!verdict.fouls.empty()) {
    const bool in_hand = applies(clauses::ball_in_hand_after_foul, true);
    verdict.notes.push_back(finding(clauses::ball_in_hand_after_foul));
    verdict.next = turn_for(std::move(verdict.next), other(shooter),
                            in_hand ? TurnKind::ball_in_hand : TurnKind::shot);
    return verdict;
  }
  const std::optional<PocketedBall> scored = scoring_ball(shot);
  const bool safety = shot.call.kind == Call::Kind::safety;
  const bool open = !group_of_seat(shot.ready, shooter);
  if (scored && open && rules::group_of(scored->ball) && applies(clauses::groups_assigned, true) &&
      !applies(clauses::no_groups_by_safety, safety)) {
    verdict.next.memory = with_group(shooter, *rules::group_of(scored->ball));
    verdict.notes.push_back(finding(clauses::groups_assigned, scored->event));
  }
  const bool same =
      applies(clauses::goes_on, scored.has_value()) && !applies(clauses::safety_ends_turn, safety);
  verdict.notes.push_back(why_next(shot, scored, same ? shooter : other(shooter)));
  verdict.next = turn_for(std::move(verdict.next), same ? shooter : other(shooter), TurnKind::shot);
  return verdict;
}

}  // namespace

Verdict judge_shot(const Shot& shot) {
  FoulReport report = standard_fouls(shot.ready, shot.facts, {.first_balls = balls_on(shot.ready)},
                                     shot.venue.table);
  if (auto over = judge_eight(shot, report)) {
    return *std::move(over);
  }
  return play_on(shot, std::move(report));
}

}  // namespace poolhall::rules::eight_ball
