#include "protocol/judge_document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "protocol/json_node.hpp"

namespace poolhall::protocol {
namespace {

// Balls of an 8-ball state: those of `down` pocketed, the others somewhere free.
std::string balls(std::initializer_list<int> down = {}) {
  std::string text = R"([{"id":0,"x":0.558,"y":0.8})";
  for (int n = 1; n < 16; ++n) {
    text += R"(,{"id":)" + std::to_string(n);
    if (std::find(down.begin(), down.end(), n) != down.end()) {
      text += R"(,"pocket":"side_left"})";
    } else {
      const int row = (n - 1) / 5;
      text += ",\"x\":" + std::to_string(0.158 + 0.2 * ((n - 1) % 5)) +
              ",\"y\":" + std::to_string(1.0 + 0.25 * row) + "}";
    }
  }
  return text + "]";
}

std::string document(const std::string& state, const std::string& rest) {
  return R"({"state":{"balls":)" + state + "}," + rest + "}";
}

constexpr const char* soft_shot = R"("shot":{"a":0,"b":0,"theta":5,"phi":90,"v":3})";

std::string part(const std::string& answer, std::string_view key) {
  const auto parsed = parse_json(answer, document_bounds);
  const JsonValue* member = parsed ? parsed->member(key) : nullptr;
  return member == nullptr ? "" : canonical_text(*member);
}

std::string field(const std::string& text) {
  const auto answer = judge_document(text);
  return answer ? "accepted" : answer.error().field;
}

TEST(JudgeDocument, SimulatesAShotAndJudgesItsLogTheSame) {
  const std::string call = R"("call":{"ball":3,"pocket":"foot_left"},)";
  const auto simulated = judge_document(document(balls(), call + soft_shot));
  ASSERT_TRUE(simulated) << simulated.error().reason;
  const std::string events = part(*simulated, "events");
  const auto judged = judge_document(document(balls(), call + "\"events\":" + events));
  ASSERT_TRUE(judged) << judged.error().reason;
  EXPECT_EQ(part(*judged, "ruling"), part(*simulated, "ruling"));
  EXPECT_EQ(part(*judged, "state"), part(*simulated, "state"));
  EXPECT_EQ(part(*judged, "events"), "");
}

TEST(JudgeDocument, JudgesALogWithoutTheBallsStates) {
  const auto answer =
      judge_document(document(balls(), R"("call":{"ball":3,"pocket":"foot_left"},"events":[
        {"t":0,"type":"cue_strike","balls":[0]},
        {"t":0.1,"type":"ball_collision","balls":[0,3]},
        {"t":1,"type":"pocketed","balls":[3],"pocket":"foot_left"}])"));
  ASSERT_TRUE(answer) << answer.error().reason;
  EXPECT_EQ(part(part(*answer, "state"), "groups"), R"(["solids","stripes"])");
  EXPECT_EQ(part(part(*answer, "ruling"), "first_contact"), "3");
}

TEST(JudgeDocument, TakesDecisionsAndLostTurns) {
  const auto decided = judge_document(
      R"({"state":{"kind":"decision","options":["spot_eight","rerack_breaker_breaks"],"balls":)" +
      balls({8}) + R"(},"decision":"spot_eight"})");
  ASSERT_TRUE(decided) << decided.error().reason;
  EXPECT_EQ(part(part(*decided, "state"), "kind"), "\"shot\"");
  const auto lost = judge_document(document(balls(), R"("lost_turn":"shot_time_exceeded")"));
  ASSERT_TRUE(lost) << lost.error().reason;
  EXPECT_EQ(part(part(*lost, "state"), "kind"), "\"ball_in_hand\"");
}

TEST(JudgeDocument, TakesThePlaceOfACueBallInHandFromTheLog) {
  const std::string state =
      R"({"state":{"kind":"ball_in_hand","balls":)" + balls() + "},\"call\":\"safety\",";
  const auto shot = judge_document(state + R"("cue_ball":{"x":0.558,"y":0.6},)" + soft_shot + "}");
  ASSERT_TRUE(shot) << shot.error().reason;
  const auto log = judge_document(state + "\"events\":" + part(*shot, "events") + "}");
  ASSERT_TRUE(log) << log.error().reason;
  EXPECT_EQ(part(*log, "ruling"), part(*shot, "ruling"));
}

TEST(JudgeDocument, KnowsTheKindOfTurnFromWhereTheBallIsInHand) {
  const auto in_hand = [](const std::string& where) {
    return field(R"({"state":{"ball_in_hand":")" + where + R"(","balls":)" + balls() +
                 R"(},"call":"safety","cue_ball":{"x":0.3,"y":0.7},)" + soft_shot + "}");
  };
  EXPECT_EQ(in_hand("anywhere"), "accepted");
  EXPECT_EQ(in_hand("behind_head_string"), "/cue_ball/y");
}

TEST(JudgeDocument, NamesTheFieldOfWhatIsWrong) {
  const std::string shot = std::string("\"call\":\"safety\",") + soft_shot;
  EXPECT_EQ(field("{"), "");
  EXPECT_EQ(field("[]"), "");
  EXPECT_EQ(field(document(balls(), "\"call\":\"safety\"")), "");
  EXPECT_EQ(field(document(balls(), shot + ",\"x\":1")), "/x");
  EXPECT_EQ(field(document(balls(), soft_shot)), "/call");
  EXPECT_EQ(field(document("[]", shot)), "/state/balls");
  EXPECT_EQ(field(document("7", shot)), "/state/balls");
  EXPECT_EQ(field(document(balls({3}),
                           R"("call":{"ball":3,"pocket":"foot_left"},)" + std::string(soft_shot))),
            "/call/ball");
  EXPECT_EQ(
      field(document(balls(), R"("call":{"ball":3,"pocket":"attic"},)" + std::string(soft_shot))),
      "/call/pocket");
  EXPECT_EQ(field(document(balls(), "\"call\":\"safety\",\"events\":[]")), "/events");
  EXPECT_EQ(field(document(balls(), "\"cue_ball\":{\"x\":0.3,\"y\":0.3}," + shot)), "/cue_ball");
  EXPECT_EQ(
      field(document(balls(), R"("call":"safety","shot":{"a":0,"b":0,"theta":95,"phi":0,"v":1})")),
      "/shot/theta");
  EXPECT_EQ(field(document(balls(), "\"decision\":\"accept\"")), "/decision");
  EXPECT_EQ(field(document(balls(), "\"lost_turn\":\"scratch\"")), "/lost_turn");
  EXPECT_EQ(field(document(balls(), R"("lost_turn":"too_many_refusals","table":"attic")")),
            "/table");
  EXPECT_EQ(
      field(R"({"state":{"groups":["solids","stripes"],"balls":)" + balls() + "}," + shot + "}"),
      "/state/groups");
  EXPECT_EQ(
      field(R"({"state":{"groups":["solids","solids"],"balls":)" + balls({1}) + "}," + shot + "}"),
      "/state/groups");
  EXPECT_EQ(field(R"({"state":{"open_table":false,"balls":)" + balls({1}) + "}," + shot + "}"),
            "/state/open_table");
}

}  // namespace
}  // namespace poolhall::protocol
