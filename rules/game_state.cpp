#include "rules/game_state.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace poolhall::rules {
namespace {

template <class Enum>
struct Named {
  Enum value;
  std::string_view name;
};

constexpr std::array<Named<RuleSet>, 4> rule_set_names{{{RuleSet::eight_ball, "8-ball"},
                                                        {RuleSet::nine_ball, "9-ball"},
                                                        {RuleSet::eight_ball, "eight-ball"},
                                                        {RuleSet::nine_ball, "nine-ball"}}};
constexpr std::array<Named<TurnKind>, 5> turn_kind_names{
    {{TurnKind::break_shot, "break"},
     {TurnKind::shot, "shot"},
     {TurnKind::ball_in_hand, "ball_in_hand"},
     {TurnKind::ball_in_hand_behind_head_string, "ball_in_hand_behind_head_string"},
     {TurnKind::decision, "decision"}}};
constexpr std::array<Named<Decision>, 7> decision_names{
    {{Decision::accept, "accept"},
     {Decision::accept_ball_in_hand, "accept_ball_in_hand"},
     {Decision::rerack_chooser_breaks, "rerack_chooser_breaks"},
     {Decision::rerack_breaker_breaks, "rerack_breaker_breaks"},
     {Decision::spot_eight, "spot_eight"},
     {Decision::shoot, "shoot"},
     {Decision::pass_back, "pass_back"}}};
constexpr std::array<Named<EndReason>, 14> end_reason_names{
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

// "" for a value that is no enumerator.
template <class Enum, std::size_t n>
std::string_view name_in(const std::array<Named<Enum>, n>& names, Enum value) {
  const auto found = std::find_if(names.begin(), names.end(), [value](const Named<Enum>& entry) {
    return entry.value == value;
  });
  return found == names.end() ? std::string_view{} : found->name;
}

template <class Enum, std::size_t n>
std::optional<Enum> value_in(const std::array<Named<Enum>, n>& names, std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(),
                                  [name](const Named<Enum>& entry) { return entry.name == name; });
  return found == names.end() ? std::nullopt : std::optional{found->value};
}

}  // namespace

std::string_view name(RuleSet rules) {
  return name_in(rule_set_names, rules);
}
std::optional<RuleSet> rule_set(std::string_view name) {
  return value_in(rule_set_names, name);
}
std::string_view name(TurnKind kind) {
  return name_in(turn_kind_names, kind);
}
std::optional<TurnKind> turn_kind(std::string_view name) {
  return value_in(turn_kind_names, name);
}
std::string_view name(Decision decision) {
  return name_in(decision_names, decision);
}
std::optional<Decision> decision(std::string_view name) {
  return value_in(decision_names, name);
}
std::string_view name(EndReason reason) {
  return name_in(end_reason_names, reason);
}
std::optional<EndReason> end_reason(std::string_view name) {
  return value_in(end_reason_names, name);
}

const BallPlace* find_ball(const GameState& state, BallId id) {
  const auto found = std::find_if(state.balls.begin(), state.balls.end(),
                                  [id](const BallPlace& place) { return place.id == id; });
  return found == state.balls.end() ? nullptr : &*found;
}

}  // namespace poolhall::rules
