#include "rules/game_state.hpp"

#include <algorithm>

#include "physics/words.hpp"

namespace poolhall::rules {
namespace {

using physics::value_of;
using physics::word_of;
using physics::Words;

constexpr Words<RuleSet, 4> rule_set_names{{{RuleSet::eight_ball, "8-ball"},
                                            {RuleSet::nine_ball, "9-ball"},
                                            {RuleSet::eight_ball, "eight-ball"},
                                            {RuleSet::nine_ball, "nine-ball"}}};
constexpr Words<TurnKind, 5> turn_kind_names{
    {{TurnKind::break_shot, "break"},
     {TurnKind::shot, "shot"},
     {TurnKind::ball_in_hand, "ball_in_hand"},
     {TurnKind::ball_in_hand_behind_head_string, "ball_in_hand_behind_head_string"},
     {TurnKind::decision, "decision"}}};
constexpr Words<Decision, 7> decision_names{
    {{Decision::accept, "accept"},
     {Decision::accept_ball_in_hand, "accept_ball_in_hand"},
     {Decision::rerack_chooser_breaks, "rerack_chooser_breaks"},
     {Decision::rerack_breaker_breaks, "rerack_breaker_breaks"},
     {Decision::spot_eight, "spot_eight"},
     {Decision::shoot, "shoot"},
     {Decision::pass_back, "pass_back"}}};
constexpr Words<EndReason, 14> end_reason_names{
    {{EndReason::eight_pocketed, "eight_pocketed"},
     {EndReason::eight_early, "eight_early"},
     {EndReason::eight_wrong_pocket, "eight_wrong_pocket"},
     {EndReason::eight_with_last, "eight_with_last"},
     {EndReason::eight_on_safety, "eight_on_safety"},
     {EndReason::eight_on_foul, "eight_on_foul"},
     {EndReason::eight_off_table, "eight_off_table"},
     {EndReason::nine_pocketed, "nine_pocketed"},
     {EndReason::three_fouls, "three_fouls"},
     {EndReason::stalemate, "stalemate"},
     {EndReason::conceded, "conceded"},
     {EndReason::timeout, "timeout"},
     {EndReason::forfeit, "forfeit"},
     {EndReason::void_game, "void"}}};

}  // namespace

std::string_view name(RuleSet rules) {
  return word_of(rule_set_names, rules);
}
std::optional<RuleSet> rule_set(std::string_view name) {
  return value_of(rule_set_names, name);
}
std::string_view name(TurnKind kind) {
  return word_of(turn_kind_names, kind);
}
std::optional<TurnKind> turn_kind(std::string_view name) {
  return value_of(turn_kind_names, name);
}
std::string_view name(Decision decision) {
  return word_of(decision_names, decision);
}
std::optional<Decision> decision(std::string_view name) {
  return value_of(decision_names, name);
}
std::string_view name(EndReason reason) {
  return word_of(end_reason_names, reason);
}
std::optional<EndReason> end_reason(std::string_view name) {
  return value_of(end_reason_names, name);
}

const BallPlace* find_ball(const GameState& state, BallId id) {
  const auto found = std::find_if(state.balls.begin(), state.balls.end(),
                                  [id](const BallPlace& place) { return place.id == id; });
  return found == state.balls.end() ? nullptr : &*found;
}

}  // namespace poolhall::rules
