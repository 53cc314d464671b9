// Who was away when a game, a match or a tournament ended learns of it at the next login, and at
// every other until it is acknowledged, whatever happens to the server meanwhile.
#include <gtest/gtest.h>

#include "scripted_play.hpp"
#include "server/net/untold.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;

class Ends : public ::testing::Test {
 protected:
  void restart() {
    server_.reset();
    server_ = std::make_unique<TestServer>(directory_ / "test.db");
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  // A login that has been told everything that logins are told.
  std::unique_ptr<WireClient> come_back(const std::string& token) {
    auto client = std::make_unique<WireClient>(port());
    client->login(token);
    static_cast<void>(client->call<protocol::PingReply>(protocol::Ping{}));
    return client;
  }
  // Anna goes away, then Bert concedes their game; her token.
  std::string game_without_anna() {
    WireClient bert{port()};
    bert.join("bert");
    std::string token;
    protocol::GameId game{};
    {
      WireClient anna{port()};
      token = anna.join("anna");
      game = start_game(anna, bert, "bert");
    }
    static_cast<void>(bert.call<protocol::GameReply>(protocol::Concede{game}));
    static_cast<void>(bert.wait_for<protocol::MatchOver>());
    return token;
  }

  test_support::TemporaryDirectory directory_;
  std::unique_ptr<TestServer> server_ = std::make_unique<TestServer>(directory_ / "test.db");
};

TEST_F(Ends, OfAMatchAreToldAgainUntilTheyAreAcknowledged) {
  const std::string token = game_without_anna();
  for (int i = 0; i < 2; ++i) {
    const auto anna = come_back(token);
    const auto over = anna->wait_for<protocol::MatchOver>();
    EXPECT_EQ(over.opponent, "bert");
    EXPECT_EQ(over.own_points, 1);
    EXPECT_EQ(over.seeds.size(), 1U);
    restart();
  }
  const auto anna = come_back(token);
  const auto over = anna->wait_for<protocol::MatchOver>();
  static_cast<void>(anna->call<protocol::AckReply>(protocol::Ack{over.match}));
  restart();
  EXPECT_EQ(come_back(token)->kept<protocol::MatchOver>(), 0U);
}

TEST_F(Ends, OfAMatchAreAcknowledgedByItsAgentsAlone) {
  const std::string token = game_without_anna();
  const auto over = come_back(token)->wait_for<protocol::MatchOver>();
  WireClient carl{port()};
  carl.join("carl");
  const auto refused = carl.refused(protocol::Ack{over.match});
  EXPECT_EQ(refused.error.field, "/params/match");
  restart();
  EXPECT_EQ(come_back(token)->kept<protocol::MatchOver>(), 1U);
}

TEST_F(Ends, OfATournamentAreToldAgainUntilTheyAreAcknowledged) {
  std::string token;
  {
    server_->server().post([](net::MatchHost& host) {
      host.open_tournament({.id = "cup", .title = "The cup", .settings = ""});
    });
    WireClient anna{port()};
    token = anna.join("anna");
    const auto list =
        anna.call<protocol::TournamentListReply>(protocol::TournamentList{}).tournaments;
    ASSERT_EQ(list.size(), 1U);
    static_cast<void>(
        anna.call<protocol::TournamentReply>(protocol::TournamentJoin{list[0].tournament}));
    EXPECT_EQ(anna.refused(protocol::Ack{list[0].tournament}).error.field, "/params/tournament");
  }
  server_->server().post([](net::MatchHost& host) {
    host.announce_end("cup", {{1, "anna", 2.5, 4, 2, 1, 1}});
    host.set_status("cup", net::TournamentStatus::finished);
  });
  restart();
  {
    const auto anna = come_back(token);
    const auto over = anna->wait_for<protocol::TournamentOver>();
    EXPECT_EQ(over.name, "cup");
    ASSERT_EQ(over.standings.size(), 1U);
    EXPECT_EQ(over.standings[0].points, 2.5);
  }
  const auto anna = come_back(token);
  const auto over = anna->wait_for<protocol::TournamentOver>();
  static_cast<void>(anna->call<protocol::AckReply>(protocol::Ack{over.tournament}));
  restart();
  EXPECT_EQ(come_back(token)->kept<protocol::TournamentOver>(), 0U);
}

// `poolhall tournament run` stops its server as soon as the tournament is over.
TEST_F(Ends, OfATournamentAreToldBeforeTheServerStops) {
  server_->server().post([](net::MatchHost& host) {
    host.open_tournament({.id = "cup", .title = "The cup", .settings = ""});
  });
  WireClient anna{port()};
  anna.join("anna");
  const auto list =
      anna.call<protocol::TournamentListReply>(protocol::TournamentList{}).tournaments;
  ASSERT_EQ(list.size(), 1U);
  static_cast<void>(
      anna.call<protocol::TournamentReply>(protocol::TournamentJoin{list[0].tournament}));
  server_->server().post([](net::MatchHost& host) {
    host.set_status("cup", net::TournamentStatus::finished);
    host.announce_end("cup", {{1, "anna", 2.5, 4, 2, 1, 1}});
  });
  server_->stop();
  EXPECT_EQ(anna.wait_for<protocol::TournamentOver>().name, "cup");
  static_cast<void>(anna.wait_for<protocol::ShuttingDown>());
}

TEST_F(Ends, OfManyGamesAreToldAsFarAsTheLimitGoes) {
  server_.reset();
  net::ServerOptions options = test_options(directory_ / "test.db");
  options.settings.limits.untold_ends = 2;
  server_ = std::make_unique<TestServer>(options);
  WireClient bert{port()};
  bert.join("bert");
  std::string token;
  std::vector<protocol::GameId> games;
  {
    WireClient anna{port()};
    token = anna.join("anna");
    for (int i = 0; i < 4; ++i) {
      games.push_back(start_game(anna, bert, "bert"));
      static_cast<void>(bert.call<protocol::GameReply>(protocol::Concede{games.back()}));
      static_cast<void>(bert.wait_for<protocol::MatchOver>());
    }
  }
  {
    const auto anna = come_back(token);
    EXPECT_EQ(anna->wait_for<protocol::GameOver>().game, games[2]);
    EXPECT_EQ(anna->wait_for<protocol::GameOver>().game, games[3]);
    for (const protocol::GameId game : {games[2], games[3]}) {
      static_cast<void>(anna->call<protocol::AckReply>(protocol::Ack{game}));
    }
  }
  // Those before them come once there is room.
  const auto anna = come_back(token);
  EXPECT_EQ(anna->wait_for<protocol::GameOver>().game, games[0]);
  EXPECT_EQ(anna->wait_for<protocol::GameOver>().game, games[1]);
}

TEST_F(Ends, OfALongMatchAreToldInLinesThatTheServerMaySend) {
  protocol::MatchOver over;
  over.match = protocol::MatchId{3};
  over.seeds.resize(4'500);
  for (std::size_t i = 0; i < over.seeds.size(); ++i) {
    over.seeds[i].game = protocol::GameId{static_cast<std::int64_t>(i) + 1};
    over.seeds[i].key = {std::string(64, 'a')};
    over.seeds[i].rack_seed = (std::uint64_t{1} << 53) - 1;
  }
  std::size_t told = 0;
  for (const protocol::MatchOver& part : net::in_parts(over)) {
    EXPECT_LT(protocol::encode_notification(part, 1).size(), protocol::Limits{}.server_line_bytes);
    EXPECT_EQ(part.match, over.match);
    told += part.seeds.size();
  }
  EXPECT_EQ(told, over.seeds.size());
  EXPECT_EQ(net::in_parts({}).size(), 1U);
}

class RepeatedChallenge : public Ends {
 protected:
  RepeatedChallenge() {
    challenge_.opponent = "bert";
    challenge_.noise = "none";
    challenge_.clock = protocol::ClockSettings{.game_ms = 60'000};
    challenge_.challenge_id = protocol::ShotId{"\"again\""};
  }

  protocol::Challenge challenge_;
};

TEST_F(RepeatedChallenge, IsAnsweredAgainWhenTheServerWasStoppedAndItsMatchIsOver) {
  std::string token;
  protocol::ChallengeId id{};
  protocol::MatchId match{};
  {
    WireClient anna{port()};
    WireClient bert{port()};
    token = anna.join("anna");
    bert.join("bert");
    id = anna.call<protocol::ChallengeReply>(challenge_).challenge;
    const auto offer = bert.wait_for<protocol::ChallengeOffer>();
    match = *bert.call<protocol::ChallengeReply>(protocol::ChallengeAccept{offer.challenge}).match;
    const auto start = anna.wait_for<protocol::GameStart<Received>>();
    restart();
    const auto again = come_back(token)->call<protocol::ChallengeReply>(challenge_);
    EXPECT_EQ(again.status, protocol::ChallengeStatus::accepted);
    EXPECT_EQ(again.challenge, id);
    EXPECT_EQ(again.match, match);
    const auto anna_again = come_back(token);
    static_cast<void>(anna_again->call<protocol::GameReply>(protocol::Concede{start.terms.game}));
    static_cast<void>(anna_again->wait_for<protocol::MatchOver>());
  }
  restart();
  const auto anna = come_back(token);
  const auto again = anna->call<protocol::ChallengeReply>(challenge_);
  EXPECT_EQ(again.challenge, id);
  EXPECT_EQ(again.match, match);
  challenge_.clock->game_ms += 1;
  EXPECT_EQ(anna->refused(challenge_).code, "conflicting_request");
}

TEST_F(RepeatedChallenge, OfTheHouseIsAnsweredAgainAndNotForAnotherOpponent) {
  challenge_.opponent = "house:random";
  std::string token;
  protocol::ChallengeReply first;
  {
    WireClient anna{port()};
    token = anna.join("anna");
    first = anna.call<protocol::ChallengeReply>(challenge_);
  }
  restart();
  const auto anna = come_back(token);
  const auto again = anna->call<protocol::ChallengeReply>(challenge_);
  EXPECT_EQ(again.match, first.match);
  challenge_.opponent = "house:greedy";
  EXPECT_EQ(anna->refused(challenge_).code, "conflicting_request");
}

TEST_F(RepeatedChallenge, SentTwiceInOneBreathMakesOneMatch) {
  challenge_.opponent = "house:random";
  WireClient anna{port()};
  anna.join("anna");
  const auto first = anna.send(challenge_);
  const auto second = anna.send(challenge_);
  std::map<std::string, protocol::ChallengeReply> replies;  // in any order
  while (replies.size() < 2) {
    const auto message = anna.next_message();
    ASSERT_TRUE(message);
    if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
      FAIL() << error->code << " " << error->error.reason;
    }
    if (const auto* reply = std::get_if<protocol::ReplyMessage>(&*message)) {
      replies[reply->id.json] = std::get<protocol::ChallengeReply>(reply->reply);
    }
  }
  const auto match_in = [&](std::int64_t id) { return replies.at(std::to_string(id)).match; };
  EXPECT_EQ(match_in(first), match_in(second));
}

}  // namespace
}  // namespace poolhall::net_tests
