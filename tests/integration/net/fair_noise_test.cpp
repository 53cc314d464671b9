// The agents' parts in the noise: committed before the server's commitment, revealed after it, over
// new connections, restarts and kills; and what of it nobody may see before the match is over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripted_play.hpp"
#include "server/match/chain.hpp"
#include "server/match/fair_noise.hpp"
#include "server/match/sha256.hpp"
#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "server_process.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::GameId;
using protocol::GameReady;
using protocol::GameReply;
using protocol::GameReveal;
using protocol::Hex256;
using protocol::Received;
using rules::Seat;

Hex256 secret_of(char digit) {
  return {std::string(64, digit)};
}

Hex256 commitment_to(const Hex256& secret) {
  return {match::to_hex(match::sha256(match::digest_of(secret.text)))};
}

void commit(WireClient& client, const Hex256& secret) {
  static_cast<void>(client.call<protocol::EmptyReply>(GameReady{commitment_to(secret)}));
}

protocol::GameTerms<Received> terms_at_start(WireClient& client) {
  return client.wait_for<protocol::GameStart<Received>>().terms;
}

void challenge(WireClient& anna, WireClient& bert) {
  protocol::Challenge challenge;
  challenge.opponent = "bert";
  static_cast<void>(anna.call<protocol::ChallengeReply>(challenge));
  const auto offer = bert.wait_for<protocol::ChallengeOffer>();
  static_cast<void>(
      bert.call<protocol::ChallengeReply>(protocol::ChallengeAccept{offer.challenge}));
}

storage::GameRecord record_of(const std::filesystem::path& file, GameId game) {
  auto reader = storage::open_sqlite_reader(file).value();
  return reader->game(game).value().value();
}

class FairNoise : public ::testing::Test {
 protected:
  FairNoise() {
    anna_token_ = anna_->join("anna");
    bert_->join("bert");
  }

  static net::ServerOptions options(const std::filesystem::path& file) {
    net::ServerOptions options = test_options(file);
    options.settings.limits.takeover_interval = std::chrono::milliseconds{0};
    options.settings.limits.reveal_deadline = std::chrono::milliseconds{200};
    return options;
  }

  // Plays the first turn and concedes; the database afterwards agrees with itself.
  void play_out(GameId game) {
    const Turn turn = anna_->wait_for<Turn>();
    static_cast<void>(anna_->call<protocol::ShotReply<Received>>(scripted_shot(turn)));
    static_cast<void>(anna_->call<GameReply>(protocol::Concede{game}));
    over_ = anna_->wait_for<protocol::MatchOver>();
    server_.stop();
    auto reader = storage::open_sqlite_reader(file_).value();
    const auto report = match::verify(*reader, {}).value();
    EXPECT_TRUE(report.same()) << (report.differences.empty() ? "" : report.differences[0].reason);
    EXPECT_EQ(report.shots, 1U);
  }

  test_support::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.db";
  TestServer server_{options(file_)};
  std::optional<WireClient> anna_{server_.port()};
  std::optional<WireClient> bert_{server_.port()};
  std::string anna_token_;
  protocol::MatchOver over_;
};

TEST_F(FairNoise, IsMadeOfTheServersKeyAndOfWhatBothAgentsReveal) {
  commit(*anna_, secret_of('a'));
  commit(*bert_, secret_of('b'));
  challenge(*anna_, *bert_);
  const auto terms = terms_at_start(*anna_);
  EXPECT_EQ(terms.agent_commitments[0], commitment_to(secret_of('a')));
  EXPECT_EQ(terms.agent_commitments[1], commitment_to(secret_of('b')));
  static_cast<void>(anna_->call<GameReply>(GameReveal{terms.game, secret_of('a')}));
  static_cast<void>(bert_->call<GameReply>(GameReveal{terms.game, secret_of('b')}));
  play_out(terms.game);

  ASSERT_EQ(over_.seeds.size(), 1U);
  EXPECT_EQ(over_.seeds[0].agent_secrets[0], secret_of('a'));
  EXPECT_EQ(over_.seeds[0].agent_secrets[1], secret_of('b'));
  const storage::GameRecord record = record_of(file_, terms.game);
  const auto turn = storage::open_sqlite_reader(file_).value()->turn(terms.game, 1).value().value();
  const auto key = match::mixed_key(
      match::digest_of(over_.seeds[0].key.text),
      {match::digest_of(secret_of('a').text), match::digest_of(secret_of('b').text)});
  const auto deviates = match::shot_deviates(key, {terms.game, Seat::first, 1});
  EXPECT_NEAR(turn.shot->executed.phi, turn.shot->intended.phi + record.noise.phi * deviates[3],
              1e-9);
}

TEST_F(FairNoise, DoesNotWaitForAgentsThatCommitToNothing) {
  challenge(*anna_, *bert_);
  const auto terms = terms_at_start(*anna_);
  EXPECT_EQ(terms.agent_commitments[0], std::nullopt);
  const auto error = anna_->refused(GameReveal{terms.game, secret_of('a')});
  EXPECT_EQ(error.code, "invalid_params");
  EXPECT_EQ(error.error.field, "/params/game");
  play_out(terms.game);
  EXPECT_EQ(over_.seeds[0].agent_secrets[0], std::nullopt);
}

TEST_F(FairNoise, GoesWithoutThePartOfWhoDoesNotRevealInTime) {
  commit(*anna_, secret_of('a'));
  commit(*bert_, secret_of('b'));
  challenge(*anna_, *bert_);
  const auto terms = terms_at_start(*anna_);
  static_cast<void>(bert_->call<GameReply>(GameReveal{terms.game, secret_of('b')}));
  const Turn turn = anna_->wait_for<Turn>();  // after the deadline
  EXPECT_EQ(anna_->refused(GameReveal{terms.game, secret_of('a')}).code, "stale_turn");
  static_cast<void>(anna_->call<protocol::ShotReply<Received>>(scripted_shot(turn)));
  // The same again is answered again.
  static_cast<void>(bert_->call<GameReply>(GameReveal{terms.game, secret_of('b')}));
  static_cast<void>(anna_->call<GameReply>(protocol::Concede{terms.game}));
  over_ = anna_->wait_for<protocol::MatchOver>();
  EXPECT_EQ(over_.seeds[0].agent_secrets[0], std::nullopt);
  EXPECT_EQ(over_.seeds[0].agent_secrets[1], secret_of('b'));
  EXPECT_EQ(anna_->refused(GameReveal{terms.game, secret_of('a')}).code, "game_over");
}

TEST_F(FairNoise, RefusesBytesThatWereNotCommittedTo) {
  commit(*anna_, secret_of('a'));
  challenge(*anna_, *bert_);
  const auto terms = terms_at_start(*anna_);
  const auto error = anna_->refused(GameReveal{terms.game, secret_of('c')});
  EXPECT_EQ(error.code, "invalid_params");
  EXPECT_EQ(error.error.field, "/params/secret");
  play_out(terms.game);
  EXPECT_EQ(over_.seeds[0].agent_secrets[0], std::nullopt);
}

TEST_F(FairNoise, CannotBePlayedOutOfAPartByAQuickShot) {
  commit(*bert_, secret_of('b'));
  challenge(*anna_, *bert_);
  const auto start = anna_->wait_for<protocol::GameStart<Received>>();
  Turn turn;
  turn.game = start.terms.game;
  turn.turn = 1;
  turn.kind = rules::TurnKind::break_shot;
  turn.state = start.state;
  const auto shot = anna_->send(scripted_shot(turn));  // before the turn was given
  static_cast<void>(bert_->call<GameReply>(GameReveal{start.terms.game, secret_of('b')}));
  EXPECT_TRUE(std::holds_alternative<protocol::ReplyMessage>(anna_->answer_to(shot)));
  static_cast<void>(anna_->call<GameReply>(protocol::Concede{start.terms.game}));
  EXPECT_EQ(anna_->wait_for<protocol::MatchOver>().seeds[0].agent_secrets[1], secret_of('b'));
}

TEST_F(FairNoise, TakesOneCommitmentForEachGameInTheirOrder) {
  commit(*anna_, secret_of('a'));
  commit(*anna_, secret_of('b'));
  commit(*anna_, secret_of('a'));  // again: still one
  for (const char digit : {'a', 'b'}) {
    challenge(*anna_, *bert_);
    const auto terms = terms_at_start(*anna_);
    EXPECT_EQ(terms.agent_commitments[0], commitment_to(secret_of(digit)));
    static_cast<void>(anna_->call<GameReply>(protocol::Concede{terms.game}));
  }
  challenge(*anna_, *bert_);
  EXPECT_EQ(terms_at_start(*anna_).agent_commitments[0], std::nullopt);
}

TEST_F(FairNoise, IsRevealedOverAnotherConnection) {
  commit(*anna_, secret_of('a'));
  commit(*anna_, secret_of('b'));
  challenge(*anna_, *bert_);
  const auto terms = terms_at_start(*anna_);
  anna_.emplace(server_.port());
  anna_->login(anna_token_);
  const auto snapshot = anna_->wait_for<protocol::GameSnapshot<Received>>();
  EXPECT_EQ(snapshot.terms.agent_commitments[0], commitment_to(secret_of('a')));
  static_cast<void>(anna_->call<GameReply>(GameReveal{terms.game, secret_of('a')}));
  // What it commits itself to now takes the place of what it may have forgotten.
  commit(*anna_, secret_of('c'));
  play_out(terms.game);
  EXPECT_EQ(over_.seeds[0].agent_secrets[0], secret_of('a'));
}

// A kill before the reveal is stored, and one after it: the first is to be sent again, the second
// counts.
TEST(FairNoiseAfterAKill, HasEveryPartThatWasAnswered) {
  test_support::TemporaryDirectory directory;
  auto server = std::make_unique<ServerProcess>(directory.path());
  std::string anna_token;
  std::string bert_token;
  GameId game{};
  std::string commitment;
  {
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    anna_token = anna.join("anna");
    bert_token = bert.join("bert");
    commit(anna, secret_of('a'));
    commit(bert, secret_of('b'));
    challenge(anna, bert);
    const auto terms = terms_at_start(anna);
    game = terms.game;
    commitment = terms.commitment.text;
    static_cast<void>(anna.call<GameReply>(GameReveal{game, secret_of('a')}));
  }
  server->kill();
  server = std::make_unique<ServerProcess>(directory.path());
  {
    WireClient anna{server->port()};
    WireClient bert{server->port()};
    anna.login(anna_token);
    bert.login(bert_token);
    const auto terms = bert.wait_for<protocol::GameSnapshot<Received>>().terms;
    EXPECT_EQ(terms.commitment.text, commitment);
    EXPECT_EQ(terms.agent_commitments[1], commitment_to(secret_of('b')));
    static_cast<void>(bert.call<GameReply>(GameReveal{game, secret_of('b')}));
    static_cast<void>(
        anna.call<protocol::ShotReply<Received>>(scripted_shot(anna.wait_for<Turn>())));
  }
  server->kill();
  server = std::make_unique<ServerProcess>(directory.path());
  WireClient anna{server->port()};
  anna.login(anna_token);
  static_cast<void>(anna.call<GameReply>(protocol::Concede{game}));
  const auto over = anna.wait_for<protocol::MatchOver>();
  EXPECT_EQ(over.seeds[0].agent_secrets[0], secret_of('a'));
  EXPECT_EQ(over.seeds[0].agent_secrets[1], secret_of('b'));
  EXPECT_EQ(server->terminate(), 0);
  auto reader = storage::open_sqlite_reader(directory / "server.db").value();
  EXPECT_TRUE(match::verify(*reader, {}).value().same());
}

}  // namespace
}  // namespace poolhall::net_tests
