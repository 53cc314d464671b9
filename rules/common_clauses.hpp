// Clauses that all games share. rules/README.md lists them with their tests.
#pragma once

#include <array>

#include "rules/clause.hpp"

namespace poolhall::rules::clauses {

inline constexpr Clause scratch{"scratch", "6.1", "the cue ball is pocketed"};
inline constexpr Clause wrong_ball_first{
    "wrong_ball_first", "6.2", "the first ball struck is not one that may be struck first"};
inline constexpr Clause no_ball_hit{"no_ball_hit", "6.2", "the cue ball strikes no ball"};
inline constexpr Clause no_rail_after_contact{
    "no_rail_after_contact", "6.3",
    "after contact no ball is pocketed and none is driven to a rail"};
inline constexpr Clause ball_off_table{"ball_off_table", "6.5", "a ball is driven off the table"};
inline constexpr Clause kitchen_first_ball{
    "kitchen_first_ball", "6.11", "from the kitchen the first ball struck must lie outside it"};
inline constexpr Clause kitchen_left_before{
    "kitchen_left_before", "6.11",
    "a ball in the kitchen may be struck once the cue ball has left the kitchen"};
inline constexpr Clause kitchen_placement{
    "kitchen_placement", "1.5", "in hand in the kitchen, the cue ball is placed y < head string"};
inline constexpr Clause shot_time_exceeded{"shot_time_exceeded", "6.15",
                                           "the cap on a shot's time was exceeded"};
inline constexpr Clause too_many_refusals{"too_many_refusals", "H1",
                                          "too many refused shots in one turn"};
inline constexpr Clause lost_break_passes{
    "lost_break_passes", "H1", "a turn to break that is lost without a shot passes the break on"};
inline constexpr Clause simultaneous_contact{
    "simultaneous_contact", "H2",
    "of balls struck first within 1e-9 s the shooter gets the benefit"};
inline constexpr Clause frozen_rail{
    "frozen_rail", "8.4",
    "a ball frozen to a rail counts there only after it has been 1 mm away from it"};
inline constexpr Clause pocketed_is_driven{"pocketed_is_driven", "8.4",
                                           "a ball pocketed counts as driven to a rail"};
inline constexpr Clause off_table_is_driven{
    "off_table_is_driven", "8.4", "a ball driven off the table counts as driven to a rail"};
inline constexpr Clause spot_beyond_balls{
    "spot_beyond_balls", "1.4",
    "a spotted ball lies on the long string as near the foot spot as the balls there leave room"};
inline constexpr Clause spot_clear_of_cue_ball{"spot_clear_of_cue_ball", "1.4",
                                               "a spotted ball never touches the cue ball"};
inline constexpr Clause spot_towards_head{
    "spot_towards_head", "1.4",
    "with no room between foot spot and foot rail a ball is spotted towards the head"};
inline constexpr Clause ball_in_hand_after_foul{
    "ball_in_hand_after_foul", "1.5", "after a foul the opponent has ball in hand anywhere"};
inline constexpr Clause illegal_break{
    "illegal_break", "3.3",
    "the break must pocket a ball or drive at least four object balls to a rail"};
inline constexpr Clause four_to_a_rail{"four_to_a_rail", "3.3",
                                       "at least four object balls are driven to a rail"};
inline constexpr Clause break_pocketed{"break_pocketed", "3.3",
                                       "an object ball is pocketed on the break"};
inline constexpr Clause stalemate_rerack{
    "stalemate_rerack", "1.12", "30 turns in a row without a ball pocketed: rerack, same breaker"};
inline constexpr Clause stalemate_draw{"stalemate_draw", "H3",
                                       "a second stalemate in a game: the game is drawn"};

inline constexpr std::array common{&scratch,
                                   &wrong_ball_first,
                                   &no_ball_hit,
                                   &no_rail_after_contact,
                                   &ball_off_table,
                                   &kitchen_first_ball,
                                   &kitchen_left_before,
                                   &kitchen_placement,
                                   &shot_time_exceeded,
                                   &too_many_refusals,
                                   &lost_break_passes,
                                   &simultaneous_contact,
                                   &frozen_rail,
                                   &pocketed_is_driven,
                                   &off_table_is_driven,
                                   &spot_beyond_balls,
                                   &spot_clear_of_cue_ball,
                                   &spot_towards_head,
                                   &ball_in_hand_after_foul,
                                   &illegal_break,
                                   &four_to_a_rail,
                                   &break_pocketed,
                                   &stalemate_rerack,
                                   &stalemate_draw};

}  // namespace poolhall::rules::clauses
