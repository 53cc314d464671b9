// What the workbench may ask, what it costs at most, and what it is answered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "physics/simulator.hpp"
#include "protocol/scene_json.hpp"
#include "server/web/static_files.hpp"
#include "server/web/workbench.hpp"

namespace poolhall::web {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string scene =
    R"({"table":"olympiad","physics":"olympiad","balls":[{"id":0,"x":0.5,"y":0.5},)"
    R"({"id":3,"x":0.52,"y":1.2}],"shot":{"a":1,"b":4,"theta":5,"phi":88.5,"v":4})";

TEST(Workbench, SimulatesBitForBitWhatThePhysicsGives) {
  const auto file = protocol::decode_scene(scene + "}").value();
  const auto done = physics::simulate(protocol::scene_of(file), file.options).value();
  const Page page = simulate_page(scene + "}");
  EXPECT_EQ(page.status, 200U);
  EXPECT_EQ(page.body, protocol::encode_simulation(done) + "\n");
}

TEST(Workbench, NamesTheFieldOfAWrongScene) {
  const Page page =
      simulate_page(R"({"table":"olympiad","physics":"olympiad","balls":[{"id":99}]})");
  EXPECT_EQ(page.status, 422U);
  EXPECT_THAT(page.body, HasSubstr(R"("field":"/balls/0/id")"));
}

TEST(Workbench, LeavesWhatTakesLongToTheProgram) {
  EXPECT_THAT(simulate_page(scene + R"(,"contact":"hertz"})").body, HasSubstr("/contact"));
  EXPECT_THAT(simulate_page(scene + R"(,"precision":"mp100"})").body, HasSubstr("/precision"));
}

TEST(Workbench, BoundsTheEventsOfAScene) {
  // Without friction, with walls that give everything back: it never ends.
  const Page page = simulate_page(
      R"({"table":{"width":1,"length":2,"pockets":"none"},"physics":{"mu_slide":0,"mu_roll":0,)"
      R"("cushion":{"model":"damped","normal":1,"tangential":1,"spin":1}},)"
      R"("balls":[{"id":0,"x":0.5,"y":0.5,"vx":3,"vy":4}]})");
  EXPECT_EQ(page.status, 200U);
  EXPECT_THAT(page.body, HasSubstr(R"("ending":"event_limit")"));
  EXPECT_THAT(page.body, HasSubstr(R"("events":)" + std::to_string(most_events)));
}

TEST(Workbench, AnEvaluationOfNoNoiseIsTheShotItself) {
  const Page page = evaluate_page(R"({"scene":)" + scene + R"(},"noise":"none","samples":5})");
  ASSERT_EQ(page.status, 200U) << page.body;
  const auto file = protocol::decode_scene(scene + "}").value();
  const auto done = physics::simulate(protocol::scene_of(file), file.options).value();
  EXPECT_THAT(page.body, StartsWith(R"({"samples":5,"moved":0,"unfinished":0,"balls":[{"ball":0)"));
  const auto& cue = done.balls[0];
  if (!cue.pocket) {
    const std::string x = std::to_string(cue.position.x).substr(0, 6);
    EXPECT_THAT(page.body, HasSubstr(x));
  }
}

TEST(Workbench, AnEvaluationIsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto cloud = [](int seed) {
    return evaluate_page(R"({"scene":)" + scene + R"(},"noise":"olympiad","samples":20,"seed":)" +
                         std::to_string(seed) + "}")
        .body;
  };
  EXPECT_EQ(cloud(1), cloud(1));
  EXPECT_NE(cloud(1), cloud(2));
}

TEST(Workbench, RefusesAnEvaluationWithoutAShotOrOfTooManySamples) {
  EXPECT_THAT(evaluate_page(R"({"scene":{"table":"olympiad","physics":"olympiad","balls":[]},)"
                            R"("noise":"low"})")
                  .body,
              HasSubstr("/scene/shot"));
  EXPECT_THAT(evaluate_page(R"({"scene":)" + scene + R"(},"noise":"low","samples":100000})").body,
              HasSubstr("/samples"));
  EXPECT_THAT(evaluate_page(R"({"scene":)" + scene + R"(},"noise":"loud"})").body,
              HasSubstr("/noise"));
}

TEST(StaticFiles, ThePageIsInTheProgramAndEachFileHasItsTypeAndTag) {
  const auto page = static_file("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->type, "text/html; charset=utf-8");
  EXPECT_THAT(page->body, HasSubstr("<title>Poolhall</title>"));
  EXPECT_EQ(static_file("/main.js")->type, "text/javascript; charset=utf-8");
  EXPECT_NE(static_file("/main.js")->etag, static_file("/style.css")->etag);
  EXPECT_FALSE(static_file("/../pool"));
  EXPECT_FALSE(static_file("/package.json"));
}

}  // namespace
}  // namespace poolhall::web
