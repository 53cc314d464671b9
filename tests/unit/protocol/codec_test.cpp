// What one side writes, the other reads.
#include "protocol/codec.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/json_value.hpp"
#include "protocol/table_json.hpp"
#include "tests/support/sample_messages.hpp"

namespace poolhall::protocol {
namespace {

const Limits codec_limits;

std::string_view without_end(const std::string& line) {
  EXPECT_TRUE(line.ends_with('\n'));
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  return std::string_view(line).substr(0, line.size() - 1);
}

ServerMessage received(const std::string& line, std::optional<Method> method = {}) {
  auto message = decode_server_message(without_end(line), [&](const RequestId&) { return method; });
  if (!message) {
    ADD_FAILURE() << message.error().field << ": " << message.error().reason << "\n" << line;
    return UnknownNotification{};
  }
  return std::move(*message);
}

std::string canonical(std::string_view line) {
  const auto value = parse_json(line, {32, 1'000'000});
  return value ? canonical_text(*value) : "not JSON";
}

TEST(Codec, ReadsBackEveryRequest) {
  for (const Request& request : test_support::sample_requests()) {
    const std::string line = encode_request(5, request);
    const auto incoming = decode_request(without_end(line), codec_limits);
    ASSERT_TRUE(incoming) << line << incoming.error().error.field << ": "
                          << incoming.error().error.reason;
    EXPECT_EQ(incoming->id->json, "5");
    EXPECT_EQ(incoming->request.index(), request.index());
    EXPECT_EQ(encode_request(5, incoming->request), line);
  }
}

TEST(Codec, ReadsBackLagWithoutAnId) {
  const auto incoming = decode_request(without_end(encode_lag({42})), codec_limits);
  ASSERT_TRUE(incoming);
  EXPECT_FALSE(incoming->id);
  EXPECT_EQ(std::get<Lag>(incoming->request).t, 42);
}

TEST(Codec, HasSampleMessagesOfEveryKind) {
  std::vector<bool> requests(std::variant_size_v<Request>);
  for (const Request& request : test_support::sample_requests()) {
    requests[request.index()] = true;
  }
  std::vector<bool> replies(requests.size());
  for (const auto& sample : test_support::sample_replies()) {
    replies[static_cast<std::size_t>(sample.method)] = true;
  }
  std::vector<bool> notifications(notification_count);
  for (const auto& notification : test_support::sample_notifications()) {
    notifications[notification.index()] = true;
  }
  for (const auto& seen : {requests, replies, notifications}) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_TRUE(seen[i]) << i;
    }
  }
}

TEST(Codec, ClientsReadEveryReply) {
  for (const auto& sample : test_support::sample_replies()) {
    const std::string line = encode_reply({"\"a\""}, sample.reply);
    const ServerMessage message = received(line, sample.method);
    const auto* reply = std::get_if<ReplyMessage>(&message);
    ASSERT_NE(reply, nullptr) << line;
    EXPECT_EQ(reply->id.json, "\"a\"");
    EXPECT_EQ(reply->reply.index(), sample.reply.index());
  }
}

TEST(Codec, ClientsReadEveryNotification) {
  std::uint64_t seq = 0;
  for (const auto& notification : test_support::sample_notifications()) {
    const std::string line = encode_notification(notification, ++seq);
    const ServerMessage message = received(line);
    const auto* read = std::get_if<NotificationMessage>(&message);
    ASSERT_NE(read, nullptr) << line;
    EXPECT_EQ(read->seq, seq);
    EXPECT_EQ(read->notification.index(), notification.index());
  }
}

TEST(Codec, ClientsSeeAShotExactlyAsItWasPlayed) {
  const test_support::PlayedBreak played = test_support::played_break(rules::RuleSet::eight_ball);
  for (const auto& sample : test_support::sample_replies()) {
    const auto* sent = std::get_if<ShotReply<Outgoing>>(&sample.reply);
    if (sent == nullptr || sent->repetition == Repetition::first_time) {
      continue;
    }
    const ServerMessage message = received(encode_reply({"1"}, sample.reply), sample.method);
    const auto& seen = std::get<ShotReply<Received>>(std::get<ReplyMessage>(message).reply);
    EXPECT_EQ(seen.repetition, Repetition::duplicate);
    EXPECT_EQ(seen.shot.state, played.ruling.next);
    EXPECT_EQ(seen.shot.executed, played.params);
    EXPECT_EQ(seen.shot.cue_ball, played.cue_ball);
    EXPECT_EQ(encode_events(seen.shot.events, EventDetail::full),
              encode_events(played.events, EventDetail::full));
  }
}

TEST(Codec, PutsRawPartsIntoTheMessageAsTheyAre) {
  GameDecision<Outgoing> decision;
  decision.state.text = R"({"any":[1,2]})";
  EXPECT_NE(encode_notification(decision, 1).find(R"("state":{"any":[1,2]},"clock")"),
            std::string::npos);
}

TEST(Codec, WritesEveryLineAsOneJsonObject) {
  for (const auto& notification : test_support::sample_notifications()) {
    const std::string line = encode_notification(notification, 3);
    EXPECT_EQ(canonical(without_end(line)), without_end(line));
  }
}

TEST(Codec, ClientsReadErrors) {
  const Error error{ErrorCode::bad_call, "/params/call/ball", "it is down", GameId{4}, true};
  const ServerMessage message = received(encode_error({"9"}, error));
  const auto& read = std::get<ErrorMessage>(message);
  EXPECT_EQ(read.id.json, "9");
  EXPECT_EQ(read.code, "bad_call");
  EXPECT_EQ(read.error.code, ErrorCode::bad_call);
  EXPECT_EQ(read.error.field, error.field);
  EXPECT_EQ(read.error.game, error.game);
  EXPECT_TRUE(read.error.foul);
  EXPECT_FALSE(read.retryable);
}

TEST(Codec, ClientsReadErrorsOfPlainJsonRpcServers) {
  const ServerMessage message =
      received("{\"jsonrpc\":\"2.0\",\"id\":null,\"error\":{\"code\":-1,\"message\":\"odd\"}}\n");
  EXPECT_EQ(std::get<ErrorMessage>(message).code, "odd");
  EXPECT_EQ(std::get<ErrorMessage>(message).error.code, ErrorCode::internal);
}

TEST(Codec, ClientsPassOverNotificationsThatTheyDoNotKnow) {
  const ServerMessage message =
      received("{\"jsonrpc\":\"2.0\",\"method\":\"game.weather\",\"params\":{\"seq\":8}}\n");
  EXPECT_EQ(std::get<UnknownNotification>(message).method, "game.weather");
  EXPECT_EQ(std::get<UnknownNotification>(message).seq, 8U);
}

TEST(Codec, ClientsRefuseAReplyThatNothingAwaits) {
  const auto message = decode_server_message(R"({"jsonrpc":"2.0","id":3,"result":{}})",
                                             [](const RequestId&) { return std::nullopt; });
  ASSERT_FALSE(message);
  EXPECT_EQ(message.error().field, "/id");
}

TEST(Codec, ClientsNameTheFieldOfABadReply) {
  const auto message = decode_server_message(R"({"jsonrpc":"2.0","id":3,"result":{"game":"x"}})",
                                             [](const RequestId&) { return Method::ack; });
  ASSERT_FALSE(message);
  EXPECT_EQ(message.error().field, "/result/game");
}

TEST(Methods, HaveNamesThatLeadBackToThem) {
  for (std::size_t i = 0; i < std::variant_size_v<Request>; ++i) {
    EXPECT_EQ(method(name(static_cast<Method>(i))), static_cast<Method>(i));
  }
  for (std::size_t i = 0; i < notification_count; ++i) {
    EXPECT_EQ(notification_index(notification_name(i)), i);
  }
  EXPECT_FALSE(method("game.state"));
}

}  // namespace
}  // namespace poolhall::protocol
