// The rows of 8-ball, clause by clause and pair by pair. See rule_rows.hpp for the words.
#include "rule_rows.hpp"

namespace poolhall::rules::test {
namespace {

const std::string illegal = "second decision accept rerack_chooser_breaks rerack_breaker_breaks";
const std::string kitchen = "second ball_in_hand_behind_head_string";
const std::string foul_choice = "second decision accept accept_ball_in_hand";
const std::string solids_down = "down 1 2 3 4 5 6 7";
const std::string stripes_down = "down 9 10 11 12 13 14 15";
const std::string four_rails = "0>1 1-foot 2-foot 3-foot 4-foot";

namespace opening {

const std::string b = "8 break";
const std::vector<Row> rows{
    {"break four balls to a rail", b, "none: " + four_rails, "-> second shot"},
    {"break three balls to a rail", b, "none: 0>1 1-foot 2-foot 3-foot",
     "illegal_break -> " + illegal},
    {"break one ball at four rails counts once", b,
     "none: 0>1 1-foot 1-foot 1-foot 1-foot 2-foot 3-foot", "illegal_break -> " + illegal},
    {"break cue ball at a rail is no object ball", b, "none: 0>1 1-foot 2-foot 3-foot 0-foot",
     "illegal_break -> " + illegal},
    {"break pocketed ball goes on", b, "none: 0>1 1@foot_left", "-> first shot"},
    {"break both groups pocketed stays open", b, "none: 0>1 1@foot_left 9@foot_right",
     "-> first shot"},
    {"break of the second seat", "8 break second", "none: 0>1 1@foot_left", "-> second shot"},
    {"break of the second seat dry", "8 break second", "none: " + four_rails, "-> first shot"},
    {"break scratch", b, "none: " + four_rails + " 0@foot_left", "scratch -> " + kitchen},
    {"break scratch with a ball pocketed", b, "none: 0>1 1@foot_left 0@foot_right",
     "scratch -> " + kitchen},
    {"break scratch and three rails", b, "none: 0>1 1-foot 2-foot 3-foot 0@foot_left",
     "scratch illegal_break -> " + illegal},
    {"break hits nothing", b, "none: 0-foot", "no_ball_hit illegal_break -> " + illegal},
    {"break hits nothing and scratches", b, "none: 0@foot_left",
     "scratch no_ball_hit illegal_break -> " + illegal},
    {"break ball off the table", b, "none: " + four_rails + " 5!",
     "ball_off_table -> " + foul_choice},
    {"break ball off the table and one pocketed", b, "none: 0>1 1@foot_left 5!",
     "ball_off_table -> " + foul_choice},
    {"break ball off the table is driven to a rail", b, "none: 0>1 1-foot 2-foot 3-foot 5!",
     "ball_off_table -> " + foul_choice},
    {"break ball off the table and an illegal break", b, "none: 0>1 1-foot 2-foot 5!",
     "ball_off_table illegal_break -> " + illegal},
    {"break cue ball off the table", b, "none: " + four_rails + " 0!",
     "ball_off_table -> " + kitchen},
    {"break ball off the table and scratch", b, "none: " + four_rails + " 5! 0@foot_left",
     "scratch ball_off_table -> " + kitchen},
    {"break kitchen ball first", "8 break at 1 0.2,0.3", "none: 0>1 2@foot_left",
     "kitchen -> " + foul_choice},
    {"break kitchen ball first and scratch", "8 break at 1 0.2,0.3",
     "none: 0>1 2@foot_left 0@head_left", "scratch kitchen -> " + kitchen},
    {"break kitchen ball first and an illegal break", "8 break at 1 0.2,0.3", "none: 0>1 1-head",
     "illegal_break kitchen -> " + illegal},
    {"break kitchen ball after the cue ball left", "8 break at 1 0.2,0.3",
     "none: 0~0.3,0.7 0>1 2@foot_left", "-> first shot"},
    {"break kitchen ball after the cue ball came to the line", "8 break at 1 0.2,0.3",
     "none: 0~0.3,0.559 0>1 2@foot_left", "-> first shot"},
    {"break eight first", b, "none: 0>8 0~0.3,0.3 1@foot_left", "-> first shot"},
    {"break eight pocketed", b, "none: 0>1 8@foot_left",
     "-> first decision spot_eight rerack_breaker_breaks"},
    {"break eight pocketed with another ball", b, "none: 0>1 8@foot_left 3@foot_left",
     "-> first decision spot_eight rerack_breaker_breaks"},
    {"break eight pocketed and scratch", b, "none: 0>1 8@foot_left 0@foot_left",
     "scratch -> second decision spot_eight rerack_chooser_breaks"},
    {"break eight pocketed and a ball off the table", b, "none: 0>1 8@foot_left 3!",
     "ball_off_table -> second decision spot_eight rerack_chooser_breaks"},
    {"break eight pocketed and kitchen ball first", "8 break at 1 0.2,0.3", "none: 0>1 8@foot_left",
     "kitchen -> second decision spot_eight rerack_chooser_breaks"},
    {"break eight off the table", b, "none: " + four_rails + " 8!",
     "ball_off_table -> " + foul_choice + ", 8 at 1.77599"},
    {"break eight off the table and scratch", b, "none: " + four_rails + " 8! 0@foot_left",
     "scratch ball_off_table -> " + kitchen + ", 8 at 1.67700"},
    {"break eight off the table and an illegal break", b, "none: 0>1 8!",
     "ball_off_table illegal_break -> " + illegal + ", 8 at 1.77599"},
    {"break with a call", b, "call 1 foot_left: 0>1 1@foot_left", "refused bad_call /call"},
    {"break with a safety", b, "safety: 0>1 1@foot_left", "refused bad_call /call"},
    {"break with a push out", b, "push: 0>1 1@foot_left", "refused bad_call /call"},
    {"break calls", b, "calls", "none: "},
    {"break targets", b, "targets", "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15"},
    {"break cue ball on the head string", b, "at 0.5,0.559 none: " + four_rails,
     "refused bad_cue_ball_position /cue_ball/y"},
    {"break cue ball beyond the head string", b, "at 0.5,0.7 none: " + four_rails,
     "refused bad_cue_ball_position /cue_ball/y"},
    {"break cue ball in a rail", b, "at 0.02,0.3 none: " + four_rails,
     "refused bad_cue_ball_position /cue_ball"},
    {"break cue ball placed", b, "at 0.3,0.55 none: " + four_rails, "-> second shot"},
    {"break lost by time", b, "lost time", "shot_time_exceeded -> second break"},
    {"break lost by refusals", "8 break second", "lost refusals",
     "too_many_refusals -> first break"},
};

}  // namespace opening

namespace decisions {

const std::string three = " accept rerack_chooser_breaks rerack_breaker_breaks";
const std::vector<Row> rows{
    {"accept an illegal break", "8 decision second" + three, "decide accept", "second shot"},
    {"accept an illegal break with scratch", "8 decision second down 0" + three, "decide accept",
     kitchen},
    {"accept an illegal break with the cue ball off", "8 decision second off 0" + three,
     "decide accept", kitchen},
    {"rerack, chooser breaks", "8 decision second" + three, "decide rerack_chooser_breaks",
     "second break"},
    {"rerack, breaker breaks", "8 decision second" + three, "decide rerack_breaker_breaks",
     "first break"},
    {"accept after a foul", "8 decision second off 5 accept accept_ball_in_hand", "decide accept",
     "second shot"},
    {"ball in hand after a foul", "8 decision second off 5 accept accept_ball_in_hand",
     "decide accept_ball_in_hand", kitchen},
    {"breaker has the eight spotted", "8 decision first down 8 spot_eight rerack_breaker_breaks",
     "decide spot_eight", "first shot, 8 at 1.67700"},
    {"breaker breaks again", "8 decision first down 8 spot_eight rerack_breaker_breaks",
     "decide rerack_breaker_breaks", "first break"},
    {"opponent has the eight spotted",
     "8 decision second down 8 0 spot_eight rerack_chooser_breaks", "decide spot_eight",
     kitchen + ", 8 at 1.67700"},
    {"opponent breaks after eight and scratch",
     "8 decision second down 8 0 spot_eight rerack_chooser_breaks", "decide rerack_chooser_breaks",
     "second break"},
    {"decision that was not offered", "8 decision second off 5 accept accept_ball_in_hand",
     "decide rerack_chooser_breaks", "refused bad_decision /choice"},
    {"decision on a shot", "8 shot", "decide accept", "refused bad_decision "},
    {"shot instead of a decision", "8 decision second" + three, "safety: 0>1 1-foot",
     "refused bad_shot "},
    {"decision calls", "8 decision second" + three, "calls", ": "},
    {"decision targets", "8 decision second" + three, "targets", ""},
    {"decision lost", "8 decision second off 5 accept accept_ball_in_hand", "lost refusals",
     "too_many_refusals -> first ball_in_hand"},
    {"decision on the eight lost", "8 decision second down 8 0 spot_eight rerack_chooser_breaks",
     "lost time", "shot_time_exceeded -> first ball_in_hand, 8 at 1.67700"},
};

}  // namespace decisions

namespace open_table {

const std::string s = "8 shot";
const std::vector<Row> rows{
    {"open table calls", s, "calls", "pocket safety: 1 2 3 4 5 6 7 9 10 11 12 13 14 15"},
    {"open table targets", s, "targets", "1 2 3 4 5 6 7 9 10 11 12 13 14 15"},
    {"open table called ball settles solids", s, "call 3 foot_left: 0>3 3@foot_left",
     "-> first shot, solids"},
    {"open table called ball settles stripes", s, "call 12 foot_left: 0>12 12@foot_left",
     "-> first shot, stripes"},
    {"open table second seat settles", "8 shot second", "call 3 foot_left: 0>3 3@foot_left",
     "-> second shot, stripes"},
    {"open table combination through the other group", s, "call 3 foot_left: 0>12 12>3 3@foot_left",
     "-> first shot, solids"},
    {"open table eight first", s, "call 3 foot_left: 0>8 8>3 3@foot_left",
     "wrong_ball_first -> second ball_in_hand"},
    {"open table other pocket settles nothing", s, "call 3 foot_left: 0>3 3@foot_right",
     "-> second shot"},
    {"open table other ball settles nothing", s, "call 3 foot_left: 0>3 4@foot_left",
     "-> second shot"},
    {"open table both groups, the called one counts", s,
     "call 3 foot_left: 0>3 12@foot_right 3@foot_left", "-> first shot, solids"},
    {"open table foul settles nothing", s, "call 3 foot_left: 0>3 3@foot_left 0@foot_right",
     "scratch -> second ball_in_hand"},
    {"open table safety settles nothing", s, "safety: 0>3 3@foot_left", "-> second shot"},
    {"open table safety", s, "safety: 0>3 3-foot", "-> second shot"},
    {"open table no call", s, "none: 0>3 3@foot_left", "refused bad_call /call"},
    {"open table push out", s, "push: 0>3 3@foot_left", "refused bad_call /call"},
    {"open table call of the eight", s, "call 8 foot_left: 0>8 8@foot_left",
     "refused bad_call /call/ball"},
    {"open table call of the cue ball", s, "call 0 foot_left: 0>8 8@foot_left",
     "refused bad_call /call/ball"},
    {"open table call of a ball that is down", "8 shot down 3", "call 3 foot_left: 0>4 4@foot_left",
     "refused bad_call /call/ball"},
    {"open table call of a ball that is off", "8 shot off 3", "call 3 foot_left: 0>4 4@foot_left",
     "refused bad_call /call/ball"},
    {"open table eight pocketed", s, "call 3 foot_left: 0>3 3@foot_left 8@foot_right",
     "-> second wins eight_early"},
    {"open table eight pocketed on a safety", s, "safety: 0>3 8@foot_right",
     "-> second wins eight_early"},
    {"open table eight off the table", s, "call 3 foot_left: 0>3 3@foot_left 8!",
     "ball_off_table -> second wins eight_off_table"},
    {"open table with all other balls down", "8 shot " + solids_down + " 9 10 11 12 13 14 15",
     "calls", "pocket safety: 8"},
    {"open table with all other balls down, the eight wins",
     "8 shot " + solids_down + " 9 10 11 12 13 14 15", "call 8 foot_left: 0>8 8@foot_left",
     "-> first wins eight_pocketed"},
    {"open table last solid with the eight", "8 shot down 1 2 3 4 5 6",
     "call 7 foot_left: 0>7 7@foot_left 8@foot_left", "-> second wins eight_with_last"},
    {"open table ball kissed by the cue ball later", s,
     "call 3 foot_left: 0>12 0>8 12>3 3@foot_left", "-> first shot, solids"},
};

}  // namespace open_table

namespace groups {

const std::string s = "8 shot solids down 1 9";
const std::vector<Row> rows{
    {"group calls", s, "calls", "pocket safety: 2 3 4 5 6 7"},
    {"group targets", s, "targets", "2 3 4 5 6 7"},
    {"group calls of the second seat", "8 shot second solids down 1 9", "calls",
     "pocket safety: 10 11 12 13 14 15"},
    {"called ball goes on", s, "call 3 foot_left: 0>3 3@foot_left", "-> first shot, solids"},
    {"called ball of the second seat", "8 shot second solids down 1 9",
     "call 12 side_right: 0>12 12@side_right", "-> second shot, solids"},
    {"called ball by combination", s, "call 3 foot_left: 0>4 4>3 3@foot_left",
     "-> first shot, solids"},
    {"called ball off the other group", s, "call 3 foot_left: 0>3 3>12 3@foot_left",
     "-> first shot, solids"},
    {"other pocket", s, "call 3 foot_left: 0>3 3@foot_right", "-> second shot, solids"},
    {"other ball of the group", s, "call 3 foot_left: 0>3 4@foot_left", "-> second shot, solids"},
    {"nothing pocketed", s, "call 3 foot_left: 0>3 3-foot", "-> second shot, solids"},
    {"called ball and one of the opponent", s, "call 3 foot_left: 0>3 12@side_left 3@foot_left",
     "-> first shot, solids"},
    {"only a ball of the opponent", s, "call 3 foot_left: 0>3 3>12 12@foot_left",
     "-> second shot, solids"},
    {"wrong group first", s, "call 3 foot_left: 0>12 12>3 3@foot_left",
     "wrong_ball_first -> second ball_in_hand, solids"},
    {"eight first", s, "call 3 foot_left: 0>8 8>3 3@foot_left",
     "wrong_ball_first -> second ball_in_hand, solids"},
    {"own group first for stripes", "8 shot stripes down 1 9",
     "call 12 foot_left: 0>3 3>12 12@foot_left",
     "wrong_ball_first -> second ball_in_hand, stripes"},
    {"call of the other group", s, "call 12 foot_left: 0>12 12@foot_left",
     "refused bad_call /call/ball"},
    {"call of the eight too early", s, "call 8 foot_left: 0>3 8@foot_left",
     "refused bad_call /call/ball"},
    {"safety ends the turn", s, "safety: 0>3 3-foot", "-> second shot, solids"},
    {"safety with a ball pocketed ends the turn", s, "safety: 0>3 3@foot_left",
     "-> second shot, solids"},
    {"scratch", s, "call 3 foot_left: 0>3 3-foot 0@side_left",
     "scratch -> second ball_in_hand, solids"},
    {"scratch is driven to a rail", s, "call 3 foot_left: 0>3 0@side_left",
     "scratch -> second ball_in_hand, solids"},
    {"scratch with the called ball", s, "call 3 foot_left: 0>3 3@foot_left 0@side_left",
     "scratch -> second ball_in_hand, solids"},
    {"scratch on a safety", s, "safety: 0>3 3-foot 0@side_left",
     "scratch -> second ball_in_hand, solids"},
    {"scratch without contact", s, "call 3 foot_left: 0@side_left",
     "scratch no_ball_hit -> second ball_in_hand, solids"},
    {"no ball hit", s, "call 3 foot_left: 0-foot 0-head",
     "no_ball_hit -> second ball_in_hand, solids"},
    {"no ball hit and no rail", s, "safety:", "no_ball_hit -> second ball_in_hand, solids"},
    {"no rail after contact", s, "call 3 foot_left: 0>3",
     "no_rail_after_contact -> second ball_in_hand, solids"},
    {"no rail after contact on a safety", s, "safety: 0>3",
     "no_rail_after_contact -> second ball_in_hand, solids"},
    {"rail before contact is none after", s, "safety: 0-foot 0>3",
     "no_rail_after_contact -> second ball_in_hand, solids"},
    {"cue ball to a rail after contact", s, "safety: 0>3 0-head_right", "-> second shot, solids"},
    {"third ball to a rail after contact", s, "safety: 0>3 3>12 12-foot", "-> second shot, solids"},
    {"pocketed ball of the opponent is driven to a rail", s, "safety: 0>3 3>12 12@foot_left",
     "-> second shot, solids"},
    {"wrong ball first and no rail", s, "call 3 foot_left: 0>12",
     "wrong_ball_first no_rail_after_contact -> second ball_in_hand, solids"},
    {"wrong ball first and scratch", s, "call 3 foot_left: 0>12 0@head_left",
     "scratch wrong_ball_first -> second ball_in_hand, solids"},
    {"wrong ball first and a ball off", s, "call 3 foot_left: 0>12 12!",
     "wrong_ball_first ball_off_table -> second ball_in_hand, solids"},
    {"scratch, wrong ball first and a ball off", s, "call 3 foot_left: 0>12 12! 0@head_left",
     "scratch wrong_ball_first ball_off_table -> second ball_in_hand, solids"},
    {"wrong ball first on a safety", s, "safety: 0>12 12-foot",
     "wrong_ball_first -> second ball_in_hand, solids"},
    {"object ball off the table", s, "call 3 foot_left: 0>3 3!",
     "ball_off_table -> second ball_in_hand, solids"},
    {"called ball pocketed and another off", s, "call 3 foot_left: 0>3 3@foot_left 4!",
     "ball_off_table -> second ball_in_hand, solids"},
    {"cue ball off the table", s, "call 3 foot_left: 0>3 3-foot 0!",
     "ball_off_table -> second ball_in_hand, solids"},
    {"cue ball off the table without contact", s, "call 3 foot_left: 0!",
     "no_ball_hit ball_off_table -> second ball_in_hand, solids"},
    {"shot lost by time", s, "lost time", "shot_time_exceeded -> second ball_in_hand, solids"},
    {"shot lost by refusals", s, "lost refusals",
     "too_many_refusals -> second ball_in_hand, solids"},
    {"cue ball moved without ball in hand", s, "at 0.3,0.3 safety: 0>3 3-foot",
     "refused bad_cue_ball_position /cue_ball"},
    {"cue ball named where it lies", s, "at 0.558,0.8 safety: 0>3 3-foot",
     "-> second shot, solids"},
};

}  // namespace groups

namespace eight {

const std::string cleared = "8 shot solids " + solids_down;
const std::string last = "8 shot solids down 1 2 3 4 5 6";
const std::vector<Row> rows{
    {"eight calls", cleared, "calls", "pocket safety: 8"},
    {"eight targets", cleared, "targets", "8"},
    {"eight calls of the other player", "8 shot second solids " + solids_down, "calls",
     "pocket safety: 9 10 11 12 13 14 15"},
    {"eight when balls of the group are off", "8 shot solids down 1 2 3 4 5 6 off 7", "calls",
     "pocket safety: 8"},
    {"eight wins", cleared, "call 8 foot_left: 0>8 8@foot_left", "-> first wins eight_pocketed"},
    {"eight wins for stripes of the second seat", "8 shot second solids " + stripes_down,
     "call 8 side_left: 0>8 8@side_left", "-> second wins eight_pocketed"},
    {"eight wins with a ball of the opponent", cleared,
     "call 8 foot_left: 0>8 9@foot_right 8@foot_left", "-> first wins eight_pocketed"},
    {"eight missed", cleared, "call 8 foot_left: 0>8 8-foot", "-> second shot, solids"},
    {"eight missed and a foul is no loss", cleared, "call 8 foot_left: 0>8 8-foot 0@head_left",
     "scratch -> second ball_in_hand, solids"},
    {"eight missed and no rail", cleared, "call 8 foot_left: 0>8",
     "no_rail_after_contact -> second ball_in_hand, solids"},
    {"eight in another pocket", cleared, "call 8 foot_left: 0>8 8@foot_right",
     "-> second wins eight_wrong_pocket"},
    {"eight in another pocket and scratch", cleared,
     "call 8 foot_left: 0>8 8@foot_right 0@head_left", "scratch -> second wins eight_wrong_pocket"},
    {"eight and scratch", cleared, "call 8 foot_left: 0>8 8@foot_left 0@head_left",
     "scratch -> second wins eight_on_foul"},
    {"eight and wrong ball first", cleared, "call 8 foot_left: 0>9 9>8 8@foot_left",
     "wrong_ball_first -> second wins eight_on_foul"},
    {"eight and a ball off the table", cleared, "call 8 foot_left: 0>8 8@foot_left 9!",
     "ball_off_table -> second wins eight_on_foul"},
    {"eight and the cue ball off the table", cleared, "call 8 foot_left: 0>8 8@foot_left 0!",
     "ball_off_table -> second wins eight_on_foul"},
    {"eight on a safety", cleared, "safety: 0>8 8@foot_left", "-> second wins eight_on_safety"},
    {"eight on a safety with scratch", cleared, "safety: 0>8 8@foot_left 0@head_left",
     "scratch -> second wins eight_on_safety"},
    {"safety with the group cleared", cleared, "safety: 0>8 8-foot", "-> second shot, solids"},
    {"eight off the table", cleared, "call 8 foot_left: 0>8 8!",
     "ball_off_table -> second wins eight_off_table"},
    {"eight off the table and scratch", cleared, "call 8 foot_left: 0>8 8! 0@head_left",
     "scratch ball_off_table -> second wins eight_off_table"},
    {"eight early", "8 shot solids down 1", "call 3 foot_left: 0>3 3>8 8@foot_left",
     "-> second wins eight_early"},
    {"eight early with the called ball", "8 shot solids down 1",
     "call 3 foot_left: 0>3 3@foot_left 8@foot_left", "-> second wins eight_early"},
    {"eight early and scratch", "8 shot solids down 1",
     "call 3 foot_left: 0>3 8@foot_left 0@head_left", "scratch -> second wins eight_early"},
    {"eight early and wrong ball first", "8 shot solids down 1",
     "call 3 foot_left: 0>8 8@foot_left", "wrong_ball_first -> second wins eight_early"},
    {"eight early on a safety", "8 shot solids down 1", "safety: 0>3 8@foot_left",
     "-> second wins eight_early"},
    {"eight early off the table", "8 shot solids down 1", "call 3 foot_left: 0>3 8!",
     "ball_off_table -> second wins eight_off_table"},
    {"eight with the last ball", last, "call 7 foot_left: 0>7 7@foot_left 8@foot_left",
     "-> second wins eight_with_last"},
    {"eight before the last ball on one stroke", last,
     "call 7 foot_left: 0>7 8@foot_right 7@foot_left", "-> second wins eight_with_last"},
    {"eight with the last ball and scratch", last,
     "call 7 foot_left: 0>7 7@foot_left 8@foot_left 0@head_left",
     "scratch -> second wins eight_with_last"},
    {"eight with the last ball on a safety", last, "safety: 0>7 7@foot_left 8@foot_left",
     "-> second wins eight_with_last"},
    {"last ball goes on to the eight", last, "call 7 foot_left: 0>7 7@foot_left",
     "-> first shot, solids"},
    {"last ball and the eight struck first", last, "call 7 foot_left: 0>8 8>7 7@foot_left",
     "wrong_ball_first -> second ball_in_hand, solids"},
    {"own last ball pocketed by the opponent", "8 shot second solids down 1 2 3 4 5 6",
     "call 9 foot_left: 0>9 9>7 7@foot_left", "-> first shot, solids"},
};

}  // namespace eight

namespace in_hand {

const std::string anywhere = "8 ball_in_hand solids down 1";
const std::string behind = "8 ball_in_hand_behind_head_string down 1 0";
const std::vector<Row> rows{
    {"in hand anywhere", anywhere, "at 0.3,1.8 call 3 foot_left: 0>3 3@foot_left",
     "-> first shot, solids"},
    {"in hand anywhere may stay", anywhere, "call 3 foot_left: 0>3 3@foot_left",
     "-> first shot, solids"},
    {"in hand and not placed", "8 ball_in_hand solids down 1 0",
     "call 3 foot_left: 0>3 3@foot_left", "refused bad_cue_ball_position /cue_ball"},
    {"in hand on another ball", anywhere, "at 0.56,1.01 call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball"},
    {"in hand beyond a mouth line", anywhere, "at 0.04,0.04 call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball"},
    {"in hand off the table", anywhere, "at 2,2 call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball"},
    {"in hand touching a ball", anywhere, "at 0.558,0.94285 call 3 foot_left: 0>3 3@foot_left",
     "-> first shot, solids"},
    {"in hand anywhere may strike a ball in the kitchen", anywhere + " at 3 0.2,0.3",
     "at 0.2,0.1 call 3 head_left: 0>3 3@head_left", "-> first shot, solids"},
    {"in hand lost", anywhere, "lost refusals", "too_many_refusals -> second ball_in_hand, solids"},
    {"kitchen not placed", behind, "call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball"},
    {"kitchen placed beyond it", behind, "at 0.5,0.9 call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball/y"},
    {"kitchen placed on the line", behind, "at 0.5,0.559 call 3 foot_left: 0>3 3@foot_left",
     "refused bad_cue_ball_position /cue_ball/y"},
    {"kitchen and a ball outside", behind, "at 0.5,0.3 call 3 foot_left: 0>3 3@foot_left",
     "-> first shot, solids"},
    {"kitchen and a ball inside", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0>3 3@head_left", "kitchen -> second ball_in_hand"},
    {"kitchen and a ball on the line", behind + " at 3 0.2,0.559",
     "at 0.5,0.3 call 3 head_left: 0>3 3@head_left", "-> first shot, solids"},
    {"kitchen and a ball inside after leaving", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0-foot 0>3 3@head_left", "-> first shot, solids"},
    {"kitchen and a ball inside off its rail", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0-head 0>3 3@head_left", "kitchen -> second ball_in_hand"},
    {"kitchen ball inside, the eight", behind + " at 8 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0>8 8-head", "wrong_ball_first kitchen -> second ball_in_hand"},
    {"kitchen ball inside, no rail", behind + " at 3 0.2,0.3", "at 0.5,0.3 call 3 head_left: 0>3",
     "no_rail_after_contact kitchen -> second ball_in_hand"},
    {"kitchen ball inside, scratch", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0>3 0@head_left", "scratch kitchen -> second ball_in_hand"},
    {"kitchen ball outside first, then one inside", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0>4 0>3 3@head_left", "-> first shot, solids"},
    {"kitchen safety on a ball inside", behind + " at 3 0.2,0.3", "at 0.5,0.3 safety: 0>3 3-head",
     "kitchen -> second ball_in_hand"},
    {"kitchen foul by wrong ball outside", behind, "at 0.5,0.3 call 3 head_left: 0>8 8-foot",
     "wrong_ball_first -> second ball_in_hand"},
    {"kitchen eight early with a ball inside", behind + " at 3 0.2,0.3",
     "at 0.5,0.3 call 3 head_left: 0>3 8@head_left", "kitchen -> second wins eight_early"},
    {"kitchen safety and no contact", behind, "at 0.5,0.3 safety: 0-foot",
     "no_ball_hit -> second ball_in_hand"},
};

}  // namespace in_hand

// x = 0.028575 is frozen to the left rail.
namespace rail {

const std::string left = "8 shot solids down 1 at 3 0.028575,0.9";
const std::string foul = "no_rail_after_contact -> second ball_in_hand, solids";
const std::vector<Row> rows{
    {"frozen ball at its rail", left, "safety: 0>3 3-head_left", foul},
    {"frozen ball at its rail again and again", left,
     "safety: 0>3 3-head_left 3-head_left 3-head_left", foul},
    {"frozen ball away by half a millimetre", left, "safety: 0>3 3~0.029075,0.9 3-head_left", foul},
    {"frozen ball away by a millimetre", left, "safety: 0>3 3~0.029575,0.9 3-head_left",
     "-> second shot, solids"},
    {"frozen ball away and back", left, "safety: 0>3 3~0.2,0.9 3-head_left",
     "-> second shot, solids"},
    {"frozen ball at another rail", left, "safety: 0>3 3-head 3~0.3,0.3", "-> second shot, solids"},
    {"frozen ball pocketed", left, "call 3 head_left: 0>3 3@head_left", "-> first shot, solids"},
    {"frozen by a gap of a micrometre", "8 shot solids down 1 at 3 0.028576,0.9",
     "safety: 0>3 3-head_left", foul},
    {"not frozen at two micrometres", "8 shot solids down 1 at 3 0.028577,0.9",
     "safety: 0>3 3-head_left", "-> second shot, solids"},
    {"frozen cue ball back at its rail", "8 shot solids down 1 at 0 0.028575,0.8 at 3 0.085725,0.8",
     "safety: 0>3 0-head_left", foul},
    {"frozen cue ball away and back", "8 shot solids down 1 at 0 0.028575,0.8",
     "safety: 0>3 0-head_left", "-> second shot, solids"},
    {"frozen third ball driven by another", left, "safety: 0>4 4>3 3-head_left", foul},
    {"frozen ball and another driven", left, "safety: 0>3 3-head_left 0-head",
     "-> second shot, solids"},
    {"frozen to the foot rail", "8 shot solids down 1 at 3 0.3,2.207425", "safety: 0>3 3-foot",
     foul},
    {"frozen to the head rail", "8 shot solids down 1 at 3 0.3,0.028575", "safety: 0>3 3-head",
     foul},
    {"frozen to the right rail", "8 shot solids down 1 at 3 1.087425,1.5",
     "safety: 0>3 3-foot_right", foul},
    {"frozen ball of a break counts once away", "8 break at 1 0.028575,0.9",
     "none: 0>2 1-head_left 2-foot 3-foot 4-foot", "illegal_break -> " + illegal},
    {"frozen ball and wrong ball first", left, "safety: 0>12 12>3 3-head_left",
     "wrong_ball_first no_rail_after_contact -> second ball_in_hand, solids"},
};

}  // namespace rail

namespace simultaneous {

// The cue ball at (0.558, 0.9505122...) touches 3 and 12 at once.
const std::string s = "8 shot solids down 1 at 3 0.528,1 at 12 0.588,1 at 4 0.2,0.9";
const std::string touch = ":0.558,0.951350";
const std::vector<Row> rows{
    {"own ball and another at once", s,
     "call 3 foot_left: 0>12" + touch + " &0>3" + touch + " 3@foot_left", "-> first shot, solids"},
    {"another ball and own a nanosecond later", s,
     "call 3 foot_left: 0>12" + touch + " &0.9e-9:0>3" + touch + " 3@foot_left",
     "-> first shot, solids"},
    {"another ball and own ten nanoseconds later", s,
     "call 3 foot_left: 0>12" + touch + " &1e-8:0>3" + touch + " 3@foot_left",
     "wrong_ball_first -> second ball_in_hand, solids"},
    {"own ball first and another at once", s,
     "call 3 foot_left: 0>3" + touch + " &0>12" + touch + " 3@foot_left", "-> first shot, solids"},
    {"two wrong balls at once", "8 shot stripes down 9 at 3 0.528,1 at 2 0.588,1 at 12 0.9,0.9",
     "safety: 0>3" + touch + " &0>2" + touch + " 3-foot",
     "wrong_ball_first -> second ball_in_hand, stripes"},
    {"the eight and an own ball at once on an open table", "8 shot at 8 0.528,1 at 3 0.588,1",
     "call 3 foot_left: 0>8" + touch + " &0>3" + touch + " 3@foot_left", "-> first shot, solids"},
    {"no rail after two at once", s, "safety: 0>12" + touch + " &0>3" + touch,
     "no_rail_after_contact -> second ball_in_hand, solids"},
    {"frozen to an object ball, shot into it", "8 shot solids down 1 at 3 0.558,0.85715",
     "safety: &0>3 3-foot", "-> second shot, solids"},
    {"frozen to an object ball, shot away from it", "8 shot solids down 1 at 3 0.558,0.85715",
     "safety: 0-head", "no_ball_hit -> second ball_in_hand, solids"},
    {"frozen to a wrong ball, shot away to an own one", "8 shot solids down 1 at 12 0.558,0.85715",
     "safety: 0>4 4-foot", "-> second shot, solids"},
    {"frozen to a wrong ball, shot into it", "8 shot solids down 1 at 12 0.558,0.85715",
     "safety: &0>12 12-foot", "wrong_ball_first -> second ball_in_hand, solids"},
    {"kitchen: one inside and one outside at once",
     "8 ball_in_hand_behind_head_string down 1 at 0 0.558,0.3 at 3 0.528,0.558 at 4 0.588,0.56",
     "safety: 0>3:0.558,0.509 &0>4:0.558,0.509 4-foot", "-> second shot"},
};

}  // namespace simultaneous

namespace stalemate {

const std::string at29 = "8 shot second solids down 1 since 29";
const std::vector<Row> rows{
    {"thirtieth turn without a ball", at29, "safety: 0>12 12-foot", "-> first break"},
    {"twenty ninth turn without a ball", "8 shot second solids down 1 since 28",
     "safety: 0>12 12-foot", "-> first shot, solids"},
    {"thirtieth turn with a ball", at29, "safety: 0>12 12@foot_left", "-> first shot, solids"},
    {"thirtieth turn with only the cue ball down", at29, "safety: 0>12 12-foot 0@head_left",
     "scratch -> first break"},
    {"thirtieth turn with a foul", at29, "safety: 0>12", "no_rail_after_contact -> first break"},
    {"second stalemate", at29 + " stalemates 1", "safety: 0>12 12-foot", "-> drawn stalemate"},
    {"second stalemate with a foul", at29 + " stalemates 1", "safety: 0>3 3-foot",
     "wrong_ball_first -> drawn stalemate"},
    {"thirtieth turn lost", at29, "lost time", "shot_time_exceeded -> first break"},
    {"thirtieth turn is the losing eight", at29, "safety: 0>12 8!",
     "ball_off_table -> first wins eight_off_table"},
    {"thirtieth turn is an illegal break", "8 break since 29", "none: 0>1 1-foot",
     "illegal_break -> first break"},
    {"thirtieth turn of an impossible count", "8 shot since 30", "safety: 0>12 12-foot",
     "refused bad_state /turns_without_pocket"},
};

}  // namespace stalemate

namespace spotting {

const std::string own = "8 decision first down 8 spot_eight rerack_breaker_breaks";
const std::vector<Row> rows{
    {"eight spotted touching a ball", own + " at 3 0.558,1.65", "decide spot_eight",
     "first shot, 8 at 1.70715"},
    {"eight spotted clear of the cue ball", own + " at 0 0.558,1.65", "decide spot_eight",
     "first shot, 8 at 1.70716"},
    {"eight spotted clear of the cue ball behind a ball",
     own + " at 3 0.558,1.677 at 0 0.558,1.7913", "decide spot_eight", "first shot, 8 at 1.84846"},
    {"eight spotted towards the head, the string being full",
     own + " at 1 0.558,1.677 at 2 0.558,1.73415 at 3 0.558,1.7913 at 4 0.558,1.84845"
           " at 5 0.558,1.9056 at 6 0.558,1.96275 at 7 0.558,2.0199 at 9 0.558,2.07705"
           " at 10 0.558,2.1342 at 11 0.558,2.19135",
     "decide spot_eight", "first shot, 8 at 1.61985"},
};

}  // namespace spotting

}  // namespace

std::vector<Row> eight_ball_rows() {
  std::vector<Row> rows;
  for (const auto& part :
       {opening::rows, decisions::rows, open_table::rows, groups::rows, eight::rows, in_hand::rows,
        rail::rows, simultaneous::rows, stalemate::rows, spotting::rows}) {
    rows.insert(rows.end(), part.begin(), part.end());
  }
  return rows;
}

}  // namespace poolhall::rules::test
