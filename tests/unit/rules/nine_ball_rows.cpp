// The rows of nine-ball. See rule_rows.hpp for the words.
#include "rule_rows.hpp"

namespace poolhall::rules::test {
namespace {

namespace nine_opening {

const std::string b = "9 break";
const std::vector<Row> rows{
    {"nine break four rails", b, "none: 0>1 1-foot 2-foot 3-foot 4-foot", "-> second shot, push"},
    {"nine break ball pocketed", b, "none: 0>1 4@foot_left", "-> first shot, push"},
    {"nine break three rails", b, "none: 0>1 1-foot 2-foot 3-foot",
     "illegal_break -> second ball_in_hand, fouls 1 0"},
    {"nine break cue ball is no object ball", b, "none: 0>1 1-foot 2-foot 3-foot 0-foot",
     "illegal_break -> second ball_in_hand, fouls 1 0"},
    {"nine break not the one first", b, "none: 0>2 0~0.3,0.3 4@foot_left",
     "wrong_ball_first -> second ball_in_hand, fouls 1 0"},
    {"nine break not the one first and three rails", b, "none: 0>2 0~0.3,0.3 1-foot 2-foot 3-foot",
     "wrong_ball_first illegal_break -> second ball_in_hand, fouls 1 0"},
    {"nine break hits nothing", b, "none: 0-foot",
     "no_ball_hit illegal_break -> second ball_in_hand, fouls 1 0"},
    {"nine break scratch", b, "none: 0>1 4@foot_left 0@foot_right",
     "scratch -> second ball_in_hand, fouls 1 0"},
    {"nine break ball off", b, "none: 0>1 4@foot_left 5!",
     "ball_off_table -> second ball_in_hand, fouls 1 0"},
    {"nine break ball off is driven to a rail", b, "none: 0>1 1-foot 2-foot 3-foot 5!",
     "ball_off_table -> second ball_in_hand, fouls 1 0"},
    {"nine break wins with the nine", b, "none: 0>1 9@foot_left", "-> first wins nine_pocketed"},
    {"nine break nine and scratch", b, "none: 0>1 9@foot_left 0@foot_right",
     "scratch -> second ball_in_hand, fouls 1 0, 9 at 1.77599"},
    {"nine break nine and not the one first", b, "none: 0>2 0~0.3,0.3 9@foot_left",
     "wrong_ball_first -> second ball_in_hand, fouls 1 0, 9 at 1.77599"},
    {"nine break kitchen ball first", "9 break at 1 0.2,0.3", "none: 0>1 4@foot_left",
     "kitchen -> second ball_in_hand, fouls 1 0"},
    {"nine break behind the head string", b, "at 0.5,0.559 none: 0>1 4@foot_left",
     "refused bad_cue_ball_position /cue_ball/y"},
    {"nine break with a push out", b, "push: 0>1 4@foot_left", "refused bad_call /call"},
    {"nine break targets", b, "targets", "1"},
    {"nine break calls", b, "calls", "none: "},
    {"nine break lost", b, "lost refusals", "too_many_refusals -> second break, fouls 1 0"},
};

}  // namespace nine_opening

namespace nine_shot {

const std::string s = "9 shot";
const std::vector<Row> rows{
    {"lowest ball first and pocketed", s, "none: 0>1 1@foot_left", "-> first shot"},
    {"any ball keeps the turn", s, "none: 0>1 1>5 5@foot_left", "-> first shot"},
    {"two balls keep the turn", s, "none: 0>1 1@foot_left 5@foot_left", "-> first shot"},
    {"nine-ball nothing pocketed", s, "none: 0>1 1-foot", "-> second shot"},
    {"nine-ball second seat", "9 shot second", "none: 0>1 1-foot", "-> first shot"},
    {"not the lowest ball first", s, "none: 0>2 2@foot_left",
     "wrong_ball_first -> second ball_in_hand, fouls 1 0"},
    {"lowest ball is the three", "9 shot down 1 2", "none: 0>3 3@foot_left", "-> first shot"},
    {"lowest ball with one off the table", "9 shot off 1", "targets", "2"},
    {"lowest of all is the nine", "9 shot down 1 2 3 4 5 6 7 8", "none: 0>9 9@foot_left",
     "-> first wins nine_pocketed"},
    {"nine by combination wins", s, "none: 0>1 1>9 9@foot_left", "-> first wins nine_pocketed"},
    {"nine by the second seat wins", "9 shot second", "none: 0>1 1>9 9@side_left",
     "-> second wins nine_pocketed"},
    {"nine and wrong ball first", s, "none: 0>9 9@foot_left",
     "wrong_ball_first -> second ball_in_hand, fouls 1 0, 9 at 1.67700"},
    {"nine and scratch", s, "none: 0>1 9@foot_left 0@foot_right",
     "scratch -> second ball_in_hand, fouls 1 0, 9 at 1.67700"},
    {"nine and a ball off the table", s, "none: 0>1 9@foot_left 5!",
     "ball_off_table -> second ball_in_hand, fouls 1 0, 9 at 1.67700"},
    {"nine off the table", s, "none: 0>1 9!",
     "ball_off_table -> second ball_in_hand, fouls 1 0, 9 at 1.67700"},
    {"other balls stay down on a foul", s, "none: 0>1 1@foot_left 0@foot_right",
     "scratch -> second ball_in_hand, fouls 1 0"},
    {"nine-ball no ball hit", s, "none: 0-foot", "no_ball_hit -> second ball_in_hand, fouls 1 0"},
    {"nine-ball no rail", s, "none: 0>1",
     "no_rail_after_contact -> second ball_in_hand, fouls 1 0"},
    {"nine-ball wrong ball and no rail", s, "none: 0>2",
     "wrong_ball_first no_rail_after_contact -> second ball_in_hand, fouls 1 0"},
    {"nine-ball scratch and wrong ball", s, "none: 0>2 0@head_left",
     "scratch wrong_ball_first -> second ball_in_hand, fouls 1 0"},
    {"nine-ball cue ball off", s, "none: 0>1 0!",
     "ball_off_table -> second ball_in_hand, fouls 1 0"},
    {"nine-ball frozen ball", "9 shot at 1 0.028575,0.9", "none: 0>1 1-head_left",
     "no_rail_after_contact -> second ball_in_hand, fouls 1 0"},
    {"nine-ball simultaneous contact", "9 shot at 1 0.528,1 at 2 0.588,1 at 3 0.9,0.9",
     "none: 0>2:0.558,0.951350 &0>1:0.558,0.951350 1-foot", "-> second shot"},
    {"nine-ball call", s, "call 1 foot_left: 0>1 1@foot_left", "refused bad_call /call"},
    {"nine-ball safety", s, "safety: 0>1 1-foot", "refused bad_call /call"},
    {"nine-ball calls", s, "calls", "none: "},
    {"nine-ball in hand anywhere", "9 ball_in_hand down 0", "at 0.3,1.9 none: 0>1 1-foot",
     "-> second shot"},
    {"nine-ball lost turn", s, "lost time", "shot_time_exceeded -> second ball_in_hand, fouls 1 0"},
    {"nine-ball stalemate", "9 shot second since 29", "none: 0>1 1-foot", "-> first break"},
    {"nine-ball second stalemate", "9 shot second since 29 stalemates 1", "none: 0>1 1-foot",
     "-> drawn stalemate"},
    {"nine-ball thirtieth turn with a ball", "9 shot second since 29", "none: 0>1 1@foot_left",
     "-> second shot"},
};

}  // namespace nine_shot

namespace nine_push_out {

const std::string p = "9 shot push";
const std::string choice = "-> second decision shoot pass_back";
const std::vector<Row> rows{
    {"push out hits nothing", p, "push: 0-foot", choice},
    {"push out hits another ball", p, "push: 0>5", choice},
    {"push out hits nothing at all", p, "push:", choice},
    {"push out pockets a ball", p, "push: 0>5 5@foot_left", choice},
    {"push out pockets the nine", p, "push: 0>9 9@foot_left", choice + ", 9 at 1.67700"},
    {"push out pockets the nine off the one", p, "push: 0>1 1>9 9@foot_left",
     choice + ", 9 at 1.67700"},
    {"push out of the second seat", "9 shot second push", "push: 0-foot",
     "-> first decision shoot pass_back"},
    {"push out scratch", p, "push: 0@foot_left", "scratch -> second ball_in_hand, fouls 1 0"},
    {"push out ball off", p, "push: 0>5 5!", "ball_off_table -> second ball_in_hand, fouls 1 0"},
    {"push out not declared", p, "none: 0-foot", "no_ball_hit -> second ball_in_hand, fouls 1 0"},
    {"push out allowed but played", p, "none: 0>1 1@foot_left", "-> first shot"},
    {"push out calls", p, "calls", "none push_out: "},
    {"push out later", "9 shot", "push: 0-foot", "refused bad_call /call"},
    {"push out with ball in hand", "9 ball_in_hand", "push: 0-foot", "refused bad_call /call"},
    {"push out ends a row of fouls", "9 shot push fouls 2 0", "push: 0-foot", choice},
    {"chooser shoots", "9 decision second shoot pass_back", "decide shoot", "second shot"},
    {"chooser passes back", "9 decision second shoot pass_back", "decide pass_back", "first shot"},
    {"choice not offered", "9 decision second shoot pass_back", "decide accept",
     "refused bad_decision /choice"},
    {"choice lost", "9 decision second shoot pass_back", "lost time",
     "shot_time_exceeded -> first ball_in_hand, fouls 0 1"},
    {"shot instead of the choice", "9 decision second shoot pass_back", "none: 0>1",
     "refused bad_shot "},
};

}  // namespace nine_push_out

namespace nine_foul_count {

const std::vector<Row> rows{
    {"second foul in a row", "9 shot fouls 1 0", "none: 0-foot",
     "no_ball_hit -> second ball_in_hand, fouls 2 0, warned"},
    {"third foul in a row loses", "9 shot fouls 2 0", "none: 0-foot",
     "no_ball_hit -> second wins three_fouls"},
    {"third foul in a row of the second seat", "9 shot second fouls 0 2", "none: 0-foot",
     "no_ball_hit -> first wins three_fouls"},
    {"fouls of the other player stay", "9 shot fouls 1 2", "none: 0-foot",
     "no_ball_hit -> second ball_in_hand, fouls 2 2, warned"},
    {"legal shot ends the row", "9 shot fouls 2 1", "none: 0>1 1-foot",
     "-> second shot, fouls 0 1"},
    {"two fouls in one shot count once", "9 shot", "none: 0>2 0@head_left 5!",
     "scratch wrong_ball_first ball_off_table -> second ball_in_hand, fouls 1 0"},
    {"third foul with the nine pocketed", "9 shot fouls 2 0", "none: 0>9 9@foot_left",
     "wrong_ball_first -> second wins three_fouls, 9 at 1.67700"},
    {"third foul by a lost turn", "9 shot fouls 2 0", "lost refusals",
     "too_many_refusals -> second wins three_fouls"},
    {"third foul at the thirtieth turn", "9 shot fouls 2 0 since 29", "none: 0-foot",
     "no_ball_hit -> second wins three_fouls"},
    {"third foul on a push out", "9 shot push fouls 2 0", "push: 0@foot_left",
     "scratch -> second wins three_fouls"},
    {"three fouls in a state that goes on", "9 shot fouls 3 0", "none: 0>1 1-foot",
     "refused bad_state /fouls_in_a_row/0"},
};

}  // namespace nine_foul_count

namespace nine_spotting {

const std::string foul = "scratch -> second ball_in_hand, fouls 1 0, 9 at ";
const std::vector<Row> rows{
    {"nine spotted behind a ball", "9 shot at 5 0.558,1.677", "none: 0>1 9@foot_left 0@foot_right",
     foul + "1.73415"},
    {"nine spotted behind a ball beside the string", "9 shot at 5 0.588,1.677",
     "none: 0>1 9@foot_left 0@foot_right", foul + "1.72564"},
    {"nine spotted between two balls with room", "9 shot at 5 0.558,1.677 at 6 0.558,1.7915",
     "none: 0>1 9@foot_left 0@foot_right", foul + "1.73415"},
    {"nine spotted behind two balls", "9 shot at 5 0.558,1.677 at 6 0.558,1.7912",
     "none: 0>1 9@foot_left 0@foot_right", foul + "1.84835"},
    {"nine spotted clear of the cue ball", "9 shot push at 0 0.558,1.677",
     "push: 0>1:0.558,1.677 9@foot_left", "-> second decision shoot pass_back, 9 at 1.73416"},
};

}  // namespace nine_spotting

}  // namespace

std::vector<Row> nine_ball_rows() {
  std::vector<Row> rows;
  for (const auto& part : {nine_opening::rows, nine_shot::rows, nine_push_out::rows,
                           nine_foul_count::rows, nine_spotting::rows}) {
    rows.insert(rows.end(), part.begin(), part.end());
  }
  return rows;
}

}  // namespace poolhall::rules::test
