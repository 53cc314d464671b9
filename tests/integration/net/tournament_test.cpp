// Matches of a tournament between house bots in processes of their own.
#include <gtest/gtest.h>

#include <future>

#include "server/storage/sqlite_database.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"
#include "wire_client.hpp"

namespace poolhall::net_tests {
namespace {

const std::string cup = "cup";

net::MatchOrder order_of(std::uint32_t games) {
  net::MatchOrder order;
  order.tournament = cup;
  order.pairing = 3;
  order.agents = {"one", "two"};
  order.games = games;
  order.seed = 7;
  order.mirrored = storage::Mirror::rack;
  return order;
}

// What a driver does at its start, the first time and again.
void drive(net::MatchHost& host, std::uint32_t games) {
  static_cast<void>(host.open_tournament({cup, "The cup", "", net::TournamentStatus::running}));
  for (const char* name : {"one", "two"}) {
    net::TournamentEntry entry;
    entry.tournament = cup;
    entry.name = name;
    entry.house_bot = "random";
    host.enter(entry);
  }
  host.start_match(order_of(games));
}

TEST(Tournament, IsPlayedByHouseBotsAndGoesOnAfterARestart) {
  test_support::TemporaryDirectory directory;
  constexpr std::uint32_t games = 4;
  {
    TestServer server{directory / "test.db"};
    std::promise<void> one_game;
    server.server().post([&](net::MatchHost& host) {
      host.on_game_over([&, told = false](const net::MatchOrder&, const net::GameOutcome&) mutable {
        if (!std::exchange(told, true)) {
          one_game.set_value();
        }
      });
      drive(host, games);
    });
    ASSERT_EQ(one_game.get_future().wait_for(patience), std::future_status::ready);
    server.stop();
  }
  TestServer server{directory / "test.db"};
  std::promise<net::MatchOutcome> over;
  server.server().post([&](net::MatchHost& host) {
    host.on_match_over([&](const net::MatchOutcome& outcome) { over.set_value(outcome); });
    drive(host, games);
  });
  auto future = over.get_future();
  ASSERT_EQ(future.wait_for(patience), std::future_status::ready);
  const net::MatchOutcome outcome = future.get();
  EXPECT_EQ(outcome.pairing, 3U);
  ASSERT_EQ(outcome.games.size(), games);
  for (std::uint32_t i = 0; i < games; ++i) {
    EXPECT_EQ(outcome.games[i].number, i);
    EXPECT_EQ(outcome.games[i].breaker, i % 2);
    EXPECT_NE(outcome.games[i].reason, rules::EndReason::timeout);
  }
  auto reader = storage::open_sqlite_reader(directory / "test.db").value();
  const auto first = reader->game(outcome.games[0].game).value();
  const auto second = reader->game(outcome.games[1].game).value();
  const auto third = reader->game(outcome.games[2].game).value();
  EXPECT_EQ(first->rack_seed, second->rack_seed);
  EXPECT_NE(first->rack_seed, third->rack_seed);
}

TEST(Tournament, ReportsAFinishedMatchAgainWhenItIsOrderedAgain) {
  test_support::TemporaryDirectory directory;
  TestServer server{directory / "test.db"};
  std::promise<void> twice;
  server.server().post([&](net::MatchHost& host) {
    host.on_match_over([&, times = 0](const net::MatchOutcome& outcome) mutable {
      EXPECT_EQ(outcome.games.size(), 1U);
      if (++times == 2) {
        twice.set_value();
      } else {
        host.start_match(order_of(1));
      }
    });
    drive(host, 1);
  });
  ASSERT_EQ(twice.get_future().wait_for(patience), std::future_status::ready);
}

}  // namespace
}  // namespace poolhall::net_tests
