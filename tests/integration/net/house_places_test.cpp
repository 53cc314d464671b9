// More bots of the house than places for their processes: games wait for a place, without a clock
// and without a forfeit, and none waits for ever.
#include <gtest/gtest.h>

#include <future>
#include <map>

#include "scripted_play.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"
#include "wire_client.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;

// Holds a place and never comes.
const std::string sleeper = "exec sleep 1000";

class HousePlaces : public ::testing::Test {
 protected:
  void start(std::uint32_t places) {
    server_.reset();
    options_.settings.max_house_bots = places;
    for (const std::uint32_t pairing : {1U, 2U, 3U, 4U}) {
      over_[pairing];
    }
    server_ = std::make_unique<TestServer>(options_);
    server_->server().post([this](net::MatchHost& host) {
      host.open_tournament({"cup", "The cup", "", net::TournamentStatus::running});
      host.on_match_over([this](const net::MatchOutcome& outcome) {
        over_.at(outcome.pairing).set_value(outcome);
      });
    });
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  void enter(const net::TournamentEntry& entry) {
    server_->server().post([entry](net::MatchHost& host) { host.enter(entry); });
  }
  void enter_bots(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      enter({.tournament = "cup", .name = name, .house_bot = "random"});
    }
  }
  void enter_sleeper(const std::string& name) {
    enter({.tournament = "cup", .name = name, .command = sleeper});
  }
  void order(std::uint32_t pairing, const std::string& first, const std::string& second,
             std::chrono::microseconds clock = std::chrono::seconds{600}) {
    net::MatchOrder order{.tournament = "cup", .pairing = pairing, .agents = {first, second}};
    order.terms.clock = clock;
    order.seed = pairing;
    server_->server().post([order](net::MatchHost& host) { host.start_match(order); });
  }
  [[nodiscard]] rules::EndReason end_of(std::uint32_t pairing) {
    auto over = over_.at(pairing).get_future();
    if (over.wait_for(patience) != std::future_status::ready) {
      throw std::runtime_error("a match does not end");
    }
    return over.get().games.at(0).reason;
  }
  static void concede(WireClient& client, protocol::GameId game) {
    static_cast<void>(client.call<protocol::GameReply>(protocol::Concede{game}));
  }

  test_support::TemporaryDirectory directory_;
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::map<std::uint32_t, std::promise<net::MatchOutcome>> over_;
  std::unique_ptr<TestServer> server_;
};

TEST_F(HousePlaces, GoFromGameToGameWhenThereAreFewerThanBots) {
  start(2);
  enter_bots({"a", "b", "c", "d"});
  order(1, "a", "b");
  order(2, "c", "d");
  order(3, "a", "c");
  order(4, "b", "d");
  for (const std::uint32_t pairing : {1U, 2U, 3U, 4U}) {
    EXPECT_NE(end_of(pairing), rules::EndReason::forfeit) << pairing;
  }
}

// a and c hold a place each when the games of a with b and of c with d are ordered.
TEST_F(HousePlaces, AreNotHeldByTwoGamesThatWaitForEachOther) {
  start(2);
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  enter_bots({"a", "b", "c", "d"});
  order(1, "anna", "a");
  order(2, "bert", "c");
  const Turn of_anna = anna.wait_for<Turn>();
  const Turn of_bert = bert.wait_for<Turn>();
  order(3, "a", "b");
  order(4, "c", "d");
  concede(anna, of_anna.game);
  concede(bert, of_bert.game);
  EXPECT_NE(end_of(3), rules::EndReason::forfeit);
  EXPECT_NE(end_of(4), rules::EndReason::forfeit);
}

TEST_F(HousePlaces, AreWaitedForWithoutAForfeit) {
  options_.settings.limits.entry_deadline = milliseconds{50};
  options_.settings.limits.arrival_deadline = milliseconds{50};
  start(1);
  const std::string bert_token = WireClient{port()}.join("bert");
  WireClient anna{port()};
  anna.join("anna");
  enter_sleeper("holder");
  enter_sleeper("waiting");
  order(1, "holder", "bert");  // neither comes: the clock runs
  order(2, "anna", "waiting");
  order(3, "anna", "nobody");
  EXPECT_EQ(end_of(3), rules::EndReason::forfeit);  // after the deadline of the game before it
  auto waiting = over_.at(2).get_future();
  EXPECT_EQ(waiting.wait_for(milliseconds{0}), std::future_status::timeout);
  WireClient bert{port()};
  concede(bert, bert.login(bert_token).games.at(0).game);
  ASSERT_EQ(waiting.wait_for(patience), std::future_status::ready);
  EXPECT_EQ(waiting.get().games.at(0).reason, rules::EndReason::forfeit)
      << "it has its place and does not come";
}

TEST_F(HousePlaces, AreWaitedForWithoutAClockAfterARestart) {
  options_.settings.limits.entry_deadline = milliseconds{50};
  options_.settings.limits.return_deadline = milliseconds{500};
  options_.settings.limits.arrival_deadline = milliseconds{1'000};
  const auto order_all = [this] {
    enter_sleeper("holder");
    enter_sleeper("waiting");
    order(1, "holder", "bert");
    order(2, "waiting", "anna", milliseconds{1});
  };
  start(1);
  static_cast<void>(WireClient{port()}.join("bert"));
  std::string token;
  {
    WireClient anna{port()};
    token = anna.join("anna");
    order_all();
    static_cast<void>(anna.wait_for<protocol::GameStart<Received>>());
  }
  start(1);
  order_all();
  WireClient anna{port()};
  anna.login(token);
  order(3, "anna", "nobody");
  EXPECT_EQ(end_of(3), rules::EndReason::forfeit);  // after the others' deadlines
  EXPECT_EQ(over_.at(2).get_future().wait_for(milliseconds{0}), std::future_status::timeout);
}

TEST_F(HousePlaces, AreSaidToBeMissingToWhoChallenges) {
  start(0);
  WireClient anna{port()};
  anna.join("anna");
  protocol::Challenge challenge;
  challenge.opponent = "house:greedy";
  EXPECT_EQ(anna.refused(challenge).error.reason,
            "unknown_agent: got \"house:greedy\", expected the name of an agent: this server "
            "employs no house "
            "bots (max_house_bots = 0)");
}

}  // namespace
}  // namespace poolhall::net_tests
