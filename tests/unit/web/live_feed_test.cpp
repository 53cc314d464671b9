// Who is told what, and when a backlog becomes a snapshot.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <vector>

#include "server/web/live_feed.hpp"

namespace poolhall::web {
namespace {

using namespace std::chrono_literals;

Message text(std::string what) {
  return std::make_shared<const std::string>(std::move(what));
}

class LiveFeedTest : public ::testing::Test {
 protected:
  std::shared_ptr<Spectator> spectator() { return std::make_shared<Spectator>(io_.get_executor()); }
  void run() {
    io_.restart();
    io_.poll();
  }
  // All that waits for a spectator, joined by commas.
  static std::string taken(Spectator& spectator) {
    std::string all;
    while (const Message message = spectator.take()) {
      all += (all.empty() ? "" : ",") + *message;
    }
    return all;
  }

  boost::asio::io_context io_;
  std::vector<std::pair<Topic, Ticket>> asked_;
  std::vector<Topic> ended_;
  LiveFeed feed_{io_,
                 0ms,
                 {[this](Topic topic, Ticket ticket) { asked_.emplace_back(topic, ticket); },
                  [this](Topic topic) { ended_.push_back(topic); }}};
  const Topic game_ = game_topic(17);
};

TEST_F(LiveFeedTest, TellsNothingBeforeASnapshotAndEverythingAfterIt) {
  const auto one = spectator();
  feed_.join(one, game_);
  ASSERT_EQ(asked_.size(), 1U);
  feed_.publish(game_, text("too early"));
  feed_.snapshot(game_, asked_[0].second, text("snapshot"));
  feed_.publish(game_, text("a"));
  feed_.publish(game_topic(18), text("of another game"));
  feed_.publish(game_, text("b"));
  run();
  EXPECT_EQ(taken(*one), "snapshot,a,b");
}

TEST_F(LiveFeedTest, OneSnapshotServesAllWhoWaitAndOneMessageAllWhoWatch) {
  const auto one = spectator();
  const auto two = spectator();
  feed_.join(one, game_);
  feed_.join(two, game_);
  ASSERT_EQ(asked_.size(), 1U);
  feed_.snapshot(game_, asked_[0].second, text("snapshot"));
  const Message message = text("a");
  feed_.publish(game_, message);
  run();
  EXPECT_EQ(*one->take(), "snapshot");
  EXPECT_EQ(one->take(), message);
  EXPECT_EQ(*two->take(), "snapshot");
  EXPECT_EQ(two->take(), message);
}

TEST_F(LiveFeedTest, ASnapshotThatSomebodyElseAskedForEarlierIsNotTaken) {
  const auto one = spectator();
  feed_.join(one, game_);
  feed_.leave(one, game_);
  ASSERT_EQ(ended_, std::vector<Topic>{game_});
  const auto two = spectator();
  feed_.join(two, game_);
  ASSERT_EQ(asked_.size(), 2U);
  feed_.snapshot(game_, asked_[0].second, text("before a turn that nobody was told of"));
  feed_.snapshot(game_, asked_[1].second, text("fresh"));
  run();
  EXPECT_EQ(taken(*two), "fresh");
}

TEST_F(LiveFeedTest, ABacklogBeyondTheBoundBecomesAGapAndThenAFreshSnapshot) {
  const auto slow = spectator();
  const auto quick = spectator();
  feed_.join(slow, game_);
  feed_.join(quick, game_);
  feed_.snapshot(game_, asked_[0].second, text("snapshot"));
  run();
  const std::size_t bytes = 64 * 1024;
  for (int i = 0; i < 8; ++i) {
    feed_.publish(game_, text(std::string(bytes, 'x')));
    run();
    EXPECT_FALSE(taken(*quick).empty());
  }
  EXPECT_TRUE(slow->has_gap());
  EXPECT_EQ(slow->take(), nullptr) << "the backlog is dropped";
  EXPECT_FALSE(quick->has_gap());
  feed_.catch_up(slow, game_);
  ASSERT_EQ(asked_.size(), 2U);
  feed_.publish(game_, text("in between"));
  feed_.snapshot(game_, asked_[1].second, text("fresh"));
  feed_.publish(game_, text("next"));
  run();
  EXPECT_EQ(taken(*slow), "fresh,next");
  EXPECT_EQ(taken(*quick), "in between,next") << "who has no gap is told no snapshot";
}

TEST_F(LiveFeedTest, AMessageLongerThanTheBoundFitsAnEmptyQueue) {
  const auto one = spectator();
  feed_.join(one, game_);
  feed_.snapshot(game_, asked_[0].second, text(std::string(2 * Spectator::queue_bytes, 'x')));
  run();
  EXPECT_FALSE(one->has_gap());
  EXPECT_NE(one->take(), nullptr);
}

TEST_F(LiveFeedTest, TheLastWhoLeavesEndsTheTelling) {
  const auto one = spectator();
  const auto two = spectator();
  feed_.join(one, game_);
  feed_.join(two, game_);
  feed_.snapshot(game_, asked_[0].second, text("snapshot"));
  run();
  EXPECT_EQ(feed_.spectators(), 2U);
  feed_.leave(one, game_);
  EXPECT_TRUE(ended_.empty());
  feed_.leave(two, game_);
  EXPECT_EQ(ended_, std::vector<Topic>{game_});
  EXPECT_EQ(feed_.spectators(), 0U);
}

TEST(LiveFeedDelay, HoldsMessagesBackInTheirOrder) {
  boost::asio::io_context io;
  Ticket ticket{};
  LiveFeed feed{io, 30ms, {[&](Topic, Ticket asked) { ticket = asked; }, [](Topic) {}}};
  const auto one = std::make_shared<Spectator>(io.get_executor());
  feed.join(one, game_topic(1));
  const auto began = std::chrono::steady_clock::now();
  feed.snapshot(game_topic(1), ticket, text("snapshot"));
  feed.publish(game_topic(1), text("a"));
  io.poll();
  EXPECT_EQ(one->take(), nullptr);
  while (true) {
    io.run_one();
    if (const Message message = one->take()) {
      EXPECT_EQ(*message, "snapshot");
      break;
    }
  }
  EXPECT_GE(std::chrono::steady_clock::now() - began, 30ms);
  io.restart();
  io.run();
  EXPECT_EQ(*one->take(), "a");
}

}  // namespace
}  // namespace poolhall::web
