// `poolhall conformance` against bots that are known to be good and a bot that is known to be bad.
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "clients/conformance/positions.hpp"
#include "clients/conformance/run.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::conformance {
namespace {

const std::string here = POOLHALL_SOURCE_DIR "/tests/integration/conformance";
// Debian's own: nothing but the standard library is needed.
const std::string python = "/usr/bin/python3 ";

struct Ran {
  int exit_code = -1;
  std::string output;

  [[nodiscard]] bool says(const std::string& text) const {
    return output.find(text) != std::string::npos;
  }
};

// `arguments` are quoted for the shell where need be.
Ran conformance(const std::string& command, const std::string& arguments) {
  Ran ran;
  const std::string line = std::string(POOLHALL_PROGRAM) + " conformance --command '" + command +
                           "' " + arguments + " 2>&1";
  std::FILE* pipe = popen(line.c_str(), "r");
  std::array<char, 4096> chunk{};
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe)) {
    ran.output.append(chunk.data(), count);
  }
  const int status = pclose(pipe);
  ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ran;
}

// ---- Good bots ----

TEST(Conformance, PassesTheBadBotWithoutAFault) {
  const Ran ran = conformance(python + here + "/bad_bot.py", "--patience 20 --jobs 4");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(ran.says(" 0 warned, 0 failed, 0 not reached")) << ran.output;
}

TEST(Conformance, PassesTheHouseBots) {
  for (const char* name : {"random", "greedy"}) {
    const Ran ran =
        conformance(std::string(POOLHALL_PROGRAM) + " bot " + name + " --connect {server}",
                    "--patience 20 --jobs 4");
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    EXPECT_TRUE(ran.says(" 0 failed, 0 not reached")) << ran.output;
  }
}

TEST(Conformance, PassesTheTenLines) {
  const Ran ran = conformance(TEN_LINES_BOT, "--patience 20 --jobs 4");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(ran.says(" 0 failed, ")) << ran.output;
}

TEST(Conformance, PassesThePythonExample) {
  const Ran ran =
      conformance(python + POOLHALL_SOURCE_DIR "/clients/python/example_bot.py {server}",
                  "--patience 20 --jobs 4");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(ran.says(" 0 failed, ")) << ran.output;
}

TEST(Conformance, PassesTheJavaScriptExample) {
  if (std::system("command -v node > /dev/null") != 0) {
    GTEST_SKIP() << "there is no node";
  }
  const Ran ran =
      conformance("node " POOLHALL_SOURCE_DIR "/clients/javascript/example_bot.js {server}",
                  "--patience 20 --jobs 4");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(ran.says(" 0 warned, 0 failed, ")) << ran.output;
}

// The first block of Python on the protocol's page.
std::string tiny_bot() {
  std::ifstream in(POOLHALL_SOURCE_DIR "/protocol/README.md");
  std::stringstream text;
  text << in.rdbuf();
  const std::string page = text.str();
  const std::string fence = "```python\n";
  const auto begin = page.find(fence) + fence.size();
  std::string bot = page.substr(begin, page.find("```", begin) - begin);
  const auto port = bot.find("7777");
  return "import sys\n" + bot.replace(port, 4, "int(sys.argv[1])");
}

TEST(Conformance, PassesTheTinyBotOfTheProtocolsPage) {
  const test_support::TemporaryDirectory folder;
  std::ofstream(folder / "tiny.py") << tiny_bot();
  const Ran ran =
      conformance(python + (folder / "tiny.py").string() + " {port}", "--patience 20 --jobs 4");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(ran.says(" 0 failed, ")) << ran.output;
}

// ---- Planted faults ----

struct Fault {
  const char* name;
  const char* check;

  friend void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.check; }
};

class PlantedFault : public testing::TestWithParam<Fault> {};

TEST_P(PlantedFault, IsFoundByTheCheckThatIsMeantForIt) {
  const auto [name, check] = GetParam();
  const Ran ran = conformance(python + here + "/bad_bot.py --fault " + name,
                              std::string("--clock 3 --patience 12 --only ") + check);
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_TRUE(ran.says(std::string("FAIL        ") + check + " ")) << ran.output;
}

INSTANTIATE_TEST_SUITE_P(
    BadBot, PlantedFault,
    testing::Values(
        Fault{"answers-opponents-turns", "answers-fit-turns"},
        Fault{"calls-the-8", "calls-offered"}, Fault{"chatters-before-login", "line-length"},
        Fault{"comes-back-after-superseded", "superseded"},
        Fault{"decides-accept", "decisions-offered"},
        Fault{"dies-of-pocketed-cue-ball", "cue-ball-pocketed"},
        Fault{"dies-of-unknown-members", "unknown-members"},
        Fault{"dies-of-unknown-notifications", "unknown-notifications"},
        Fault{"forgets-cue-ball", "cue-ball-as-told"},
        Fault{"gives-up-after-error", "retry-internal"}, Fault{"gives-up-after-refusal", "refusal"},
        Fault{"hears-one-line-a-segment", "many-lines-at-once"},
        Fault{"keeps-half-a-line", "half-a-line"}, Fault{"knows-one-game", "two-games"},
        Fault{"logs-in-once", "login-put-off"}, Fault{"loops-on-stale-turn", "stale-turn"},
        Fault{"plays-lost-turns", "foul-refusal"}, Fault{"reads-64-kib", "longest-line"},
        Fault{"replies-in-order", "replies-in-any-order"},
        Fault{"rethinks-on-resend", "lost-answer"}, Fault{"reveals-early", "reveals-fit"},
        Fault{"sends-nan", "valid-requests"}, Fault{"skips-hello", "hello-first"},
        Fault{"stays-away", "lost-before-answer"}, Fault{"thinks-too-long", "short-clock"},
        Fault{"two-places-for-the-cue-ball", "cue-ball-as-told"}, Fault{"wrong-lag", "lag-echo"}),
    [](const testing::TestParamInfo<Fault>& info) {
      std::string name = info.param.name;
      std::erase(name, '-');
      return name;
    });

// ---- The tool ----

TEST(Conformance, SaysWhenTheBotDoesNotCome) {
  const Ran ran = conformance("exit 3", "--patience 2 --only login --only plays-8-ball");
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_TRUE(ran.says("FAIL        login ")) << ran.output;
  EXPECT_TRUE(ran.says("NOT REACHED plays-8-ball")) << ran.output;
  EXPECT_TRUE(ran.says("the bot has ended: exit code 3")) << ran.output;
}

TEST(Conformance, KeepsWhatTheBotWrites) {
  const test_support::TemporaryDirectory folder;
  static_cast<void>(conformance("echo of no use; echo server is {host} {port} >&2",
                                "--patience 2 --only login --logs " + (folder / "logs").string()));
  std::ifstream log(folder / "logs" / "login.log");
  std::stringstream text;
  text << log.rdbuf();
  EXPECT_EQ(text.str().rfind("of no use\nserver is 127.0.0.1 ", 0), 0U) << text.str();
}

TEST(Conformance, RefusesAnUnknownCheck) {
  const Ran ran = conformance("true", "--only politeness");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_TRUE(ran.says("--only: got \"politeness\"")) << ran.output;
}

TEST(Conformance, PrintsJson) {
  const Ran ran = conformance(python + here + "/bad_bot.py", "--json --only login");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_EQ(ran.output.rfind(R"({"checks":[{"name":"login","demand":)", 0), 0U) << ran.output;
  EXPECT_TRUE(ran.says(R"("verdict":"PASS")")) << ran.output;
}

TEST(Conformance, HasChecksWithNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const CheckInfo& check : all_checks()) {
    EXPECT_TRUE(names.insert(check.name).second) << check.name;
    EXPECT_FALSE(check.demand.empty()) << check.name;
  }
}

TEST(Conformance, NamesSectionsOfTheProtocolsPage) {
  std::ifstream in(POOLHALL_SOURCE_DIR "/protocol/README.md");
  std::stringstream text;
  text << in.rdbuf();
  for (const CheckInfo& check : all_checks()) {
    EXPECT_NE(text.str().find("## " + std::string(check.section) + "\n"), std::string::npos)
        << check.section;
  }
}

TEST(Positions, AreLegal) {
  for (const Position& position : positions()) {
    const GamePlan plan = position.plan();
    const HostedGame game(plan, protocol::EventDetail::summary);
    const auto possible = rules::check_state(game.state(), game.table(), game.materials());
    EXPECT_TRUE(possible) << position.info.name << ": " << possible.error().field << " "
                          << possible.error().reason;
    EXPECT_EQ(game.state().to_move, plan.seat) << position.info.name;
  }
}

TEST(Command, IsFilledIn) {
  EXPECT_EQ(filled_in("a {server} {host} {port} {token} {other}", "127.0.0.1:9", "ff"),
            "a 127.0.0.1:9 127.0.0.1 9 ff {other}");
}

}  // namespace
}  // namespace poolhall::conformance
