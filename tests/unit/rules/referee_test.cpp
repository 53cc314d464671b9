// The referee's door: what is refused, what is said, how games end without a shot.
#include "rules/referee.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "physics/simulator.hpp"
#include "rule_rows.hpp"
#include "rules/nine_ball.hpp"

namespace poolhall::rules::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string state_refusal(const GameState& state) {
  const auto possible = check_state(state, row_table(), row_materials());
  return possible ? "" : possible.error().field;
}

TEST(CheckState, AcceptsANewGameOfEitherRuleSet) {
  for (const RuleSet rules : {RuleSet::eight_ball, RuleSet::nine_ball}) {
    EXPECT_EQ(state_refusal(new_game({.rules = rules}, row_table(), row_materials())), "");
  }
}

TEST(CheckState, RefusesWrongBalls) {
  GameState state = row_state("8 shot");
  state.balls.push_back({BallId{16}, Whereabouts::pocketed, {}, {}});
  EXPECT_EQ(state_refusal(state), "/balls");
  state = row_state("8 shot");
  state.balls.pop_back();
  EXPECT_EQ(state_refusal(state), "/balls");
  state = row_state("8 shot");
  state.balls[3].id = BallId{0};
  EXPECT_EQ(state_refusal(state), "/balls/3/id");
  state = row_state("9 shot");
  state.balls[9].id = BallId{15};
  EXPECT_EQ(state_refusal(state), "/balls/9/id");
  state = row_state("8 shot");
  state.balls.clear();
  EXPECT_EQ(state_refusal(state), "/balls");
}

TEST(CheckState, RefusesImpossiblePlaces) {
  EXPECT_EQ(state_refusal(row_state("8 shot at 5 0.159,1")), "/balls/5/x");
  EXPECT_EQ(state_refusal(row_state("8 shot at 5 0.01,1")), "/balls/5/x");
  EXPECT_EQ(state_refusal(row_state("8 shot at 5 0.5,2.3")), "/balls/5/y");
  EXPECT_EQ(state_refusal(row_state("8 shot down 3 at 5 0.5,2.3")), "/balls/5/y");
  EXPECT_EQ(state_refusal(row_state("8 shot at 5 0.04,0.04")), "/balls/5/x");
  GameState state = row_state("8 shot");
  state.balls[4].position.x = nan;
  EXPECT_EQ(state_refusal(state), "/balls/4");
  state = row_state("8 shot down 4");
  state.balls[4].pocket = static_cast<PocketId>(6);
  EXPECT_EQ(state_refusal(state), "/balls/4/pocket");
  state.balls[4].where = static_cast<Whereabouts>(9);
  EXPECT_EQ(state_refusal(state), "/balls/4");
}

TEST(CheckState, RefusesTurnsThatDoNotFit) {
  EXPECT_EQ(state_refusal(row_state("8 shot down 0")), "/balls/0");
  EXPECT_EQ(state_refusal(row_state("8 shot accept")), "/options");
  EXPECT_EQ(state_refusal(row_state("8 decision second")), "/options");
  EXPECT_EQ(state_refusal(row_state("8 decision second accept spot_eight")), "/options");
  EXPECT_EQ(state_refusal(row_state("8 decision first accept accept_ball_in_hand")), "/to_move");
  EXPECT_EQ(state_refusal(row_state("8 decision second down 8 spot_eight rerack_breaker_breaks")),
            "/to_move");
  EXPECT_EQ(state_refusal(row_state("8 decision first spot_eight rerack_breaker_breaks")),
            "/options");
  EXPECT_EQ(state_refusal(row_state("8 decision second down 8 accept accept_ball_in_hand")),
            "/options");
  EXPECT_EQ(state_refusal(row_state("9 decision second accept accept_ball_in_hand")), "/options");
  EXPECT_EQ(state_refusal(row_state("8 break down 3")), "/balls/3");
  GameState state = row_state("8 break");
  state.to_move = Seat::second;
  EXPECT_EQ(state_refusal(state), "/to_move");
  state = row_state("8 shot");
  state.kind = static_cast<TurnKind>(77);
  EXPECT_EQ(state_refusal(state), "/kind");
  state = row_state("8 shot");
  state.to_move = static_cast<Seat>(2);
  EXPECT_EQ(state_refusal(state), "/to_move");
  state = row_state("8 shot");
  state.breaker = static_cast<Seat>(2);
  EXPECT_EQ(state_refusal(state), "/breaker");
}

TEST(CheckState, RefusesResultsThatAreNone) {
  GameState state = row_state("8 shot");
  state.result = GameResult{Seat::first, static_cast<EndReason>(99)};
  EXPECT_EQ(state_refusal(state), "/result");
  state.result = GameResult{static_cast<Seat>(2), EndReason::conceded};
  EXPECT_EQ(state_refusal(state), "/result");
  state.result = GameResult{std::nullopt, EndReason::stalemate};
  EXPECT_EQ(state_refusal(state), "");
}

TEST(CheckState, RefusesCountersAndSettingsOutOfRange) {
  EXPECT_EQ(state_refusal(row_state("8 shot stalemates 2")), "/stalemates");
  GameState state = row_state("8 shot");
  state.turn = 0;
  EXPECT_EQ(state_refusal(state), "/turn");
  state = row_state("8 shot");
  state.rack = 0;
  EXPECT_EQ(state_refusal(state), "/rack");
  state = row_state("8 shot");
  state.settings.rack_gap = nan;
  EXPECT_EQ(state_refusal(state), "/settings/rack_gap");
  state = row_state("8 shot");
  state.settings.rack_seed = std::uint64_t{1} << 53;
  EXPECT_EQ(state_refusal(state), "/settings/rack_seed");
  state = row_state("8 shot");
  state.settings.rack_jitter = -1;
  EXPECT_EQ(state_refusal(state), "/settings/rack_jitter");
  state = row_state("8 shot");
  state.settings.rules = static_cast<RuleSet>(5);
  EXPECT_EQ(state_refusal(state), "/rules");
}

TEST(CheckState, RefusesAMemoryThatDoesNotFitTheBalls) {
  EXPECT_EQ(state_refusal(row_state("8 shot solids")), "/groups");
  EXPECT_EQ(state_refusal(row_state("8 shot solids off 3")), "/groups");
  EXPECT_EQ(state_refusal(row_state("8 break stripes")), "/groups");
  EXPECT_EQ(state_refusal(row_state("8 shot down 8")), "/balls/8");
  EXPECT_EQ(state_refusal(row_state("9 shot down 9")), "/balls/9");
  EXPECT_EQ(state_refusal(row_state("9 ball_in_hand push")), "/push_out_allowed");
  GameState state = row_state("8 shot");
  state.memory = NineBallMemory{};
  EXPECT_EQ(state_refusal(state), "/rules");
  state = row_state("9 shot");
  state.memory = EightBallMemory{};
  EXPECT_EQ(state_refusal(state), "/rules");
}

TEST(CheckSettings, WantsATableThatARackFitsOn) {
  physics::Table table = row_table();
  EXPECT_TRUE(check_settings({}, table, row_materials()));
  table.foot_spot_y = 2.1;
  const auto cramped = check_settings({}, table, row_materials());
  ASSERT_FALSE(cramped);
  EXPECT_EQ(cramped.error().field, "/table");
  table = row_table();
  table.pockets = physics::NoPockets{};
  EXPECT_FALSE(check_settings({}, table, row_materials()));
}

TEST(CheckSettings, NamesTheNumberThatIsOutOfRange) {
  const auto checked = check_settings({.rack_gap = 1}, row_table(), row_materials());
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().field, "/rack_gap");
}

std::string log_refusal(const std::string& state, const physics::EventLog<double>& log) {
  const auto ruling =
      judge(row_state(state), {Call::Kind::safety, {}, {}}, log, row_table(), row_materials());
  return ruling ? "" : std::string(name(ruling.error().code)) + " " + ruling.error().field;
}

physics::EventLog<double> good_log() {
  return row_log(row_state("8 shot"), "0>3 3-foot");
}

TEST(Judge, RefusesALogThatIsNone) {
  EXPECT_EQ(log_refusal("8 shot", good_log()), "");
  EXPECT_EQ(log_refusal("8 shot", {}), "bad_event_log /events");
  auto log = good_log();
  log.erase(log.begin());
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events/0/type");
  log = good_log();
  log.insert(log.begin(), log.front());
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events/1/type");
  log = good_log();
  log[0].after[0].id = BallId{3};
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events/0");
  log = good_log();
  log[0].t = 0.001;
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events/0");
}

TEST(Judge, RefusesEventsWithoutForm) {
  const auto changed = [](auto change) {
    auto log = good_log();
    change(log);
    return log_refusal("8 shot", log);
  };
  EXPECT_EQ(changed([](auto& log) { log[1].t = nan; }), "bad_event_log /events/1/t");
  EXPECT_EQ(changed([](auto& log) { log[1].t = -1; }), "bad_event_log /events/1/t");
  EXPECT_EQ(changed([](auto& log) { log[2].t = log[1].t - 1e-3; }), "bad_event_log /events/2/t");
  EXPECT_EQ(changed([](auto& log) { log[1].ball_count = 1; }), "bad_event_log /events/1/balls");
  EXPECT_EQ(changed([](auto& log) { log[2].ball_count = 200; }), "bad_event_log /events/2/balls");
  EXPECT_EQ(changed([](auto& log) { log[1].after[1].id = BallId{0}; }),
            "bad_event_log /events/1/balls");
  EXPECT_EQ(changed([](auto& log) { log[1].after[1].id = BallId{77}; }),
            "bad_event_log /events/1/balls/1");
  EXPECT_EQ(changed([](auto& log) { log[2].rail.reset(); }), "bad_event_log /events/2/rail");
  EXPECT_EQ(changed([](auto& log) { log[2].rail = static_cast<physics::RailId>(9); }),
            "bad_event_log /events/2/rail");
  EXPECT_EQ(changed([](auto& log) { log[1].rail = physics::RailId::head; }),
            "bad_event_log /events/1/rail");
  EXPECT_EQ(changed([](auto& log) { log[1].pocket = PocketId::foot_left; }),
            "bad_event_log /events/1/pocket");
  EXPECT_EQ(changed([](auto& log) { log[2].type = physics::EventType::pocketed; }),
            "bad_event_log /events/2/rail");
  EXPECT_EQ(changed([](auto& log) { log[2].type = static_cast<physics::EventType>(99); }),
            "bad_event_log /events/2/type");
  EXPECT_EQ(changed([](auto& log) { log[2].until = 0; }), "bad_event_log /events/2/until");
  EXPECT_EQ(changed([](auto& log) { log[1].after[0].position.y = nan; }),
            "bad_event_log /events/1/after/0");
  EXPECT_EQ(
      changed([](auto& log) { log[1].after[0].state = static_cast<physics::MotionState>(9); }),
      "bad_event_log /events/1/after/0");
  EXPECT_EQ(changed([](auto& log) { log[2].after[0].state = physics::MotionState::pocketed; }),
            "bad_event_log /events/2/after/0/state");
}

TEST(Judge, RefusesAPocketedBallThatStillMovesOrIsInNoPocket) {
  const auto log = row_log(row_state("8 shot"), "0>3 3@foot_left");
  auto moves = log;
  moves[2].after[0].state = physics::MotionState::rolling;
  EXPECT_EQ(log_refusal("8 shot", moves), "bad_event_log /events/2/after/0/state");
  auto nowhere = log;
  nowhere[2].pocket = static_cast<PocketId>(6);
  EXPECT_EQ(log_refusal("8 shot", nowhere), "bad_event_log /events/2/pocket");
}

TEST(Judge, RefusesAPocketThatIsNone) {
  const Call call{Call::Kind::pocket, BallId{3}, static_cast<PocketId>(6)};
  const auto ruling = judge(row_state("8 shot"), call, good_log(), row_table(), row_materials());
  ASSERT_FALSE(ruling);
  EXPECT_EQ(ruling.error().code, RefusalCode::bad_call);
  EXPECT_EQ(ruling.error().field, "/call/pocket");
}

TEST(Judge, RefusesALogOfAnotherState) {
  EXPECT_EQ(log_refusal("8 shot down 3", good_log()), "bad_event_log /events/1/balls/1");
  EXPECT_EQ(log_refusal("8 shot off 3", good_log()), "bad_event_log /events/1/balls/1");
  EXPECT_EQ(log_refusal("8 shot at 3 0.6,1.1", good_log()), "bad_event_log /events/1/after/1");
  EXPECT_EQ(log_refusal("8 shot at 0 0.5,0.5", good_log()), "bad_event_log /events/0/after/0");
  EXPECT_EQ(log_refusal("8 shot at 5 0.558,2.2", good_log()), "bad_event_log /events");
  auto twice = row_log(row_state("8 shot"), "0>3 3@foot_left");
  twice.push_back(good_log()[2]);
  twice.back().t = 1;
  EXPECT_EQ(log_refusal("8 shot", twice), "bad_event_log /events/3/balls/0");
}

TEST(Judge, RefusesALogThatBreaksTheMotionLawsOrStopsTooEarly) {
  auto log = row_log(row_state("8 shot"), "0>3 3~0.6,1.2 3~0.7,1.3");
  EXPECT_EQ(log_refusal("8 shot", log), "");
  log[3].after[0].position.x += 0.02;
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events/3/after/0");
  log.pop_back();
  EXPECT_EQ(log_refusal("8 shot", log), "bad_event_log /events");
}

TEST(Judge, ReadsALogWithoutTheBallsStates) {
  auto log = row_log(row_state("8 shot"), "0>3 3@foot_left");
  for (auto& event : log) {
    for (auto& ball : event.after) {
      ball = {.id = ball.id};
    }
  }
  const auto ruling =
      judge(row_state("8 shot"), {Call::Kind::pocket, BallId{3}, PocketId::foot_left}, log,
            row_table(), row_materials());
  ASSERT_TRUE(ruling);
  EXPECT_EQ(described(*ruling), "-> first shot, solids");
  EXPECT_EQ(ruling->next.balls[0], row_state("8 shot").balls[0]);
}

TEST(Judge, RefusesStatesAndCallsBeforeLogs) {
  const auto over = ended(row_state("8 shot"), {Seat::first, EndReason::conceded});
  const auto ruling =
      judge(over, {Call::Kind::safety, {}, {}}, good_log(), row_table(), row_materials());
  ASSERT_FALSE(ruling);
  EXPECT_EQ(ruling.error().code, RefusalCode::bad_shot);
  EXPECT_EQ(log_refusal("8 break", good_log()), "bad_call /call");
  EXPECT_EQ(log_refusal("8 shot solids", good_log()), "bad_state /groups");
}

TEST(Ruling, NamesFoulsPocketedBallsAndTheirEvents) {
  const GameState state = row_state("8 shot solids down 1");
  const auto ruling =
      judge(state, {Call::Kind::pocket, BallId{3}, PocketId::foot_left},
            row_log(state, "0>12 3@foot_right 0@head_left 4!"), row_table(), row_materials());
  ASSERT_TRUE(ruling);
  EXPECT_FALSE(ruling->legal);
  ASSERT_EQ(ruling->fouls.size(), 3U);
  EXPECT_EQ(ruling->fouls[0].code, FoulCode::scratch);
  EXPECT_EQ(ruling->fouls[0].event, 3U);
  EXPECT_EQ(ruling->fouls[0].rule, "6.1");
  EXPECT_EQ(ruling->fouls[1].code, FoulCode::wrong_ball_first);
  EXPECT_EQ(ruling->fouls[1].event, 1U);
  EXPECT_EQ(ruling->fouls[2].code, FoulCode::ball_off_table);
  EXPECT_EQ(ruling->fouls[2].event, 4U);
  EXPECT_EQ(ruling->first_contact, BallId{12});
  ASSERT_EQ(ruling->pocketed.size(), 2U);
  EXPECT_EQ(ruling->pocketed[0], (PocketedBall{BallId{3}, PocketId::foot_right, 2}));
  EXPECT_EQ(ruling->pocketed[1], (PocketedBall{BallId{0}, PocketId::head_left, 3}));
  EXPECT_EQ(ruling->driven_off, std::vector{BallId{4}});
  EXPECT_EQ(ruling->next.balls[4].where, Whereabouts::off_table);
  EXPECT_EQ(ruling->next.turn, state.turn + 1);
  EXPECT_FALSE(ruling->notes.empty());
}

TEST(Ruling, CountsTurnsWithoutAPocketedBall) {
  const GameState state = row_state("8 shot since 4");
  const Call safety{Call::Kind::safety, {}, {}};
  const auto dry = judge(state, safety, good_log(), row_table(), row_materials());
  const auto down =
      judge(state, safety, row_log(state, "0>3 3@foot_left"), row_table(), row_materials());
  ASSERT_TRUE(dry && down);
  EXPECT_EQ(dry->next.turns_without_pocket, 5U);
  EXPECT_EQ(down->next.turns_without_pocket, 0U);
  EXPECT_EQ(judge_lost_turn(state, FoulCode::shot_time_exceeded, row_table(), row_materials())
                .next.turns_without_pocket,
            5U);
}

TEST(Ruling, OfTheSameLogIsTheSame) {
  const GameState state = row_state("8 shot");
  const Call safety{Call::Kind::safety, {}, {}};
  EXPECT_EQ(judge(state, safety, good_log(), row_table(), row_materials()).value(),
            judge(state, safety, good_log(), row_table(), row_materials()).value());
}

// A ball that leaves its rail and comes back to it without an event in between: struck along the
// rail with a raised cue, it curves. The referee finds the way between two events.
TEST(FrozenBall, IsAwayWhereItCurvesAwayAndBackBetweenTwoEvents) {
  const auto curved = [](double across) {
    GameState state = row_state("8 shot solids down 1 at 3 0.028575,0.9");
    auto log = row_log(state, "0>3");
    physics::Ball<double>& ball = log[1].after[1];
    ball.state = physics::MotionState::sliding;
    ball.velocity = {across, 0.5};
    // The slip points away from the rail, so that friction brings the ball back to it.
    ball.angular_velocity = {-0.5 / row_materials().ball_radius, -100, 0};
    const double back = 2 * across / (row_materials().mu_slide * row_materials().gravity);
    physics::Event<double> rail;
    rail.t = log[1].t + back;
    rail.type = physics::EventType::rail_collision;
    rail.rail = physics::RailId::head_left;
    rail.after[0].id = BallId{3};
    rail.after[0].position = {0.028575, 0.9 + 0.5 * back};
    log.push_back(rail);
    const auto ruling =
        judge(state, {Call::Kind::safety, {}, {}}, log, row_table(), row_materials());
    return ruling ? described(*ruling) : ruling.error().reason;
  };
  // It comes across^2 / (2 mu g) from the rail: 0.9 mm and 1.1 mm.
  EXPECT_EQ(curved(0.05942), "no_rail_after_contact -> second ball_in_hand, solids");
  EXPECT_EQ(curved(0.06570), "-> second shot, solids");
}

// The cue ball leaves the kitchen, spins back and strikes a ball in it, without an event between.
TEST(Kitchen, IsLeftWhereTheCueBallCrossesTheHeadStringBetweenTwoEvents) {
  const auto drawn = [](double speed) {
    const GameState state =
        row_state("8 ball_in_hand_behind_head_string down 1 at 0 0.5,0.55 at 3 0.5,0.4");
    physics::EventLog<double> log = row_log(state, "0>3 3-head");
    physics::Ball<double>& ball = log[0].after[0];
    ball.state = physics::MotionState::sliding;
    ball.velocity = {0, speed};
    ball.angular_velocity = {400, 0, 0};
    const double slowing = row_materials().mu_slide * row_materials().gravity;
    const double way = 0.55 - (0.4 + 2 * row_materials().ball_radius);
    const double time = (speed + std::sqrt(speed * speed + 2 * slowing * way)) / slowing;
    for (std::size_t i = 1; i < log.size(); ++i) {
      log[i].t += time - 0.01;
    }
    const auto ruling =
        judge(state, {Call::Kind::safety, {}, {}}, log, row_table(), row_materials());
    return ruling ? described(*ruling) : ruling.error().field + " " + ruling.error().reason;
  };
  // The head string is 9 mm ahead: it comes speed^2 / (2 mu g) far, 8.2 mm and 10.2 mm.
  EXPECT_EQ(drawn(0.18), "kitchen -> second ball_in_hand");
  EXPECT_EQ(drawn(0.20), "-> second shot");
}

TEST(JawTable, KnowsABallFrozenToAJaw) {
  const auto table = physics::preset_table("bar7").value();
  const auto materials = physics::preset_materials("modern").value();
  GameState state = new_game({}, table, materials);
  state.kind = TurnKind::shot;
  const double y = materials.ball_radius + 1e-7;
  state.balls[3].position = {0.3, y};
  const auto log_to = [&](physics::RailId rail) {
    physics::EventLog<double> log = row_log(state, "0>3");
    physics::Event<double> event;
    event.t = 1;
    event.type = physics::EventType::rail_collision;
    event.rail = rail;
    event.after[0].id = BallId{3};
    event.after[0].position = {0.3, y};
    log.push_back(event);
    const auto ruling = judge(state, {Call::Kind::safety, {}, {}}, log, table, materials);
    return ruling ? ruling->legal : false;
  };
  EXPECT_FALSE(log_to(physics::RailId::head));
  EXPECT_TRUE(log_to(physics::RailId::head_left));
}

TEST(Referee, SurvivesStatesThatAreNone) {
  const Call safety{Call::Kind::safety, {}, {}};
  for (const RuleSet rules : {RuleSet::eight_ball, RuleSet::nine_ball}) {
    GameState empty;
    empty.settings.rules = rules;
    empty.kind = TurnKind::ball_in_hand;
    EXPECT_TRUE(callable_balls(empty).empty());
    EXPECT_TRUE(legal_first_balls(empty).empty());
    EXPECT_EQ(balls_on_table(empty).count, 0U);
    const auto ready =
        prepare_shot(empty, safety, physics::Vec2<double>{0.5, 0.5}, row_table(), row_materials());
    ASSERT_FALSE(ready);
    EXPECT_EQ(ready.error().code, RefusalCode::bad_state);
    empty.kind = TurnKind::decision;
    empty.options = {Decision::shoot};
    EXPECT_FALSE(decide(empty, Decision::shoot, row_table(), row_materials()));
    EXPECT_FALSE(judge(empty, safety, good_log(), row_table(), row_materials()));
    GameState other_game = row_state(rules == RuleSet::eight_ball ? "8 shot" : "9 shot");
    other_game.memory = rules == RuleSet::eight_ball
                            ? std::variant<EightBallMemory, NineBallMemory>(NineBallMemory{})
                            : std::variant<EightBallMemory, NineBallMemory>(EightBallMemory{});
    EXPECT_FALSE(legal_calls(other_game).empty());
    EXPECT_FALSE(legal_first_balls(other_game).empty());
    EXPECT_FALSE(prepare_shot(other_game, safety, {}, row_table(), row_materials()));
  }
}

TEST(Ended, KeepsTheFirstEnd) {
  const GameState conceded = ended(row_state("8 shot"), {Seat::second, EndReason::conceded});
  ASSERT_TRUE(conceded.result);
  EXPECT_EQ(conceded.result->winner, Seat::second);
  EXPECT_EQ(ended(conceded, {Seat::first, EndReason::timeout}), conceded);
  EXPECT_TRUE(check_state(conceded, row_table(), row_materials()));
  EXPECT_TRUE(callable_balls(conceded).empty());
  EXPECT_TRUE(legal_calls(conceded).empty());
  EXPECT_TRUE(legal_first_balls(conceded).empty());
  EXPECT_FALSE(decide(conceded, Decision::accept, row_table(), row_materials()));
  const Ruling late =
      judge_lost_turn(conceded, FoulCode::shot_time_exceeded, row_table(), row_materials());
  EXPECT_EQ(late.next, conceded);
}

TEST(Names, ComeBackFromTheWire) {
  EXPECT_EQ(rule_set("9-ball"), RuleSet::nine_ball);
  EXPECT_EQ(rule_set("nine-ball"), RuleSet::nine_ball);
  EXPECT_EQ(rule_set("eight-ball"), RuleSet::eight_ball);
  EXPECT_EQ(name(RuleSet::eight_ball), "8-ball");
  EXPECT_FALSE(rule_set("snooker"));
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(turn_kind(name(static_cast<TurnKind>(i))), static_cast<TurnKind>(i));
  }
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(decision(name(static_cast<Decision>(i))), static_cast<Decision>(i));
  }
  for (int i = 0; i < 14; ++i) {
    EXPECT_EQ(end_reason(name(static_cast<EndReason>(i))), static_cast<EndReason>(i));
  }
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(foul_code(name(static_cast<FoulCode>(i))), static_cast<FoulCode>(i));
  }
  EXPECT_EQ(group("solids"), Group::solids);
  EXPECT_EQ(group("stripes"), Group::stripes);
  EXPECT_FALSE(group("both"));
  EXPECT_EQ(name(RefusalCode::bad_event_log), "bad_event_log");
}

}  // namespace
}  // namespace poolhall::rules::test
