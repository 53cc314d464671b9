#include "protocol/errors.hpp"

#include <gtest/gtest.h>

#include <set>

#include "protocol/codec.hpp"

namespace poolhall::protocol {
namespace {

TEST(ErrorRegistry, HasEveryNumberAndNameOnce) {
  std::set<std::int32_t> numbers;
  std::set<std::string_view> names;
  for (const ErrorEntry& e : error_registry()) {
    EXPECT_TRUE(numbers.insert(static_cast<std::int32_t>(e.code)).second) << e.name;
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_FALSE(e.meaning.empty()) << e.name;
    EXPECT_EQ(e.meaning.find('\n'), std::string_view::npos);
  }
}

TEST(ErrorRegistry, FindsEntriesByNameAndNumber) {
  for (const ErrorEntry& e : error_registry()) {
    EXPECT_EQ(error_code(e.name), e.code);
    EXPECT_EQ(error_code(static_cast<std::int64_t>(e.code)), e.code);
    EXPECT_EQ(name(e.code), e.name);
  }
  EXPECT_FALSE(error_code("no_such_code"));
  EXPECT_FALSE(error_code(-1));
}

TEST(ErrorRegistry, KeepsJsonRpcsOwnNumbers) {
  EXPECT_EQ(error_code("parse_error"), error_code(-32700));
  EXPECT_EQ(error_code("invalid_request"), error_code(-32600));
  EXPECT_EQ(error_code("method_not_found"), error_code(-32601));
  EXPECT_EQ(error_code("invalid_params"), error_code(-32602));
  EXPECT_EQ(error_code("unauthorized"), error_code(-32000));
}

TEST(ErrorFrom, PutsTheRefereesFieldBelowThePrefix) {
  const Error error = error_from(
      rules::Refusal{rules::RefusalCode::bad_call, "/call/ball", "ball 3 is down"}, "/params");
  EXPECT_EQ(error.code, ErrorCode::bad_call);
  EXPECT_EQ(error.field, "/params/call/ball");
  EXPECT_EQ(error.reason, "ball 3 is down");
}

TEST(ErrorFrom, CallsAnImpossibleStrokeABadShot) {
  const Error error =
      error_from(physics::Error{physics::Fault::miscue, "/b", "0.9 R, expected at most 0.5 R"},
                 "/params/params");
  EXPECT_EQ(error.code, ErrorCode::bad_shot);
  EXPECT_EQ(error.field, "/params/params/b");
}

TEST(EncodeError, TellsCodeFieldRetryableGameAndFoul) {
  EXPECT_EQ(
      encode_error({"7"},
                   {ErrorCode::stale_turn, "/params/turn", "turn 3 is over", GameId{5}, true}),
      R"({"jsonrpc":"2.0","id":7,"error":{"code":-32007,"message":"stale_turn: turn 3 is over",)"
      R"("data":{"code":"stale_turn","field":"/params/turn","retryable":false,"game":5,)"
      R"("foul":true}}})"
      "\n");
}

TEST(EncodeError, SaysTheMeaningWhereThereIsNoReason) {
  EXPECT_NE(encode_error({}, {ErrorCode::server_full, "", "", {}, false})
                .find("server_full: The server, or your address"),
            std::string::npos);
}

}  // namespace
}  // namespace poolhall::protocol
