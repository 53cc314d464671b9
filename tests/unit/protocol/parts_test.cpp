// States, calls, rulings, events, tables and materials as JSON.
#include <gtest/gtest.h>

#include <cmath>

#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"
#include "protocol/table_json.hpp"
#include "tests/support/sample_messages.hpp"

namespace poolhall::protocol {
namespace {

using test_support::played_break;

TEST(StateJson, ComesBackEqual) {
  for (const auto rules : {rules::RuleSet::eight_ball, rules::RuleSet::nine_ball}) {
    const auto played = played_break(rules);
    for (const rules::GameState& state : {played.before, played.ruling.next}) {
      const auto again = decode_state(encode_state(state));
      ASSERT_TRUE(again) << again.error().field << ": " << again.error().reason;
      EXPECT_EQ(*again, state);
    }
  }
}

TEST(StateJson, KeepsGroupsOptionsMemoryAndResult) {
  rules::GameState state = played_break(rules::RuleSet::eight_ball).before;
  state.memory = rules::EightBallMemory{rules::Group::stripes};
  state.kind = rules::TurnKind::decision;
  state.options = {rules::Decision::accept, rules::Decision::spot_eight};
  state.balls[3].where = rules::Whereabouts::off_table;
  state.balls[3].position = {};
  state.balls[4].where = rules::Whereabouts::pocketed;
  state.balls[4].position = {};
  state.balls[4].pocket = physics::PocketId::side_right;
  state.result = rules::GameResult{std::nullopt, rules::EndReason::stalemate};
  EXPECT_EQ(*decode_state(encode_state(state)), state);
  const std::string text = encode_state(state);
  EXPECT_NE(text.find(R"("open_table":false,"groups":["stripes","solids"])"), std::string::npos);
  EXPECT_NE(text.find(R"({"id":4,"pocket":"side_right"})"), std::string::npos);
  EXPECT_NE(text.find(R"({"id":3,"off_table":true})"), std::string::npos);
}

TEST(StateJson, KeepsNineBallsMemory) {
  rules::GameState state = played_break(rules::RuleSet::nine_ball).before;
  state.memory = rules::NineBallMemory{{2, 1}, true};
  EXPECT_EQ(*decode_state(encode_state(state)), state);
}

TEST(StateJson, SaysWhereTheCueBallMayBePlaced) {
  rules::GameState state = played_break(rules::RuleSet::eight_ball).before;
  const auto said = [&](rules::TurnKind kind) {
    state.kind = kind;
    const std::string text = encode_state(state);
    const std::string key = "\"ball_in_hand\":";
    const std::size_t at = text.find(key) + key.size();
    return text.substr(at, text.find(',', at) - at);
  };
  EXPECT_EQ(said(rules::TurnKind::break_shot), "\"behind_head_string\"");
  EXPECT_EQ(said(rules::TurnKind::ball_in_hand), "\"anywhere\"");
  EXPECT_EQ(said(rules::TurnKind::ball_in_hand_behind_head_string), "\"behind_head_string\"");
  EXPECT_EQ(said(rules::TurnKind::shot), "null");
}

TEST(StateJson, NamesTheFieldThatDoesNotFit) {
  std::string text = encode_state(played_break(rules::RuleSet::eight_ball).before);
  const std::string from = "\"to_move\":0";
  text.replace(text.find(from), from.size(), "\"to_move\":2");
  EXPECT_EQ(decode_state(text).error().field, "/to_move");
  EXPECT_EQ(decode_state("[]").error().field, "");
}

TEST(RulingJson, TellsFoulsAndTheNextTurn) {
  rules::Ruling ruling = played_break(rules::RuleSet::eight_ball).ruling;
  ruling.legal = false;
  ruling.fouls = {{rules::FoulCode::scratch, "8.6", "The cue ball was pocketed.", 4},
                  {rules::FoulCode::too_many_refusals, "1.9", "Three \"refusals\".", {}}};
  ruling.pocketed = {{physics::BallId{0}, physics::PocketId::head_left, 4}};
  ruling.driven_off = {physics::BallId{9}};
  ruling.notes = {{"8.2", "Open table.", {}}};
  const auto report = decode_ruling(encode_ruling(ruling));
  ASSERT_TRUE(report) << report.error().field;
  EXPECT_FALSE(report->legal);
  EXPECT_EQ(report->fouls, ruling.fouls);
  EXPECT_EQ(report->pocketed, ruling.pocketed);
  EXPECT_EQ(report->driven_off, ruling.driven_off);
  EXPECT_EQ(report->notes, ruling.notes);
  EXPECT_EQ(report->first_contact, ruling.first_contact);
  EXPECT_EQ(report->next.turn, ruling.next.turn);
  EXPECT_EQ(report->next.kind, ruling.next.kind);
  EXPECT_EQ(report->next.to_move, ruling.next.to_move);
}

TEST(CallJson, ComesBackEqual) {
  using Kind = rules::Call::Kind;
  for (const rules::Call& call :
       {rules::Call{}, rules::Call{Kind::safety, {}, {}}, rules::Call{Kind::push_out, {}, {}},
        rules::Call{Kind::pocket, physics::BallId{15}, physics::PocketId::foot_right}}) {
    EXPECT_EQ(*decode_call(encode_call(call)), call);
  }
}

TEST(EventsJson, ComeBackBitForBit) {
  const auto events = played_break(rules::RuleSet::eight_ball).events;
  ASSERT_GT(events.size(), 20U);
  const std::string text = encode_events(events, EventDetail::full);
  const auto again = decode_events(text);
  ASSERT_TRUE(again) << again.error().field;
  ASSERT_EQ(again->size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ((*again)[i].t, events[i].t);
    EXPECT_EQ((*again)[i].rail, events[i].rail);
    EXPECT_EQ((*again)[i].pocket, events[i].pocket);
    ASSERT_EQ((*again)[i].ball_count, events[i].ball_count);
    for (std::size_t k = 0; k < events[i].ball_count; ++k) {
      const auto& was = events[i].after[k];
      const auto& is = (*again)[i].after[k];
      EXPECT_EQ(is.id, was.id);
      EXPECT_EQ(is.state, was.state);
      EXPECT_EQ(is.position, was.position);
      EXPECT_EQ(is.velocity, was.velocity);
      EXPECT_EQ(is.angular_velocity, was.angular_velocity);
      EXPECT_EQ(is.pocket, was.pocket);
    }
  }
  EXPECT_EQ(encode_events(*again, EventDetail::full), text);
}

TEST(EventsJson, LeaveTheBallsStatesOutOfASummary) {
  const auto events = played_break(rules::RuleSet::eight_ball).events;
  const std::string text = encode_events(events, EventDetail::summary);
  EXPECT_EQ(text.find("after"), std::string::npos);
  const auto again = decode_events(text);
  ASSERT_TRUE(again);
  EXPECT_EQ((*again)[1].after[0].id, events[1].after[0].id);
}

TEST(EventsJson, AreSummedUpFromTheirTextAsFromTheirValues) {
  for (const auto rules : {rules::RuleSet::eight_ball, rules::RuleSet::nine_ball}) {
    const auto events = played_break(rules).events;
    EXPECT_EQ(summary_of(encode_events(events, EventDetail::full)),
              encode_events(events, EventDetail::summary));
  }
  EXPECT_EQ(summary_of("[]"), "[]");
}

TEST(EventsJson, KeepHopsThatStandInOneEntry) {
  physics::Event<double> event;
  event.t = 1;
  event.type = physics::EventType::rail_collision;
  event.rail = physics::RailId::foot;
  event.count = 12;
  event.until = 1.25;
  const auto again = decode_events(encode_events({event}, EventDetail::full));
  EXPECT_EQ((*again)[0].count, 12U);
  EXPECT_EQ((*again)[0].until, 1.25);
}

TEST(EventsJson, KeepTheSignOfZeroAndTheSmallestNumbers) {
  physics::Event<double> event;
  event.after[0].velocity = {-0.0, 5e-324};
  event.after[0].angular_velocity = {1e300, -1.7976931348623157e308, 0.1};
  const auto again = decode_events(encode_events({event}, EventDetail::full));
  ASSERT_TRUE(again);
  const auto& ball = (*again)[0].after[0];
  EXPECT_TRUE(std::signbit(ball.velocity.x));
  EXPECT_EQ(ball.velocity.y, 5e-324);
  EXPECT_EQ(ball.angular_velocity, event.after[0].angular_velocity);
}

TEST(TableJson, GivesEveryPresetBack) {
  for (const std::string& name : physics::preset_table_names()) {
    const std::string text = encode_table(*physics::preset_table(name));
    const auto again = decode_table(text);
    ASSERT_TRUE(again) << again.error().field;
    EXPECT_EQ(encode_table(*again), text);
    EXPECT_EQ(encode_table(*decode_table('"' + name + '"')), text);
  }
}

TEST(TableJson, PutsTheSpotsWhereTheyBelongUnlessToldOtherwise) {
  const auto table = decode_table(R"({"width":1,"length":2,"pockets":"none"})");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->head_string, 0.5);
  EXPECT_EQ(table->foot_spot_x, 0.5);
  EXPECT_EQ(table->foot_spot_y, 1.5);
  const auto moved = decode_table(
      R"({"width":1,"length":2,"pockets":"none","head_string":0.4,"foot_spot":{"x":0.6,"y":1.4}})");
  EXPECT_EQ(moved->head_string, 0.4);
  EXPECT_EQ(moved->foot_spot_y, 1.4);
}

TEST(TableJson, NamesTheFieldThatDoesNotFit) {
  const auto field = [](std::string_view text) { return decode_table(text).error().field; };
  EXPECT_EQ(field(R"("kitchen")"), "");
  EXPECT_NE(decode_table(R"("kitchen")").error().reason.find("\"olympiad\""), std::string::npos);
  EXPECT_EQ(field(R"({"width":1,"pockets":"none"})"), "/length");
  EXPECT_EQ(field(R"({"width":1,"length":2,"pockets":"some"})"), "/pockets");
  EXPECT_EQ(field(R"({"width":1,"length":2,"pockets":{"kind":"mouth_lines","corner":1}})"),
            "/pockets/side");
  EXPECT_EQ(field(R"({"width":1,"length":2,"pockets":{"kind":"holes"}})"), "/pockets/kind");
  EXPECT_EQ(field(R"({"width":1,"length":2,"pockets":"none","colour":"green"})"), "/colour");
}

TEST(MaterialsJson, GivesEveryPresetBack) {
  for (const std::string& name : physics::preset_material_names()) {
    const std::string text = encode_materials(*physics::preset_materials(name));
    const auto again = decode_materials(text);
    ASSERT_TRUE(again) << again.error().field;
    EXPECT_EQ(encode_materials(*again), text);
  }
}

TEST(MaterialsJson, OverridesAPreset) {
  const auto m = decode_materials(
      R"({"preset":"modern","mu_roll":0.02,"ball_friction":0.06,"cushion":{"model":"han2005","friction":0.3}})");
  ASSERT_TRUE(m) << m.error().field;
  const auto modern = physics::preset_materials("modern").value();
  EXPECT_EQ(m->mu_roll, 0.02);
  EXPECT_EQ(m->mu_slide, modern.mu_slide);
  EXPECT_EQ(std::get<physics::ConstantFriction>(m->ball_friction).coefficient, 0.06);
  EXPECT_EQ(std::get<physics::Han2005Cushion>(m->cushion).friction, 0.3);
  EXPECT_EQ(std::get<physics::Han2005Cushion>(m->cushion).restitution,
            std::get<physics::Han2005Cushion>(modern.cushion).restitution);
}

TEST(MaterialsJson, TakesOneOfTheTwoWaysToSlowSideSpin) {
  const auto given = decode_materials(R"({"preset":"olympiad","spin_deceleration":10})");
  EXPECT_FALSE(given->mu_spin);
  EXPECT_EQ(given->spin_deceleration, 10);
  const auto law = decode_materials(R"({"preset":"modern","mu_spin":0.05})");
  EXPECT_EQ(law->mu_spin, 0.05);
  EXPECT_FALSE(law->spin_deceleration);
  EXPECT_EQ(
      decode_materials(R"({"preset":"modern","mu_spin":0.05,"spin_deceleration":1})").error().field,
      "/spin_deceleration");
}

TEST(MaterialsJson, NamesTheFieldThatDoesNotFit) {
  const auto field = [](std::string_view text) { return decode_materials(text).error().field; };
  EXPECT_EQ(field(R"({"preset":"ice"})"), "/preset");
  EXPECT_EQ(field(R"({"preset":"modern","mu_slid":1})"), "/mu_slid");
  EXPECT_EQ(field(R"({"ball_friction":"much"})"), "/ball_friction");
  EXPECT_EQ(field(R"({"cushion":{"normal":1}})"), "/cushion/model");
  EXPECT_EQ(field(R"({"cushion":{"model":"damped","friction":1}})"), "/cushion/friction");
  EXPECT_EQ(field(R"({"gravity":"9.81"})"), "/gravity");
}

}  // namespace
}  // namespace poolhall::protocol
