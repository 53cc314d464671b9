#include "server/settings/server_settings.hpp"

#include <gmock/gmock.h>

namespace poolhall::settings {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(std::string_view source) {
  const auto settings = parse_server_settings(source, "s.toml");
  return settings ? "accepted" : text(settings.error());
}

TEST(ServerSettings, AnEmptyFileGivesTheDefaults) {
  const auto settings = parse_server_settings("", "s.toml");
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->listen, "127.0.0.1:7777");
  EXPECT_EQ(settings->http, "127.0.0.1:8080");
  EXPECT_EQ(settings->database, "poolhall.db");
  EXPECT_EQ(settings->limits.line_bytes, protocol::Limits{}.line_bytes);
}

TEST(ServerSettings, ValuesOfTheFileReachTheirMembersInUnitsOfTheProgram) {
  const auto settings = parse_server_settings(
      "listen = \"[::1]:0\"\nregistration = \"closed\"\nworker_threads = 3\n"
      "[log]\njson = true\n"
      "[limits]\nlogin_seconds = 0.25\nmessages_per_second = 1000\n"
      "lag_credit_per_turn_seconds = 0.05\nnesting = 20\n",
      "s.toml");
  ASSERT_TRUE(settings) << text(settings.error());
  EXPECT_EQ(settings->listen, "[::1]:0");
  EXPECT_EQ(settings->registration, "closed");
  EXPECT_EQ(settings->worker_threads, 3u);
  EXPECT_TRUE(settings->log.json);
  EXPECT_EQ(settings->limits.login_deadline, std::chrono::milliseconds{250});
  EXPECT_EQ(settings->limits.messages_per_second, 1000);
  EXPECT_EQ(settings->limits.lag_credit_per_turn, std::chrono::microseconds{50'000});
  EXPECT_EQ(settings->limits.nesting, 20u);
}

TEST(ServerSettings, AnUnknownKeyIsRefusedWithItsPlaceAndTheNearestName) {
  EXPECT_EQ(refusal("name = \"x\"\n\nlisten_on = \"127.0.0.1:1\"\n"),
            "s.toml:3:1: unknown key \"listen_on\"; did you mean \"listen\"?");
  EXPECT_EQ(refusal("[limits]\n  nestin = 3\n"),
            "s.toml:2:3: unknown key \"limits.nestin\"; did you mean \"limits.nesting\"?");
}

TEST(ServerSettings, AKeyLikeNoOtherPointsToTheList) {
  EXPECT_EQ(refusal("qqqqqqqq = 1"),
            "s.toml:1:1: unknown key \"qqqqqqqq\"; expected a key of config/README.md");
}

TEST(ServerSettings, AnUnknownTableIsRefused) {
  EXPECT_THAT(refusal("[limit]\nnesting = 16\n"), StartsWith("s.toml:1:2: unknown key \"limit\""));
}

TEST(ServerSettings, AWrongTypeSaysWhatCameAndWhatWasExpected) {
  EXPECT_EQ(refusal("worker_threads = \"two\""),
            "s.toml:1:18: worker_threads: the string \"two\" came, expected a whole number from 0 "
            "to 1024");
  EXPECT_THAT(refusal("worker_threads = 1.5"), HasSubstr("the number 1.5 came"));
  EXPECT_THAT(refusal("log = 3"), HasSubstr("log: the whole number 3 came, expected a table"));
  EXPECT_THAT(refusal("name = {a = 1}"), HasSubstr("a table came, expected a name"));
  EXPECT_THAT(refusal("name = 1979-05-27"), HasSubstr("a date or time came"));
  EXPECT_THAT(refusal("[log]\njson = 1"), HasSubstr("expected true or false"));
}

TEST(ServerSettings, ValuesOutsideTheirRangeAreRefused) {
  for (const char* line :
       {"worker_threads = -1", "worker_threads = 1025", "name = \"\"", "name = \"a b\"",
        "name = \"123456789012345678901234567890123\"", "database = \"\"",
        "database = \"a\\u0000b\"", "registration = \"Open\"", "log.level = \"loud\"",
        "limits.login_seconds = 0", "limits.login_seconds = nan", "limits.login_seconds = inf",
        "limits.messages_per_second = -inf", "limits.nesting = 9223372036854775807"}) {
    EXPECT_THAT(refusal(line), HasSubstr("came, expected")) << line;
  }
}

TEST(ServerSettings, OnlyHostAndPortIsAnAddress) {
  for (const char* good : {"127.0.0.1:0", "localhost:65535", "[::1]:7777", "0.0.0.0:1"}) {
    EXPECT_EQ(refusal("listen = \"" + std::string(good) + "\""), "accepted") << good;
  }
  for (const char* bad : {"7777", ":7777", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "::1:1",
                          "127.0.0.1:+5", "127.0.0.1:5x", "a b:5", "[]:5"}) {
    EXPECT_THAT(refusal("listen = \"" + std::string(bad) + "\""), HasSubstr("HOST:PORT")) << bad;
  }
}

TEST(ServerSettings, WhatIsNotTomlSaysWhere) {
  EXPECT_THAT(refusal("name = \"x\"\nlisten = \n"), StartsWith("s.toml:2:"));
  EXPECT_THAT(refusal("name = \"x\"\nname = \"y\"\n"), StartsWith("s.toml:2:8: not TOML: "));
  EXPECT_THAT(refusal("name = \"\xff\xfe\""), HasSubstr("not TOML"));
}

TEST(ServerSettings, TheFirstWrongKeyOfTheFileIsReported) {
  EXPECT_THAT(refusal("zzz = 1\naaa = 2\n"), StartsWith("s.toml:1:1: unknown key \"zzz\""));
}

TEST(ServerSettings, AFileThatIsNotThereSaysSo) {
  const auto settings = load_server_settings("/nonexistent/poolhall.toml");
  ASSERT_FALSE(settings);
  EXPECT_EQ(text(settings.error()),
            "/nonexistent/poolhall.toml: cannot be read; expected the name of a readable TOML "
            "file");
}

TEST(ServerSettings, ADirectoryIsNotAFile) {
  const auto settings = load_server_settings("/");
  ASSERT_FALSE(settings);
  EXPECT_THAT(text(settings.error()), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace poolhall::settings
