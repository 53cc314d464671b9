// The published schemas and the published transcripts against the code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/codec.hpp"
#include "protocol/json_value.hpp"
#include "protocol/scene_json.hpp"
#include "tests/support/sample_messages.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::protocol {
namespace {

const std::filesystem::path source_dir{POOLHALL_SOURCE_DIR};

// A session as validate_messages.py reads it.
class Session {
 public:
  void agent(const std::string& line) { text_ += "> " + line; }
  void server(const std::string& line) { text_ += "< " + line; }

  struct Verdict {
    int exit_code;
    std::string output;
  };
  [[nodiscard]] Verdict validated() const {
    const test_support::TemporaryDirectory folder;
    const auto file = folder / "session.txt";
    std::ofstream(file) << text_;
    return validated(file);
  }
  [[nodiscard]] static Verdict validated(const std::filesystem::path& session) {
    // Debian's own python: it has the jsonschema that the project asks for.
    const std::string command =
        "/usr/bin/python3 " + (source_dir / "tests/support/validate_messages.py").string() + " " +
        (source_dir / "protocol/schema").string() + " < " + session.string() + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
      output += static_cast<char>(c);
    }
    return {pclose(pipe), output};
  }

 private:
  std::string text_;
};

TEST(Schemas, HoldForEveryRequest) {
  Session session;
  for (const Request& request : test_support::sample_requests()) {
    session.agent(encode_request(1, request));
  }
  session.agent(encode_lag({5}));
  const auto verdict = session.validated();
  EXPECT_EQ(verdict.exit_code, 0) << verdict.output;
}

TEST(Schemas, HoldForEveryReplyAndError) {
  Session session;
  std::map<Method, Request> requests;
  for (const Request& request : test_support::sample_requests()) {
    requests.emplace(method_of(request), request);
  }
  for (const auto& sample : test_support::sample_replies()) {
    session.agent(encode_request(1, requests.at(sample.method)));
    session.server(encode_reply({"1"}, sample.reply));
  }
  for (const ErrorEntry& known : error_registry()) {
    session.server(encode_error({"null"}, {known.code, "/params", "why", GameId{1}, true}));
  }
  const auto verdict = session.validated();
  EXPECT_EQ(verdict.exit_code, 0) << verdict.output;
}

TEST(Schemas, HoldForEveryNotification) {
  Session session;
  std::uint64_t seq = 0;
  for (const auto& notification : test_support::sample_notifications()) {
    session.server(encode_notification(notification, ++seq));
  }
  const auto verdict = session.validated();
  EXPECT_EQ(verdict.exit_code, 0) << verdict.output;
}

TEST(Schemas, RefuseWhatTheCodeRefuses) {
  for (const char* line : {
           R"({"jsonrpc":"2.0","id":1,"method":"ack","params":{"game":"x"}})",
           R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"protocol":[1],"name":"b"}})",
           R"({"jsonrpc":"2.0","id":1,"method":"login","params":{"token":"1234"}})",
           R"({"jsonrpc":"2.0","method":"sync","params":{"game":1}})",
           R"({"jsonrpc":"2.0","id":1,"method":"fly","params":{}})",
       }) {
    EXPECT_FALSE(decode_request(line, Limits{})) << line;
    Session session;
    session.agent(std::string(line) + "\n");
    EXPECT_NE(session.validated().exit_code, 0) << line;
  }
}

TEST(Schemas, RefuseAMemberThatNoMessageHas) {
  std::string line = encode_notification(LagProbe{1}, 1);
  line.replace(line.find("\"t\""), 3, "\"u\"");
  Session session;
  session.server(line);
  EXPECT_NE(session.validated().exit_code, 0);
}

struct Recorded {
  std::string name;
  std::vector<std::string> lines;  // with their "> ", "< " or "! "
};

std::vector<Recorded> transcripts() {
  std::vector<Recorded> found;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_dir / "protocol/transcripts")) {
    std::ifstream in(entry.path());
    Recorded& recorded = found.emplace_back();
    recorded.name = entry.path().string();
    for (std::string line; std::getline(in, line);) {
      if (!line.empty() && line[0] != '#') {
        recorded.lines.push_back(line);
      }
    }
  }
  return found;
}

TEST(Transcripts, HoldAgainstTheSchemas) {
  ASSERT_FALSE(transcripts().empty());
  for (const Recorded& recorded : transcripts()) {
    const auto verdict = Session::validated(recorded.name);
    EXPECT_EQ(verdict.exit_code, 0) << recorded.name << "\n" << verdict.output;
  }
}

TEST(Transcripts, AreReadByBothSidesOfTheCodec) {
  for (const Recorded& recorded : transcripts()) {
    std::map<RequestId, Method> asked;
    for (const std::string& line : recorded.lines) {
      const std::string_view text = std::string_view(line).substr(2);
      if (line[0] == '<') {
        const auto message = decode_server_message(text, [&](const RequestId& id) {
          const auto found = asked.find(id);
          return found == asked.end() ? std::nullopt : std::optional(found->second);
        });
        ASSERT_TRUE(message) << recorded.name << "\n" << message.error().reason << "\n" << line;
        EXPECT_FALSE(std::holds_alternative<UnknownNotification>(*message)) << line;
        continue;
      }
      const auto incoming = decode_request(text, Limits{});
      if (line[0] == '!') {
        EXPECT_FALSE(incoming) << line;
        continue;
      }
      if (incoming && incoming->id) {
        asked[*incoming->id] = method_of(incoming->request);
      }
      ASSERT_TRUE(incoming) << recorded.name << "\n" << incoming.error().error.reason;
    }
  }
}

TEST(Transcripts, ShowWhatIsHardToImagine) {
  std::string all;
  for (const Recorded& recorded : transcripts()) {
    for (const std::string& line : recorded.lines) {
      all += line + "\n";
    }
  }
  for (const char* text :
       {R"("method":"register")", R"("method":"login")", R"("method":"sync")",
        R"("method":"superseded")", R"("method":"challenge.offer")", R"("duplicate":true)",
        R"("foul":true)", R"("method":"game.turn_lost")", R"("method":"decide")",
        R"("kind":"ball_in_hand")", R"("call":"push_out")", R"("choice":"pass_back")",
        R"("method":"game.reveal")", R"("method":"match.over")", R"("method":"lag")"}) {
    EXPECT_NE(all.find(text), std::string::npos) << text;
  }
}

// Every block of json-lines in README.md is written like a transcript.
TEST(Readme, HasExamplesThatAreValid) {
  std::ifstream in(source_dir / "protocol/README.md");
  Session session;
  std::size_t examples = 0;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = line == "```json-lines";
    } else if (inside && line.starts_with("> ")) {
      session.agent(line.substr(2) + "\n");
      ++examples;
    } else if (inside && line.starts_with("< ")) {
      session.server(line.substr(2) + "\n");
      ++examples;
    }
  }
  EXPECT_GE(examples, 9U);
  const auto verdict = session.validated();
  EXPECT_EQ(verdict.exit_code, 0) << verdict.output;
}

std::string readme() {
  std::ifstream in(source_dir / "protocol/README.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void expect_named(const std::string& page, std::string_view word) {
  EXPECT_NE(page.find("`" + std::string(word)), std::string::npos) << word;
}

TEST(Readme, NamesEveryMethodNotificationAndError) {
  const std::string page = readme();
  for (std::size_t i = 0; i < std::variant_size_v<Request>; ++i) {
    expect_named(page, name(static_cast<Method>(i)));
  }
  for (std::size_t i = 0; i < notification_count; ++i) {
    expect_named(page, notification_name(i));
  }
  for (const ErrorEntry& known : error_registry()) {
    expect_named(page, known.name);
    EXPECT_NE(page.find(std::to_string(static_cast<int>(known.code))), std::string::npos);
    EXPECT_NE(page.find(known.meaning), std::string::npos) << known.meaning;
  }
}

// Words of the rules and of the physics that stand in messages. What is no enumerator has no name.
template <class Word>
void expect_all_named(const std::string& page) {
  constexpr int more_than_any_has = 100;
  int words = 0;
  for (; words < more_than_any_has; ++words) {
    const std::string_view word = name(static_cast<Word>(words));
    if (word.empty()) {
      break;
    }
    expect_named(page, word);
  }
  EXPECT_GE(words, 5);
  EXPECT_LT(words, more_than_any_has);
}

TEST(Readme, NamesEveryWordOfTheRulesAndThePhysics) {
  const std::string page = readme();
  expect_all_named<rules::FoulCode>(page);
  expect_all_named<rules::EndReason>(page);
  expect_all_named<rules::Decision>(page);
  expect_all_named<rules::TurnKind>(page);
  expect_all_named<physics::EventType>(page);
  expect_all_named<physics::MotionState>(page);
  for (std::size_t i = 0; i < physics::pocket_count; ++i) {
    expect_named(page, name(static_cast<physics::PocketId>(i)));
  }
}

std::vector<std::string> in_ticks_or_commas(const std::string& cell) {
  std::vector<std::string> items;
  std::istringstream in(cell);
  for (std::string item; std::getline(in, item, ',');) {
    std::erase_if(item, [](char c) { return c == ' ' || c == '`'; });
    items.push_back(item);
  }
  return items;
}

// Rows of the table of limits: | `name`, `name` | default, default | meaning |
std::map<std::string, std::string> limits_of(const std::string& page) {
  std::map<std::string, std::string> limits;
  std::istringstream in(page.substr(page.find("| `limits` | default |")));
  for (std::string line; std::getline(in, line) && line.starts_with("|");) {
    std::istringstream row(line.substr(1));
    std::string names;
    std::string values;
    std::getline(row, names, '|');
    std::getline(row, values, '|');
    const auto keys = in_ticks_or_commas(names);
    const auto defaults = in_ticks_or_commas(values);
    for (std::size_t i = 0; i < std::min(keys.size(), defaults.size()); ++i) {
      limits[keys[i]] = defaults[i];
    }
  }
  limits.erase("limits");
  limits.erase("---");
  return limits;
}

TEST(Readme, HasEveryLimitWithItsDefault) {
  HelloReply hello;
  const auto line = parse_json(encode_reply({"1"}, hello), {16, 1000});
  ASSERT_TRUE(line);
  const JsonValue* limits = line->member("result")->member("limits");
  ASSERT_NE(limits, nullptr);
  std::map<std::string, std::string> told;
  for (const auto& [key, value] : *limits->as<JsonObject>()) {
    told[key] = canonical_text(value);
  }
  EXPECT_EQ(limits_of(readme()), told);
}

}  // namespace
}  // namespace poolhall::protocol
