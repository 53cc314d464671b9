// Nine-ball: the rule set, push-out, three fouls, and its clauses.
#pragma once

#include <array>

#include "rules/clause.hpp"
#include "rules/game_rules.hpp"

namespace poolhall::rules {

[[nodiscard]] const GameRules& nine_ball_rules();

namespace clauses {

inline constexpr Clause lowest_first{"lowest_first", "2.5",
                                     "the lowest ball on the table is struck first"};
inline constexpr Clause keeps_turn{"keeps_turn", "2.5",
                                   "pocketing any ball legally keeps the turn"};
inline constexpr Clause nine_wins{"nine_wins", "2.5", "the 9 legally pocketed wins"};
inline constexpr Clause nine_spotted{
    "nine_spotted", "2.6", "the 9 pocketed on a foul or a push-out, or driven off, is spotted"};
inline constexpr Clause push_out_once{"push_out_once", "2.4",
                                      "a push-out is allowed on the first shot after the break"};
inline constexpr Clause push_out_no_duty{
    "push_out_no_duty", "2.4", "a push-out need not strike a ball nor drive one to a rail"};
inline constexpr Clause push_out_choice{"push_out_choice", "2.4",
                                        "after a push-out the opponent chooses who shoots"};
inline constexpr Clause two_fouls{"two_fouls", "6.14",
                                  "two fouls in a row: a third one loses the game"};
inline constexpr Clause three_fouls{"three_fouls", "6.14", "three fouls in a row lose the game"};
inline constexpr Clause fouls_forgotten{"fouls_forgotten", "6.14",
                                        "a shot without a foul ends a row of fouls"};

inline constexpr std::array nine_ball{
    &lowest_first,     &keeps_turn,      &nine_wins, &nine_spotted, &push_out_once,
    &push_out_no_duty, &push_out_choice, &two_fouls, &three_fouls,  &fouls_forgotten};

}  // namespace clauses
}  // namespace poolhall::rules
