// The small parts of a connection: rates, lag, tokens, deadlines, endpoints.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>

#include "server/net/agent_book.hpp"
#include "server/net/deadline_queue.hpp"
#include "server/net/lag_meter.hpp"
#include "server/net/server.hpp"
#include "server/net/tokens.hpp"
#include "server/web/token_bucket.hpp"

namespace poolhall::net {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

TEST(TokenBucket, AllowsItsBurstAtOnceAndItsRateAfterwards) {
  web::TokenBucket bucket{50, 100};
  const auto start = steady_clock::now();
  int taken = 0;
  while (bucket.take(start)) {
    ++taken;
  }
  EXPECT_EQ(taken, 100);
  for (int i = 1; i <= 50; ++i) {
    EXPECT_TRUE(bucket.take(start + i * 20ms)) << i;
    EXPECT_FALSE(bucket.take(start + i * 20ms)) << i;
  }
}

TEST(TokenBucket, SavesNoMoreThanItsBurst) {
  web::TokenBucket bucket{10, 5};
  const auto later = steady_clock::now() + 1h;
  int taken = 0;
  while (bucket.take(later)) {
    ++taken;
  }
  EXPECT_EQ(taken, 5);
}

TEST(LagMeter, GivesNoCreditToWhoNeverAnswers) {
  LagMeter meter;
  static_cast<void>(meter.probe(steady_clock::now()));
  EXPECT_EQ(meter.lag(), 0us);
}

TEST(LagMeter, TakesTheLeastOfTheRecentRoundTrips) {
  LagMeter meter;
  const auto start = steady_clock::now();
  for (const auto trip : {30ms, 10ms, 50ms}) {
    const auto t = meter.probe(start);
    EXPECT_TRUE(meter.answered(t, start + trip));
  }
  EXPECT_EQ(meter.lag(), 10ms);
  for (int i = 0; i < 8; ++i) {
    const auto t = meter.probe(start);
    EXPECT_TRUE(meter.answered(t, start + 40ms));
  }
  EXPECT_EQ(meter.lag(), 40ms);
}

// What a client does first after its login may keep it from answering.
TEST(LagMeter, WantsTheFirstProbesOneRightAfterTheOtherAndThenOneInTwoSeconds) {
  LagMeter meter;
  auto now = steady_clock::now();
  for (const auto trip : {90ms, 20ms, 21ms, 20ms}) {
    EXPECT_TRUE(meter.wants_probe(now));
    const auto t = meter.probe(now);
    EXPECT_FALSE(meter.wants_probe(now + 1s));
    EXPECT_TRUE(meter.answered(t, now += trip));
  }
  EXPECT_EQ(meter.lag(), 20ms);
  EXPECT_FALSE(meter.wants_probe(now + 1s));
  EXPECT_TRUE(meter.wants_probe(now + 2s));
}

TEST(LagMeter, CountsAnAnswerOnceAndOnlyToItsOwnProbe) {
  LagMeter meter;
  const auto start = steady_clock::now();
  const auto t = meter.probe(start);
  EXPECT_FALSE(meter.answered(t + 1, start + 1ms));
  EXPECT_TRUE(meter.answered(t, start + 20ms));
  EXPECT_FALSE(meter.answered(t, start + 21ms));
  EXPECT_EQ(meter.lag(), 20ms);
}

TEST(Tokens, AreSixtyFourHexDigitsAndNeverTheSame) {
  const std::string token = new_token();
  EXPECT_TRUE(is_token(token));
  EXPECT_NE(token, new_token());
  EXPECT_FALSE(is_token(token.substr(1)));
  EXPECT_FALSE(is_token(token.substr(1) + "g"));
}

// SHA-256 of 32 zero bytes, from the standard's own test generators.
TEST(Tokens, AreKeptAsSha256OfTheirBytes) {
  const TokenHash hash = hash_of(std::string(64, '0'));
  EXPECT_EQ(hash[0], 0x66);
  EXPECT_EQ(hash[1], 0x68);
  EXPECT_EQ(hash[30], 0x29);
  EXPECT_EQ(hash[31], 0x25);
  EXPECT_TRUE(same(hash, hash_of(std::string(64, '0'))));
  EXPECT_FALSE(same(hash, hash_of(std::string(63, '0') + "1")));
}

TEST(Tokens, MeanTheSameInEitherCase) {
  EXPECT_EQ(hash_of(std::string(64, 'A')), hash_of(std::string(64, 'a')));
}

TEST(AgentBook, FindsByNameInAnyCaseAndByToken) {
  AgentBook book;
  storage::AgentRecord record;
  record.id = storage::AgentId{3};
  record.name = "Anna";
  record.token_hash = hash_of(std::string(64, '1'));
  Agent& anna = book.add(record);
  EXPECT_EQ(book.named("aNNA"), &anna);
  EXPECT_EQ(book.with_token(hash_of(std::string(64, '1'))), &anna);
  EXPECT_EQ(book.with_token(hash_of(std::string(64, '2'))), nullptr);
  book.set_token(anna, hash_of(std::string(64, '2')));
  EXPECT_EQ(book.with_token(hash_of(std::string(64, '1'))), nullptr);
  EXPECT_EQ(book.with_token(hash_of(std::string(64, '2'))), &anna);
  book.remove(storage::AgentId{3});
  EXPECT_EQ(book.named("anna"), nullptr);
  EXPECT_EQ(book.with_token(hash_of(std::string(64, '2'))), nullptr);
}

TEST(DeadlineQueue, RunsActionsInTheOrderOfTheirTimes) {
  boost::asio::io_context io;
  DeadlineQueue queue{io};
  std::string order;
  const auto now = steady_clock::now();
  const Deadline second = queue.at(now + 2ms, [&] { order += "b"; });
  const Deadline first = queue.at(now + 1ms, [&] { order += "a"; });
  const Deadline third = queue.at(now + 3ms, [&] { order += "c"; });
  io.run();
  EXPECT_EQ(order, "abc");
}

TEST(DeadlineQueue, ForgetsWhatIsCancelledOrDestroyed) {
  boost::asio::io_context io;
  DeadlineQueue queue{io};
  int runs = 0;
  const auto now = steady_clock::now();
  Deadline cancelled = queue.at(now, [&] { ++runs; });
  cancelled.cancel();
  static_cast<void>(queue.at(now, [&] { ++runs; }));
  const Deadline kept = queue.at(now + 1ms, [&] { ++runs; });
  io.run();
  EXPECT_EQ(runs, 1);
}

TEST(DeadlineQueue, LetsAnActionSetAndCancelOthers) {
  boost::asio::io_context io;
  DeadlineQueue queue{io};
  int runs = 0;
  const auto now = steady_clock::now();
  Deadline later;
  Deadline other = queue.at(now + 1ms, [&] { runs += 100; });
  const Deadline first = queue.at(now, [&] {
    other.cancel();
    later = queue.at(now, [&] { ++runs; });
  });
  io.run();
  EXPECT_EQ(runs, 1);
}

TEST(Deadline, MayOutliveItsQueue) {
  boost::asio::io_context io;
  Deadline deadline;
  {
    DeadlineQueue queue{io};
    deadline = queue.at(steady_clock::now() + 1h, [] {});
  }
  deadline.cancel();
  EXPECT_FALSE(deadline.is_set());
}

TEST(Endpoint, IsReadInBothFamilies) {
  EXPECT_EQ(parse_endpoint("127.0.0.1:7777")->port, 7777);
  EXPECT_EQ(parse_endpoint("localhost:1")->host, "127.0.0.1");
  EXPECT_EQ(parse_endpoint("[::1]:80")->host, "::1");
  EXPECT_EQ(to_string(*parse_endpoint("[::1]:80")), "[::1]:80");
  for (const char* wrong : {"", "7777", ":7777", "host:", "host:x", "host:65536", "host:-1"}) {
    EXPECT_FALSE(parse_endpoint(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace poolhall::net
