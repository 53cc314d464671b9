// Agents by TLS: the same protocol and the same limits behind a handshake.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "certificate.hpp"
#include "clients/cpp/client.hpp"
#include "scripted_play.hpp"
#include "server/net/tls.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;

class Tls : public ::testing::Test {
 protected:
  Tls() {
    options_.settings.tls = {"127.0.0.1:0", certificate_.file, certificate_.key};
    // Of the test's own client; the server raises none.
    std::signal(SIGPIPE, SIG_IGN);
  }
  TestServer& server() {
    if (!server_) {
      server_ = std::make_unique<TestServer>(options_);
    }
    return *server_;
  }
  [[nodiscard]] std::uint16_t port() { return server().server().tls_endpoint()->port; }

  test_support::TemporaryDirectory directory_;
  Certificate certificate_ = make_certificate(directory_.path());
  net::ServerOptions options_ = test_options(directory_ / "test.db");
  std::unique_ptr<TestServer> server_;
};

TEST_F(Tls, CarriesAGameBetweenOneWhoUsesItAndOneWhoDoesNot) {
  WireClient anna{port(), certificate_.file};
  WireClient bert{server().port()};
  anna.join("anna");
  bert.join("bert");
  const protocol::GameId game = start_game(anna, bert, "bert");
  const rules::GameState after = play_turns({anna, bert}, rules::Seat::first, 6);
  if (!after.result) {
    static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  }
  EXPECT_EQ(anna.wait_for<protocol::MatchOver>().match, bert.wait_for<protocol::MatchOver>().match);
}

TEST_F(Tls, CarriesManyLinesInOneRecordAndOneLineInMany) {
  WireClient anna{port(), certificate_.file};
  anna.join("anna");
  std::string many;
  for (int i = 0; i < 30; ++i) {
    many += R"({"jsonrpc":"2.0","id":"p","method":"ping","params":{"t":")" + std::string(400, 'x') +
            "\"}}\n";
  }
  anna.send_bytes(many);
  for (const char byte : protocol::encode_request(99, protocol::Ping{})) {
    anna.send_bytes({&byte, 1});
  }
  int replies = 0;
  while (replies < 31) {
    const auto line = anna.read_line();
    ASSERT_TRUE(line);
    replies += line->find("\"time_ms\"") != std::string::npos ? 1 : 0;
  }
}

TEST_F(Tls, IsSpokenByTheClientLibrary) {
  client::ClientOptions options;
  options.port = std::to_string(port());
  options.tls = client::TlsOptions{certificate_.file};
  options.agent.name = "cpp";
  options.agent.games = 1;
  options.agent.challenges = {
      {.opponent = "house:random", .clock = protocol::ClockSettings{.game_ms = 60'000}}};
  const client::End end = client::play(
      options, [](const client::TurnView&) -> client::Move { return client::Concede{}; });
  EXPECT_EQ(end.ending, client::Ending::finished) << end.reason;
}

TEST_F(Tls, IsNotSpokenWithAServerWhoseCertificateIsNotBelieved) {
  const Certificate other = make_certificate(directory_.path(), "other");
  EXPECT_THROW(WireClient(port(), other.file), std::runtime_error);
  std::string said;
  client::ClientOptions options;
  options.port = std::to_string(port());
  options.tls = client::TlsOptions{other.file};
  options.agent.name = "cpp";
  std::unique_ptr<client::Client> bot;
  options.agent.log = [&](std::string_view line) {
    said = line;
    bot->stop();
  };
  bot = std::make_unique<client::Client>(
      options, client::player_from([](const client::TurnView&) { return client::Concede{}; }));
  EXPECT_EQ(bot->run().ending, client::Ending::stopped);
  EXPECT_NE(said.find("certificate"), std::string::npos) << said;
}

TEST_F(Tls, HasADeadlineForTheHandshake) {
  options_.settings.limits.login_deadline = milliseconds{100};
  WireClient silent{port()};
  EXPECT_FALSE(silent.read_line());
  WireClient half{port()};
  half.send_bytes("\x16\x03\x01");
  EXPECT_FALSE(half.read_line());
}

TEST_F(Tls, EndsAConnectionThatSpeaksPlainText) {
  WireClient plain{port()};
  plain.send_bytes(protocol::encode_request(1, protocol::Hello{1, 1, "plain", {}, {}}));
  static_cast<void>(plain.read_all());  // perhaps an alert, then the end
  WireClient anna{port(), certificate_.file};
  anna.join("anna");
}

TEST_F(Tls, CountsItsConnectionsWithThePlainOnesAndSaysThatThereAreTooMany) {
  options_.settings.limits.connections_per_address = 2;
  WireClient first{server().port()};
  WireClient second{port(), certificate_.file};
  first.hello();
  second.hello();
  WireClient third{port(), certificate_.file};
  const auto message = third.next_message();
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<protocol::ErrorMessage>(*message).code, "server_full");
  EXPECT_FALSE(third.read_line());
  WireClient fourth{server().port()};
  EXPECT_EQ(std::get<protocol::ErrorMessage>(*fourth.next_message()).code, "server_full");
}

TEST_F(Tls, SendsAwayWhoDoesNotRead) {
  options_.settings.limits.output_queue_bytes = 64 * 1024;
  options_.settings.limits.messages_per_second = 1e6;
  options_.settings.limits.message_burst = 1e6;
  WireClient lazy{port(), certificate_.file};
  lazy.join("lazy");
  const std::string ping = R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{"t":")" +
                           std::string(3'000, 'x') + "\"}}\n";
  for (int i = 0; i < 5'000; ++i) {
    lazy.send_bytes(ping);
  }
  const std::string all = lazy.read_all();
  EXPECT_NE(all.find("unread_output"), std::string::npos);
}

TEST_F(Tls, ReadsWhatHasArrivedBeforeAFlagFalls) {
  WireClient anna{port(), certificate_.file};
  WireClient bert{port(), certificate_.file};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert", {.game_ms = 150}));
  const Turn turn = anna.wait_for<Turn>();
  static_cast<void>(anna.call<protocol::ShotReply<Received>>(scripted_shot(turn)));
  EXPECT_EQ(bert.wait_for<protocol::GameOver>().reason, rules::EndReason::timeout);
}

TEST(TlsSettings, AreRefusedWithTheFileThatIsWrong) {
  test_support::TemporaryDirectory directory;
  const Certificate good = make_certificate(directory.path(), "good");
  const Certificate other = make_certificate(directory.path(), "other");
  const auto reason = [](const settings::TlsSettings& tls) {
    const auto context = net::load_tls(tls);
    return context ? std::string{} : context.error();
  };
  EXPECT_EQ(reason({"", good.file, good.key}), "");
  EXPECT_NE(reason({"", good.file, ""}).find("tls.key"), std::string::npos);
  EXPECT_NE(reason({"", "no-such.pem", good.key}).find("no-such.pem"), std::string::npos);
  EXPECT_NE(reason({"", good.file, other.key}).find("other.key"), std::string::npos);
}

TEST(ExposedPorts, AreThoseThatOthersReachWithoutEncryption) {
  settings::ServerSettings settings;
  EXPECT_FALSE(net::exposed(settings));
  settings.http = "0.0.0.0:8080";
  EXPECT_NE(net::exposed(settings)->find("0.0.0.0:8080"), std::string::npos);
  settings.http = "127.0.0.1:8080";
  settings.tls.listen = "0.0.0.0:7778";
  EXPECT_FALSE(net::exposed(settings));
  settings.listen = "[::]:7777";
  EXPECT_TRUE(net::exposed(settings));
  settings.plain_beyond_loopback = true;
  EXPECT_FALSE(net::exposed(settings));
}

}  // namespace
}  // namespace poolhall::net_tests
