// The table of the referee's clauses: one readable row a clause and a row for each pair of clauses
// that can meet in one shot.
//
//   EXPECT_EQ(outcome(row), row.expected);
//
// A state: the game, the kind of turn and what differs from the standard position, in which
// every ball lies somewhere free and the cue ball at (0.558, 0.8) of the `olympiad` table:
//   "8 shot second solids down 1 2 off 3 at 5 0.2,0.9"
//   solids / stripes   the group of the first seat; the table is open without
//   first / second     who is to move (default: first)
//   down, off          balls pocketed, driven off; `at B X,Y` a ball's place
//   since N            turns without a ball pocketed; `stalemates N`; `fouls N M`; `push`
//   options A B        of a decision
// An action is a shot, a decision or a turn lost:
//   "call 3 foot_left: 0>3 3@foot_left"   "safety: ..."   "none: ..."   "push: ..."
//   "at 0.5,0.3 call ..."                 the cue ball placed there first
//   "decide accept"   "lost time"   "lost refusals"   "calls"   "targets"
// Events: 0>3 contact (0>3:X,Y with the first ball's centre there), 3-foot rail, 3@side_left
// pocketed, 3! off the table, 3~X,Y moves there; & before an event: at the same time, &T: T
// seconds later.
// Expected: fouls -> who has which turn, what the game remembers, and where on the long string a
// ball was spotted; or the refusal.
#pragma once

#include <string>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules::test {

struct Row {
  std::string name;
  std::string state;
  std::string action;
  std::string expected;
};

[[nodiscard]] const physics::Table& row_table();
[[nodiscard]] const physics::Materials& row_materials();

[[nodiscard]] GameState row_state(const std::string& text);
[[nodiscard]] physics::EventLog<double> row_log(const GameState& ready, const std::string& text);

// What the referee makes of the row.
[[nodiscard]] std::string outcome(const Row& row);
[[nodiscard]] std::string described(const Ruling& ruling);
[[nodiscard]] std::string described(const GameState& state);

[[nodiscard]] std::vector<Row> eight_ball_rows();
[[nodiscard]] std::vector<Row> nine_ball_rows();
[[nodiscard]] std::vector<Row> all_rows();

}  // namespace poolhall::rules::test
