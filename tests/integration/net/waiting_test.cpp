// Everything that waits has a deadline: for agents to register, to come, and to come back.
#include <gtest/gtest.h>

#include "scripted_play.hpp"
#include "server/storage/sqlite_database.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;

class Waiting : public ::testing::Test {
 protected:
  Waiting() {
    limits().entry_deadline = milliseconds{50};
    limits().arrival_deadline = milliseconds{50};
    limits().return_deadline = milliseconds{50};
  }
  protocol::Limits& limits() { return options_.settings.limits; }
  void start() {
    server_.reset();
    server_ = std::make_unique<TestServer>(options_);
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  void order(std::uint32_t games, std::chrono::microseconds clock = std::chrono::seconds{600}) {
    server_->server().post([games, clock](net::MatchHost& host) {
      host.open_tournament({"cup", "The cup", "", net::TournamentStatus::running});
      net::MatchOrder order{.tournament = "cup", .agents = {"anna", "bert"}, .games = games};
      order.terms.clock = clock;
      host.enter({.tournament = "cup", .name = "anna"});
      host.enter({.tournament = "cup", .name = "bert"});
      host.start_match(order);
    });
  }

  test_support::TemporaryDirectory directory_;
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::unique_ptr<TestServer> server_;
};

TEST_F(Waiting, ForOneWhoNeverRegistersEndsWithForfeits) {
  start();
  WireClient anna{port()};
  anna.join("anna");
  order(2);
  for (int i = 0; i < 2; ++i) {
    const auto over = anna.wait_for<protocol::GameOver>();
    EXPECT_EQ(over.reason, rules::EndReason::forfeit);
    EXPECT_TRUE(over.scored);
  }
  EXPECT_EQ(anna.wait_for<protocol::MatchOver>().own_points, 2);
}

// Where neither has registered no clock is waited for: the one to break forfeits.
TEST_F(Waiting, ForTwoWhoNeverRegisterEndsWithForfeits) {
  start();
  order(2);
  auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
  for (std::int64_t id = 1; id <= 2; ++id) {
    std::optional<storage::GameRecord> game;
    while (!game || !game->over) {
      game = reader->game(protocol::GameId{id}).value();
    }
    EXPECT_EQ(game->result->reason, rules::EndReason::forfeit);
    EXPECT_EQ(game->result->winner, rules::other(game->breaker)) << id;
  }
}

TEST_F(Waiting, LeavesTheNameToItsOwner) {
  limits().arrival_deadline = milliseconds{60'000};
  start();
  WireClient anna{port()};
  anna.join("anna");
  order(1);
  static_cast<void>(anna.wait_for<protocol::GameStart<Received>>());  // bert waited for in vain
  WireClient bert{port()};
  const std::string token = bert.join("bert");
  static_cast<void>(bert.wait_for<protocol::GameSnapshot<Received>>());
  const Turn turn = anna.wait_for<Turn>();
  static_cast<void>(anna.call<protocol::ShotReply<Received>>(scripted_shot(turn)));
  WireClient other{port()};
  other.hello();
  EXPECT_EQ(other.refused(protocol::Register{"Bert", {}}).code, "name_taken");
  start();
  WireClient again{port()};
  EXPECT_EQ(again.login(token).games.size(), 1U);
}

TEST_F(Waiting, ForOneWhoDoesNotComeEndsWithAForfeit) {
  start();
  WireClient anna{port()};
  anna.join("anna");
  {
    WireClient bert{port()};
    bert.join("bert");
  }
  order(1);
  EXPECT_EQ(anna.wait_for<protocol::GameOver>().reason, rules::EndReason::forfeit);
}

TEST_F(Waiting, ForBothStartsTheClockOfTheOneToMove) {
  start();
  {
    WireClient anna{port()};
    WireClient bert{port()};
    anna.join("anna");
    bert.join("bert");
  }
  order(1, milliseconds{50});
  auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
  std::optional<storage::GameRecord> game;
  while (!game || !game->over) {
    game = reader->game(protocol::GameId{1}).value();
  }
  EXPECT_EQ(game->result->reason, rules::EndReason::timeout);
}

TEST_F(Waiting, AfterARestartStartsTheClockOfTheOneToMove) {
  start();
  std::string token;
  {
    WireClient anna{port()};
    WireClient bert{port()};
    anna.join("anna");
    token = bert.join("bert");
    static_cast<void>(start_game(anna, bert, "bert", {.game_ms = 1'000}));
    static_cast<void>(anna.wait_for<Turn>());
  }
  start();
  WireClient bert{port()};
  bert.login(token);
  const auto over = bert.wait_for<protocol::GameOver>();
  EXPECT_EQ(over.reason, rules::EndReason::timeout);
  EXPECT_EQ(over.winner, rules::Seat::second);
}

}  // namespace
}  // namespace poolhall::net_tests
