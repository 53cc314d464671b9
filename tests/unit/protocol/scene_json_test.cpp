#include "protocol/scene_json.hpp"

#include <gtest/gtest.h>

namespace poolhall::protocol {
namespace {

constexpr std::string_view good = R"({"table":"olympiad","physics":"olympiad",
  "balls":[{"id":0,"x":0.5,"y":0.5},{"id":3,"x":0.5,"y":1.5,"vx":0.1}],
  "shot":{"a":1,"b":2,"theta":5,"phi":90,"v":2},"t_max":3.5,"precision":"mp100",
  "contact":"sequential","solver":"closed_form","event_limit":500})";

std::string with(std::string_view from, std::string_view to) {
  std::string text(good);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Error refused(const std::string& text) {
  const auto scene = decode_scene(text);
  EXPECT_FALSE(scene) << text;
  return scene ? Error{} : scene.error();
}

TEST(SceneJson, ReadsEveryField) {
  const auto file = decode_scene(good);
  ASSERT_TRUE(file) << file.error().field << ": " << file.error().reason;
  EXPECT_EQ(file->table.name, "olympiad");
  EXPECT_EQ(file->balls.count, 2U);
  EXPECT_EQ(file->balls[1].velocity, (physics::Vec2<double>{0.1, 0}));
  EXPECT_EQ(file->shot, (ShotParams{1, 2, 5, 90, 2}));
  EXPECT_EQ(file->options.t_max, 3.5);
  EXPECT_EQ(file->options.contact, physics::ContactModel::sequential);
  EXPECT_EQ(file->options.solver, physics::RootSolver::closed_form);
  EXPECT_EQ(file->options.event_limit, 500U);
  EXPECT_EQ(file->precision, Precision::mp100);
}

TEST(SceneJson, NeedsOnlyTableMaterialsAndBalls) {
  const auto file = decode_scene(R"({"table":"olympiad","physics":"modern","balls":[]})");
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->shot);
  EXPECT_FALSE(file->options.t_max);
  EXPECT_EQ(file->precision, Precision::double_precision);
}

TEST(SceneJson, TellsABallsStateFromItsVelocities) {
  const auto file = decode_scene(good);
  EXPECT_EQ(file->balls[0].state, physics::MotionState::stationary);
  EXPECT_EQ(file->balls[1].state, physics::MotionState::sliding);
  const auto spinning = decode_scene(with("\"vx\":0.1", "\"wz\":-3"));
  EXPECT_EQ(spinning->balls[1].state, physics::MotionState::spinning);
}

TEST(SceneJson, KeepsAStateThatIsGivenForTheSimulatorToCheck) {
  const auto file = decode_scene(with("\"vx\":0.1", "\"vx\":0.1,\"state\":\"stationary\""));
  EXPECT_EQ(file->balls[1].state, physics::MotionState::stationary);
}

TEST(SceneJson, NamesTheFieldThatDoesNotFit) {
  EXPECT_EQ(refused(with("\"balls\"", "\"bals\"")).field, "/bals");
  EXPECT_EQ(refused(with("\"y\":1.5", "\"y\":\"far\"")).field, "/balls/1/y");
  EXPECT_EQ(refused(with(",\"y\":1.5", "")).field, "/balls/1/y");
  EXPECT_EQ(refused(with("\"vx\":0.1", "\"v_x\":0.1")).field, "/balls/1/v_x");
  EXPECT_EQ(refused(with("\"id\":3", "\"id\":16")).field, "/balls/1/id");
  EXPECT_EQ(refused(with("\"phi\":90,", "")).field, "/shot/phi");
  EXPECT_EQ(refused(with("\"phi\":90", "\"phi\":NaN")).code, ErrorCode::parse_error);
  EXPECT_EQ(refused(with("\"phi\":90", "\"phi\":1e999")).field, "/shot/phi");
  EXPECT_EQ(refused(with("\"t_max\":3.5", "\"t_max\":-1")).field, "/t_max");
  EXPECT_EQ(refused(with("mp100", "mp50")).field, "/precision");
  EXPECT_EQ(refused(with("sequential", "glue")).field, "/contact");
  EXPECT_EQ(refused(with("closed_form", "guess")).field, "/solver");
  EXPECT_EQ(refused(with("\"table\":\"olympiad\"", "\"table\":\"moon\"")).field, "/table");
  EXPECT_EQ(refused(with("\"physics\":\"olympiad\"", "\"physics\":{\"mu_roll\":\"x\"}")).field,
            "/physics/mu_roll");
}

TEST(SceneJson, TellsWhatMayStandInThePlaceOfAPreset) {
  const auto reason = [](const std::string& key, const std::string& value) {
    const Error error = refused(with("\"" + key + "\":\"olympiad\"", "\"" + key + "\":" + value));
    return error.field + " " + error.reason;
  };
  for (const std::string key : {"table", "physics"}) {
    EXPECT_TRUE(reason(key, "7").starts_with("/" + key + " expected an object or one of \""));
    EXPECT_TRUE(
        reason(key, R"({"preset":{}})").starts_with("/" + key + "/preset expected one of \""));
  }
}

TEST(SceneJson, AllowsAPocketOnlyInsteadOfAPlace) {
  const std::string ball = R"("x":0.5,"y":1.5,"vx":0.1)";
  const auto down = decode_scene(with(ball, R"("pocket":"side_left","state":"pocketed")"));
  ASSERT_TRUE(down);
  EXPECT_EQ(down->balls[1].pocket, physics::PocketId::side_left);
  EXPECT_EQ(refused(with("\"vx\":0.1", R"("pocket":"side_left")")).field, "/balls/1/x");
  EXPECT_EQ(refused(with(ball, R"("pocket":"side_left","state":"rolling")")).field,
            "/balls/1/state");
}

TEST(SceneJson, RefusesMoreThanSixteenBalls) {
  std::string balls = "[";
  for (int i = 0; i < 17; ++i) {
    balls += std::string(i == 0 ? "" : ",") + R"({"id":1,"x":0,"y":0})";
  }
  EXPECT_EQ(refused(R"({"table":"olympiad","physics":"olympiad","balls":)" + balls + "]}").field,
            "/balls");
}

TEST(SceneJson, MakesTheSameSceneInEveryPrecision) {
  const auto file = decode_scene(with("\"x\":0.5", "\"x\":0.1"));
  const auto narrow = scene_of(*file);
  const auto wide = scene_of<long double>(*file);
  EXPECT_EQ(static_cast<long double>(narrow.balls[0].position.x), wide.balls[0].position.x);
  EXPECT_EQ(narrow.shot->given, *file->shot);
}

TEST(SimulationJson, GivesAPocketedBallItsPocketInsteadOfAPlace) {
  physics::Simulation<double> simulation;
  simulation.balls.count = 2;
  simulation.balls[0].position = {0.25, 0.5};
  simulation.balls[1].id = physics::BallId{4};
  simulation.balls[1].state = physics::MotionState::pocketed;
  simulation.balls[1].pocket = physics::PocketId::foot_left;
  const std::string text = encode_simulation(simulation);
  EXPECT_NE(text.find(R"({"id":4,"state":"pocketed","pocket":"foot_left"})"), std::string::npos);
  EXPECT_NE(text.find(R"({"id":0,"state":"stationary","x":0.25,"y":0.5,"vx":0)"),
            std::string::npos);
}

}  // namespace
}  // namespace poolhall::protocol
