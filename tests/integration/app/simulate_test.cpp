// `poolhall simulate` as a program: what it prints, where, and with which exit code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "protocol/json_value.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall {
namespace {

using protocol::JsonValue;
using test_support::Ran;

class Simulate : public testing::Test {
 protected:
  // A file of this folder with that text.
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    const auto path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  Ran simulate(const std::string& arguments) const {
    return test_support::run_command(std::string(POOLHALL_PROGRAM) + " simulate " + arguments,
                                     input_);
  }
  Ran bench_speed(const std::string& scenes) const {
    return test_support::run_command(
        std::string(POOLHALL_PROGRAM) + " bench speed --scenes " + scenes, input_);
  }

  std::string input_;

 private:
  test_support::TemporaryDirectory folder_;
};

std::string scene(const std::string& more = "") {
  return R"({"table":"olympiad","physics":"olympiad","balls":[{"id":0,"x":0.5,"y":0.5},)"
         R"({"id":3,"x":0.52,"y":1.5}],"shot":{"a":1,"b":2,"theta":5,"phi":90,"v":3})" +
         more + "}";
}

JsonValue parsed(const std::string& text) {
  const auto value = protocol::parse_json(text, {16, 1'000'000});
  EXPECT_TRUE(value) << text.substr(0, 200);
  return value ? *value : JsonValue{};
}

double number(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.member(key);
  const auto* real = value == nullptr ? nullptr : value->as<double>();
  EXPECT_NE(real, nullptr) << key;
  return real == nullptr ? 0 : *real;
}

TEST_F(Simulate, PrintsTheLogAndTheFinalState) {
  const Ran ran = simulate(file("scene.json", scene()).string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const JsonValue result = parsed(ran.out);
  ASSERT_NE(result.member("events"), nullptr);
  EXPECT_GT(result.member("events")->as<protocol::JsonArray>()->size(), 5U);
  EXPECT_EQ(result.member("final")->as<protocol::JsonArray>()->size(), 2U);
  EXPECT_GT(number(result, "duration"), 1);
  EXPECT_GT(number(*result.member("energy"), "start"), 0);
}

TEST_F(Simulate, ReadsTheStandardInput) {
  input_ = scene();
  EXPECT_EQ(simulate("-").out, simulate(file("scene.json", scene()).string()).out);
}

TEST_F(Simulate, NamesTheFieldOfAWrongSceneInOneLine) {
  struct Case {
    std::string text;
    std::string says;
  };
  const std::string start = R"({"table":"olympiad","physics":"olympiad","balls":)";
  for (const Case& wrong : {
           Case{start + R"([{"id":0,"x":"left","y":0.5}]})", "/balls/0/x: expected a number"},
           Case{start + R"([{"id":0,"x":0.5,"y":9}]})", "/balls/0/y: "},
           Case{start + R"([{"id":0,"x":0.5,"y":0.5},{"id":0,"x":0.5,"y":1}]})", "/balls/1"},
           Case{scene(R"(,"t_max":-1)"), "/t_max: "},
           Case{scene(R"(,"colour":1)"), "/colour: unknown key"},
           Case{R"({"table":"olympiad","balls":[]})", "/physics: is missing"},
           Case{"{", "not JSON"},
       }) {
    const Ran ran = simulate(file("wrong.json", wrong.text).string());
    EXPECT_EQ(ran.exit_code, 2) << wrong.text;
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find(wrong.says), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
  }
}

TEST_F(Simulate, SaysWhenAFileCannotBeRead) {
  const Ran ran = simulate(at("nowhere.json").string());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("nowhere.json"), std::string::npos);
}

TEST_F(Simulate, EndsWithThePartialLogWhenTheEventLimitIsMet) {
  input_ = scene(R"(,"event_limit":3)");
  const Ran ran = simulate("-");
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(*parsed(ran.out).member("stats")->member("ending")->as<std::string>(), "event_limit");
}

TEST_F(Simulate, WritesOneResultALine) {
  input_ = scene() + "\n{\n" + scene(R"(,"t_max":0.25)") + "\n";
  const Ran ran = simulate("- --lines");
  EXPECT_EQ(ran.exit_code, 2);
  std::istringstream lines(ran.out);
  std::string first;
  std::string second;
  std::string third;
  std::string none;
  std::getline(lines, first);
  std::getline(lines, second);
  std::getline(lines, third);
  EXPECT_FALSE(std::getline(lines, none));
  EXPECT_NE(parsed(first).member("events"), nullptr);
  EXPECT_NE(second.find(R"({"error":{"line":2,"field":"","reason":"not JSON)"), std::string::npos);
  EXPECT_NE(third.find(R"("ending":"t_max")"), std::string::npos);
}

#ifndef POOLHALL_WITHOUT_BENCH
TEST_F(Simulate, BenchTimesTheSameFileAndRefusesAsItDoes) {
  const Ran timed = bench_speed(file("good.jsonl", scene() + "\n" + scene() + "\n").string());
  EXPECT_EQ(timed.exit_code, 0) << timed.err;
  EXPECT_NE(timed.out.find("us a shot, median"), std::string::npos);
  const Ran wrong =
      bench_speed(file("bad.jsonl", scene() + "\n" + scene(R"(,"t_max":-1)")).string());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("bad.jsonl:2: /t_max: "), std::string::npos) << wrong.err;
  EXPECT_EQ(bench_speed("nowhere.jsonl").exit_code, 2);
  const Ran folder = bench_speed("/");
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_NE(folder.err.find("cannot read /"), std::string::npos) << folder.err;
}
#endif

TEST_F(Simulate, RefusesAFolderAsItDoesAFileThatIsNotThere) {
  for (const char* arguments : {"/", "--lines /", "- < /", "--lines - < /"}) {
    const Ran ran = simulate(arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments;
    EXPECT_EQ(ran.out, "") << arguments;
    const std::string source = std::string(arguments).find("- <") == std::string::npos ? "/" : "-";
    EXPECT_EQ(ran.err, source + ": cannot be read, expected a scene file or -\n") << arguments;
  }
  EXPECT_EQ(simulate("nowhere.json").err,
            "nowhere.json: cannot be read, expected a scene file or -\n");
}

TEST_F(Simulate, DrawsAPicture) {
  input_ = scene();
  EXPECT_EQ(simulate("- --svg " + at("shot.svg").string()).exit_code, 0);
  const std::string svg = test_support::bytes_of(at("shot.svg"));
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("<path d=\"M0.50000 0.50000Q"), std::string::npos);
  EXPECT_EQ(simulate("- --svg " + at("no/such/folder.svg").string()).exit_code, 1);
}

TEST_F(Simulate, AgreesInEveryPrecision) {
  input_ = scene();
  const double duration = number(parsed(simulate("-").out), "duration");
  for (const char* precision : {"long_double", "float128", "mp100"}) {
    input_ = scene(R"(,"precision":")" + std::string(precision) + '"');
    const Ran ran = simulate("-");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NEAR(number(parsed(ran.out), "duration"), duration, 1e-11) << precision;
  }
}

TEST_F(Simulate, ReadsAndWritesByThePublishedSchemas) {
  std::string session;
  for (const std::string& text :
       {scene(), scene(R"(,"t_max":0.5,"precision":"mp100")"),
        std::string(R"({"table":{"preset":"wpa9","head_string":0.6},"physics":{"preset":"modern",)"
                    R"("cushion":{"model":"mathavan2010"}},"balls":[{"id":0,"x":0.5,"y":0.5,)"
                    R"("vx":2,"vy":3},{"id":4,"pocket":"side_left"}]})")}) {
    input_ = text;
    const Ran ran = simulate("-");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    session += "s " + text + "\nr " + ran.out;
  }
  const Ran checked = test_support::run_command(
      "/usr/bin/python3 " POOLHALL_SOURCE_DIR
      "/tests/support/validate_messages.py " POOLHALL_SOURCE_DIR "/protocol/schema",
      session);
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  EXPECT_EQ(checked.out, "6 valid, 0 wrong\n");
}

}  // namespace
}  // namespace poolhall
