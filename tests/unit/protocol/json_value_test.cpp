#include "protocol/json_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace poolhall::protocol {
namespace {

constexpr JsonBounds bounds{16, 256};

Error refused(std::string_view text) {
  const auto value = parse_json(text, bounds);
  EXPECT_FALSE(value) << text;
  return value ? Error{} : value.error();
}

std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

std::string object_of(std::size_t keys) {
  std::string text = "{";
  for (std::size_t i = 0; i < keys; ++i) {
    text += (i == 0 ? "\"k" : ",\"k") + std::to_string(i) + "\":0";
  }
  return text + "}";
}

TEST(ParseJson, TakesEveryKindOfValue) {
  const auto value = parse_json(R"({"a":[null,true,-3,7,2.5,"x"]})", bounds);
  ASSERT_TRUE(value);
  EXPECT_EQ(canonical_text(*value), R"({"a":[null,true,-3,7,2.5,"x"]})");
}

TEST(ParseJson, TakesTheDeepestNestingAllowedAndRefusesOneMore) {
  EXPECT_TRUE(parse_json(nested(16), bounds));
  EXPECT_EQ(refused(nested(17)).code, ErrorCode::parse_error);
  EXPECT_NE(refused(nested(17)).reason.find("16"), std::string::npos);
}

TEST(ParseJson, TakesTheMostKeysAllowedAndRefusesOneMore) {
  EXPECT_TRUE(parse_json(object_of(256), bounds));
  EXPECT_EQ(refused(object_of(257)).code, ErrorCode::parse_error);
  EXPECT_EQ(refused("[" + object_of(200) + "," + object_of(57) + "]").field, "/1");
}

TEST(ParseJson, BoundsTheKeysOfOneObjectEvenInLargeDocuments) {
  constexpr JsonBounds large{16, 1'000'000};
  EXPECT_TRUE(parse_json(object_of(1024), large));
  EXPECT_FALSE(parse_json(object_of(1025), large));
}

TEST(ParseJson, RefusesAKeyThatStandsTwiceAndPointsAtIt) {
  EXPECT_EQ(refused(R"({"a":{"x":1,"b/c~":2,"b/c~":3}})").field, "/a/b~1c~0");
  EXPECT_TRUE(parse_json(R"({"a":{"x":1},"b":{"x":1}})", bounds));
  EXPECT_EQ(refused("{\"\\u0061\":1,\"a\":2}").field, "/a");
}

TEST(ParseJson, RefusesNumbersThatADoubleCannotHold) {
  EXPECT_EQ(refused(R"({"params":{"a":[0,1e999]}})").field, "/params/a/1");
  EXPECT_EQ(refused("-1e400").code, ErrorCode::parse_error);
  for (const char* word : {"NaN", "Infinity", "-Infinity", "nan", "1e", "01", "+1", ".5", "0x1"}) {
    EXPECT_EQ(refused(word).code, ErrorCode::parse_error) << word;
  }
}

TEST(ParseJson, RefusesInvalidUtf8AndLoneSurrogates) {
  refused("\"\xff\"");
  refused("\"\xc0\xaf\"");
  refused("\"\xed\xa0\x80\"");
  refused(R"("\ud800")");
  refused(R"("\udc00x")");
  EXPECT_TRUE(parse_json("\"\xc3\xa9\\u00e9\\ud83d\\ude00\"", bounds));
}

TEST(ParseJson, RefusesWhatIsNotOneValue) {
  for (const char* text :
       {"", " ", "{", "[1,]", "{\"a\":1,}", "1 2", "{}{}", "// x", "'a'", "[1"}) {
    EXPECT_EQ(refused(text).code, ErrorCode::parse_error) << text;
  }
}

TEST(ParseJson, RepeatsNoLongPieceOfWhatItCouldNotRead) {
  const std::string token(64, '7');
  const Error error = refused("{\"token\": \"" + token);
  EXPECT_EQ(error.reason.find("7777"), std::string::npos) << error.reason;
}

TEST(CanonicalText, IsOneTextForEqualValues) {
  const auto text = [](std::string_view json) { return canonical_text(*parse_json(json, bounds)); };
  EXPECT_EQ(text("  \"\\u0061\"  "), "\"a\"");
  EXPECT_EQ(text("\"\xc3\xa9\""), text("\"\\u00e9\""));
  EXPECT_EQ(text("1.50"), text("15e-1"));
  EXPECT_EQ(text("18446744073709551615"), "18446744073709551615");
}

TEST(CanonicalText, KeepsTheSignOfZero) {
  const auto value = parse_json("-0.0", bounds);
  const auto again = parse_json(canonical_text(*value), bounds);
  EXPECT_TRUE(std::signbit(*again->as<double>()));
}

}  // namespace
}  // namespace poolhall::protocol
