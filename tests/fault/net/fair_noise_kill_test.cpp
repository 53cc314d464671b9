// The program is killed between any two steps of making a game's noise: before or after each
// transaction of commitments, reveals and the first turn. Whatever comes, the noise is made of both
// agents' bytes in the end, and the database agrees with itself.
#include <gtest/gtest.h>

#include <tuple>

#include "../../integration/net/scripted_play.hpp"
#include "../../integration/net/server_process.hpp"
#include "server/match/chain.hpp"
#include "server/match/sha256.hpp"
#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::GameReply;
using protocol::Hex256;
using protocol::Received;

struct Player {
  const char* name;
  Hex256 token;
  Hex256 secret;
  std::unique_ptr<WireClient> wire{};

  [[nodiscard]] Hex256 commitment() const {
    return {match::to_hex(match::sha256(match::digest_of(secret.text)))};
  }
};

class NoiseKilledAt : public ::testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  void start(const std::string& failpoint) {
    server_ = std::make_unique<ServerProcess>(
        directory_.path(), std::vector<std::string>{},
        std::vector<std::string>{"POOLHALL_FAILPOINT=" + failpoint});
  }

  // Everybody as a program would that remembers nothing but its token and its bytes.
  void play() {
    for (Player& player : players_) {
      player.wire = std::make_unique<WireClient>(server_->port());
      player.wire->hello();
      static_cast<void>(
          player.wire->call<protocol::LoginReply>(protocol::Register{player.name, player.token}));
    }
    const bool goes_on = find_game();
    if (over_) {
      return;
    }
    if (!goes_on) {
      make_game();
    }
    if (!has_first_turn_) {
      for (Player& player : players_) {
        static_cast<void>(player.wire->call<GameReply>(protocol::GameReveal{game_, player.secret}));
      }
      const Turn turn = players_[0].wire->wait_for<Turn>();
      static_cast<void>(players_[0].wire->call<protocol::ShotReply<Received>>(scripted_shot(turn)));
    }
    static_cast<void>(players_[0].wire->call<GameReply>(protocol::Concede{game_}));
    over_ = true;
  }

  // What a login says of the game: whether it is there, whether its first turn is played.
  bool find_game() {
    static_cast<void>(players_[0].wire->call<protocol::PingReply>(protocol::Ping{}));
    const std::string& heard = players_[0].wire->heard();
    over_ = heard.find("\"game.over\"") != std::string::npos;
    if (over_ || heard.find("\"game.state\"") == std::string::npos) {
      return over_;
    }
    const auto snapshot = players_[0].wire->wait_for<protocol::GameSnapshot<Received>>();
    game_ = snapshot.terms.game;
    has_first_turn_ = snapshot.state.turn > 1;
    return true;
  }

  void make_game() {
    for (Player& player : players_) {
      static_cast<void>(
          player.wire->call<protocol::EmptyReply>(protocol::GameReady{player.commitment()}));
    }
    protocol::Challenge challenge;
    challenge.opponent = players_[1].name;
    static_cast<void>(players_[0].wire->call<protocol::ChallengeReply>(challenge));
    const auto offer = players_[1].wire->wait_for<protocol::ChallengeOffer>();
    static_cast<void>(players_[1].wire->call<protocol::ChallengeReply>(
        protocol::ChallengeAccept{offer.challenge}));
    game_ = players_[0].wire->wait_for<protocol::GameStart<Received>>().terms.game;
  }

  test_support::TemporaryDirectory directory_;
  std::unique_ptr<ServerProcess> server_;
  std::array<Player, 2> players_{{{"anna", {std::string(64, '1')}, {std::string(64, 'a')}},
                                  {"bert", {std::string(64, '2')}, {std::string(64, 'b')}}}};
  protocol::GameId game_{};
  bool has_first_turn_ = false;
  bool over_ = false;
};

TEST_P(NoiseKilledAt, IsMadeOfBothAgentsBytesAllTheSame) {
  start(std::get<0>(GetParam()) + std::to_string(std::get<1>(GetParam())));
  int kills = 0;
  for (int attempt = 0; attempt < 3 && !over_; ++attempt) {
    try {
      play();
    } catch (const std::runtime_error&) {
      ASSERT_EQ(server_->wait(), -1) << "the server ended, but not by the kill";
      ++kills;
      start("after_commit:1000000");
    }
  }
  EXPECT_EQ(kills, 1);
  EXPECT_EQ(server_->terminate(), 0);
  auto reader = storage::open_sqlite_reader(directory_ / "server.db").value();
  const auto report = match::verify(*reader, {}).value();
  EXPECT_TRUE(report.same()) << (report.differences.empty() ? "" : report.differences[0].reason);
  EXPECT_EQ(report.games, 1U);
  EXPECT_EQ(report.shots, 1U);
  const auto record = reader->game(protocol::GameId{1}).value().value();
  for (const std::size_t seat : {0U, 1U}) {
    EXPECT_EQ(record.agent_secrets[seat], match::digest_of(players_[seat].secret.text)) << seat;
  }
}

// Transactions: 1, 2 the agents; 3 match and game; 4, 5 the reveals; 6 the first turn.
INSTANTIATE_TEST_SUITE_P(Transactions, NoiseKilledAt,
                         ::testing::Combine(::testing::Values("before_commit:", "after_commit:"),
                                            ::testing::Values(3, 4, 5, 6)));

}  // namespace
}  // namespace poolhall::net_tests
