// Who closes its sending half and reads on, as a script does that speaks through nc: every request
// that came whole is answered, then the connection ends; meanwhile its agent is away.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <csignal>

#include "certificate.hpp"
#include "scripted_play.hpp"
#include "server/match/chain.hpp"
#include "server/match/sha256.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using protocol::ReplyMessage;
using std::chrono::milliseconds;

constexpr milliseconds for_ever{600'000};  // longer than the test's patience

enum class Wire : std::uint8_t { plain, tls };

class Halves : public ::testing::Test {
 protected:
  Halves() {
    options_.settings.tls = {"127.0.0.1:0", certificate_.file, certificate_.key};
    // Of the test's own client; the server raises none.
    std::signal(SIGPIPE, SIG_IGN);
  }
  protocol::Limits& limits() { return options_.settings.limits; }
  net::Server& server() {
    if (!server_) {
      server_ = std::make_unique<TestServer>(options_);
    }
    return server_->server();
  }
  [[nodiscard]] std::unique_ptr<WireClient> connect(Wire wire) {
    if (wire == Wire::plain) {
      return std::make_unique<WireClient>(server().agents_endpoint().port);
    }
    return std::make_unique<WireClient>(server().tls_endpoint()->port, certificate_.file);
  }

  // Anna's first shot comes before her part in the noise, so that its answer waits.
  void shoot_too_early(Wire wire) {
    limits().reveal_deadline = for_ever;
    limits().takeover_interval = for_ever;
    anna_ = connect(wire);
    bert_ = connect(wire);
    token_ = anna_->join("anna");
    bert_->join("bert");
    const auto commitment = match::sha256(match::digest_of(secret_.text));
    static_cast<void>(anna_->call<protocol::EmptyReply>(
        protocol::GameReady{protocol::Hex256{match::to_hex(commitment)}}));
    game_ = start_game(*anna_, *bert_, "bert");
    Turn turn;
    turn.game = game_;
    turn.turn = 1;
    turn.kind = rules::TurnKind::break_shot;
    shot_ = anna_->send(scripted_shot(turn));
    static_cast<void>(anna_->call<protocol::PingReply>(protocol::Ping{}));
  }
  // Takes nothing over, so it need not wait once the server knows of the end.
  [[nodiscard]] std::unique_ptr<WireClient> anna_again(Wire wire) {
    auto again = connect(wire);
    again->hello();
    const protocol::Request login = protocol::Login{{token_}};
    while (!std::holds_alternative<ReplyMessage>(again->answer_to(again->send(login)))) {
    }
    return again;
  }
  // The shot is played.
  void reveal(WireClient& again) const {
    static_cast<void>(again.call<protocol::GameReply>(protocol::GameReveal{game_, secret_}));
    EXPECT_EQ(again.wait_for<protocol::GameShot<Received>>().turn, 1U);
  }

  test_support::TemporaryDirectory directory_;
  Certificate certificate_ = make_certificate(directory_.path());
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::unique_ptr<TestServer> server_;
  std::unique_ptr<WireClient> anna_;
  std::unique_ptr<WireClient> bert_;
  std::string token_;
  protocol::Hex256 secret_{std::string(64, 'a')};
  protocol::GameId game_{};
  std::int64_t shot_ = 0;
};

class HalfClose : public Halves, public ::testing::WithParamInterface<Wire> {};

TEST_P(HalfClose, GetsTheAnswerThatIsUnderWayAndThenTheEnd) {
  anna_ = connect(GetParam());
  bert_ = connect(GetParam());
  anna_->join("anna");
  bert_->join("bert");
  static_cast<void>(start_game(*anna_, *bert_, "bert"));
  const std::int64_t shot = anna_->send(scripted_shot(anna_->wait_for<Turn>()));
  anna_->end_input();
  EXPECT_TRUE(std::holds_alternative<ReplyMessage>(anna_->answer_to(shot)));
  static_cast<void>(anna_->read_all());
  EXPECT_EQ(bert_->wait_for<protocol::GameShot<Received>>().turn, 1U);
}

TEST_P(HalfClose, AnswersAllWholeLinesOfAScript) {
  anna_ = connect(GetParam());
  anna_->send_bytes(protocol::encode_request(1, protocol::Hello{1, 1, "script", {}, {}}) +
                    protocol::encode_request(2, protocol::Register{"anna", {}}) +
                    protocol::encode_request(3, protocol::TournamentList{}) +
                    protocol::encode_request(4, protocol::Sync{protocol::GameId{7}}) +
                    R"({"jsonrpc":"2.0","id":5,"method":"ping"})");
  anna_->end_input();
  const std::string heard = anna_->read_all();
  for (const char* answer :
       {R"("id":1,"result")", R"("id":2,"result")", R"("id":3,"result")", R"("id":4,"error")"}) {
    EXPECT_NE(heard.find(answer), std::string::npos) << answer << " is not in " << heard;
  }
  EXPECT_EQ(heard.find("\"id\":5"), std::string::npos) << heard;
}

TEST_P(HalfClose, IsAwayWhileItsAnswerIsUnderWay) {
  shoot_too_early(GetParam());
  anna_->end_input();
  reveal(*anna_again(GetParam()));
  EXPECT_TRUE(std::holds_alternative<ReplyMessage>(anna_->answer_to(shot_)));
  EXPECT_EQ(anna_->read_all(), "");
  EXPECT_EQ(anna_->kept<protocol::Superseded>(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Wires, HalfClose, ::testing::Values(Wire::plain, Wire::tls),
                         [](const auto& wire) {
                           return wire.param == Wire::tls ? "Tls" : "Plain";
                         });

TEST_F(Halves, InTlsAnEndWithoutAWordIsABrokenConnection) {
  shoot_too_early(Wire::tls);
  ::shutdown(anna_->descriptor(), SHUT_WR);
  reveal(*anna_again(Wire::tls));
  EXPECT_EQ(anna_->read_all().find("\"id\":" + std::to_string(shot_)), std::string::npos);
}

}  // namespace
}  // namespace poolhall::net_tests
