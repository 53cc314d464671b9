// 8-ball: the rule set, called shots, and its clauses.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "rules/clause.hpp"
#include "rules/game_rules.hpp"

namespace poolhall::rules {

[[nodiscard]] const GameRules& eight_ball_rules();

namespace eight_ball {

inline constexpr BallId the_eight{8};

[[nodiscard]] Verdict judge_break(const Shot& shot);
[[nodiscard]] Verdict judge_shot(const Shot& shot);
// A turn lost without a shot: the opponent has ball in hand, the 8 back on the table.
[[nodiscard]] Verdict lost_turn(const GameState& state, const Venue& venue);
[[nodiscard]] GameState decide(const GameState& state, Decision decision, const Venue& venue);

// Group of the player in `seat`; nothing while the table is open.
[[nodiscard]] std::optional<Group> group_of_seat(const GameState& state, Seat seat);
// No ball of `group` is left on the table; without a group, none but the 8 is.
[[nodiscard]] bool is_cleared(const GameState& state, std::optional<Group> group);
// The balls that the player to move must strike first and may call.
[[nodiscard]] std::vector<BallId> balls_on(const GameState& state);

}  // namespace eight_ball

namespace clauses {

inline constexpr Clause break_no_call{"break_no_call", "3.3", "no call is made on the break"};
inline constexpr Clause break_goes_on{
    "break_goes_on", "3.3",
    "the breaker goes on after pocketing a ball without a foul; the table stays open"};
inline constexpr Clause illegal_break_choice{
    "illegal_break_choice", "3.3",
    "after an illegal break the opponent accepts the table or has the balls reracked"};
inline constexpr Clause break_scratch{
    "break_scratch", "3.3",
    "after a scratch on a legal break the opponent has ball in hand in the kitchen"};
inline constexpr Clause break_foul_choice{
    "break_foul_choice", "3.3",
    "after another foul on a legal break the opponent accepts the table or takes ball in hand in "
    "the kitchen"};
inline constexpr Clause break_eight_choice{
    "break_eight_choice", "3.3",
    "the 8 pocketed on a legal break: the breaker has it spotted or breaks again"};
inline constexpr Clause break_eight_foul{
    "break_eight_foul", "3.3",
    "the 8 pocketed on the break with a scratch: the opponent has it spotted, with ball in hand in "
    "the kitchen, or breaks"};
inline constexpr Clause break_eight_off{"break_eight_off", "3.7",
                                        "the 8 driven off the table on the break is spotted"};
inline constexpr Clause open_table{"open_table", "H4",
                                   "on an open table any ball but the 8 may be struck first"};
inline constexpr Clause own_group_first{"own_group_first", "3.4",
                                        "a ball of the shooter's group is struck first"};
inline constexpr Clause eight_when_cleared{"eight_when_cleared", "3.6",
                                           "with the group cleared the 8 is on"};
inline constexpr Clause groups_assigned{
    "groups_assigned", "3.4",
    "on an open table the called ball, legally pocketed, settles the groups"};
inline constexpr Clause no_groups_by_safety{"no_groups_by_safety", "3.4",
                                            "a safety never settles the groups"};
inline constexpr Clause goes_on{
    "goes_on", "3.5", "the shooter goes on after legally pocketing the called ball as called"};
inline constexpr Clause called_pocket{"called_pocket", "1.6",
                                      "the called ball must drop in the called pocket"};
inline constexpr Clause safety_ends_turn{"safety_ends_turn", "3.6",
                                         "after a safety the opponent shoots"};
inline constexpr Clause eight_early{"eight_early", "3.8",
                                    "the 8 pocketed before the group is cleared loses"};
inline constexpr Clause eight_wrong_pocket{"eight_wrong_pocket", "3.8",
                                           "the 8 in another pocket than called loses"};
inline constexpr Clause eight_with_last{"eight_with_last", "3.8",
                                        "the 8 on the stroke of the last ball of the group loses"};
inline constexpr Clause eight_on_safety{"eight_on_safety", "3.8",
                                        "the 8 pocketed on a safety loses"};
inline constexpr Clause eight_on_foul{"eight_on_foul", "3.8", "the 8 pocketed with a foul loses"};
inline constexpr Clause eight_off_table{"eight_off_table", "3.8",
                                        "the 8 driven off the table loses"};
inline constexpr Clause eight_wins{"eight_wins", "3",
                                   "the 8 legally pocketed as called with the group cleared wins"};

inline constexpr std::array eight_ball{&break_no_call,
                                       &break_goes_on,
                                       &illegal_break_choice,
                                       &break_scratch,
                                       &break_foul_choice,
                                       &break_eight_choice,
                                       &break_eight_foul,
                                       &break_eight_off,
                                       &open_table,
                                       &own_group_first,
                                       &eight_when_cleared,
                                       &groups_assigned,
                                       &no_groups_by_safety,
                                       &goes_on,
                                       &called_pocket,
                                       &safety_ends_turn,
                                       &eight_early,
                                       &eight_wrong_pocket,
                                       &eight_with_last,
                                       &eight_on_safety,
                                       &eight_on_foul,
                                       &eight_off_table,
                                       &eight_wins};

}  // namespace clauses
}  // namespace poolhall::rules
