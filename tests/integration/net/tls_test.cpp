// Agents by TLS: the same protocol and the same limits behind a handshake.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <csignal>
#include <fstream>
#include <string>

#include "certificate.hpp"
#include "clients/cpp/client.hpp"
#include "http_client.hpp"
#include "scripted_play.hpp"
#include "server/net/tls.hpp"
#include "server/web/http_call.hpp"
#include "test_server.hpp"
#include "tests/support/run_command.hpp"
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
  options_.settings.limits.input_bytes_per_second = 1 << 30;
  options_.settings.limits.messages_per_second = 1e6;
  options_.settings.limits.message_burst = 1e6;
  WireClient lazy{port(), certificate_.file};
  lazy.join("lazy");
  const std::string ping = R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{"t":")" +
                           std::string(3'000, 'x') + "\"}}\n";
  std::string many;
  for (int i = 0; i < 50; ++i) {
    many += ping;
  }
  for (int i = 0; i < 50; ++i) {
    lazy.send_bytes(many);
  }
  const std::string all = lazy.read_all();
  EXPECT_NE(all.find("unread_output"), std::string::npos);
}

TEST_F(Tls, ReadsWhatHasArrivedBeforeAFlagFalls) {
  WireClient anna{port(), certificate_.file};
  WireClient bert{port(), certificate_.file};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert", {.game_ms = 1'500}));
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

// The page by HTTPS, beside the plain one.
class Https : public Tls {
 protected:
  Https() {
    options_.settings.http = "127.0.0.1:0";
    options_.settings.tls.http = "127.0.0.1:0";
  }
  [[nodiscard]] std::uint16_t https() { return server().server().https_endpoint()->port; }
  [[nodiscard]] HttpAnswer ask(HttpCall call) {
    call.ca_file = certificate_.file;
    return http_call(https(), call);
  }
};

TEST_F(Https, AnswersWhatThePlainPortAnswers) {
  const HttpAnswer plain =
      http_call(server().server().http_endpoint()->port, {"GET", "/api/presets"});
  EXPECT_EQ(ask({"GET", "/api/presets"}).body, plain.body);
  EXPECT_EQ(ask({"GET", "/"}).status, 200);
  EXPECT_EQ(ask({"GET", "/metrics"}).status, 200);
}

TEST_F(Https, HasTheNamesThatItsCertificateIsFor) {
  EXPECT_EQ(ask({.path = "/healthz", .host = "localhost:8443"}).status, 200);
  EXPECT_EQ(ask({.path = "/healthz", .host = "127.0.0.1"}).status, 200);
  const auto answer = ask({.path = "/healthz", .host = "evil.example"});
  EXPECT_EQ(answer.status, 421) << answer.body;
  EXPECT_EQ(ask({.path = "/healthz", .headers = {"Origin: https://evil.example"}}).status, 403);
  EXPECT_EQ(ask({.path = "/healthz", .headers = {"Origin: https://127.0.0.1"}}).status, 200);
}

TEST_F(Https, CarriesStreams) {
  WireClient spectator{https(), certificate_.file};
  spectator.send_bytes(
      "GET /ws/lobby HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  const auto first = spectator.read_line();
  ASSERT_TRUE(first);
  EXPECT_NE(first->find("101"), std::string::npos) << *first;
  while (const auto line = spectator.read_line()) {
    if (line->size() <= 1) {
      break;  // the end of the head
    }
  }
  // A lobby's snapshot is a frame of text; it holds no line's end, so bytes are looked at.
  while (spectator.rest().find("\"type\":\"lobby\"") == std::string::npos) {
    ASSERT_TRUE(spectator.receive());
  }
}

// As the commands call it that ask a running server.
TEST_F(Https, IsBelievedOnlyWithItsCertificateAndName) {
  const auto call = [this](const std::string& host, const std::string& ca_file) {
    return web::http_call({.server = "https://" + host + ":" + std::to_string(https()),
                           .ca_file = ca_file,
                           .target = "/healthz"});
  };
  const Certificate other = make_certificate(directory_.path(), "other");
  for (const char* host : {"127.0.0.1", "localhost"}) {
    const auto reply = call(host, certificate_.file);
    ASSERT_TRUE(reply) << reply.error();
    EXPECT_EQ(reply->status, 200);
  }
  EXPECT_FALSE(call("127.0.0.1", ""));
  EXPECT_FALSE(call("127.0.0.1", other.file));
  EXPECT_FALSE(call("127.1", certificate_.file)) << "the same machine by a name of no certificate";
  const auto no_file = call("127.0.0.1", "no-such.pem");
  ASSERT_FALSE(no_file);
  EXPECT_NE(no_file.error().find("no-such.pem"), std::string::npos) << no_file.error();
}

TEST_F(Https, AnswersTheProgramsCommands) {
  const std::string command =
      std::string(POOLHALL_PROGRAM) +
      " tournament list --server https://127.0.0.1:" + std::to_string(https());
  const test_support::Ran listed =
      test_support::run_command(command + " --tls-ca " + certificate_.file);
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_EQ(listed.out, "No tournaments.\n");
  const test_support::Ran refused = test_support::run_command(command);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("https://127.0.0.1"), std::string::npos) << refused.err;
}

TEST(HttpCall, GivesUpOnAServerThatDoesNotAnswer) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::acceptor silent(io, {boost::asio::ip::make_address("127.0.0.1"), 0});
  const auto reply =
      web::http_call({.server = "127.0.0.1:" + std::to_string(silent.local_endpoint().port()),
                      .target = "/healthz",
                      .patience = milliseconds{30}});
  EXPECT_FALSE(reply);
}

TEST(HttpCall, NamesTheAddressThatIsNone) {
  for (const char* wrong : {"", "example", "https://", "https://example/x", "127.0.0.1"}) {
    const auto reply = web::http_call({.server = wrong, .target = "/healthz"});
    ASSERT_FALSE(reply) << wrong;
    EXPECT_NE(reply.error().find("expected HOST:PORT"), std::string::npos) << reply.error();
  }
}

TEST_F(Https, EndsAConnectionThatSpeaksPlainText) {
  WireClient plain{https()};
  plain.send_bytes("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_EQ(plain.read_all().find("HTTP/1.1 200"), std::string::npos);
  EXPECT_EQ(ask({"GET", "/healthz"}).status, 200);
}

TEST(HttpsSettings, WantACertificate) {
  test_support::TemporaryDirectory directory;
  auto options = test_options(directory / "test.db");
  options.settings.tls.http = "127.0.0.1:0";
  net::Server server(options);
  const auto started = server.start();
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().find("tls.certificate"), std::string::npos) << started.error();
}

TEST(ExposedPorts, AreThoseThatOthersReachWithoutEncryption) {
  settings::ServerSettings settings;
  EXPECT_FALSE(net::exposed(settings));
  settings.http = "0.0.0.0:8080";
  EXPECT_NE(net::exposed(settings)->find("0.0.0.0:8080"), std::string::npos);
  settings.http = "127.0.0.1:8080";
  settings.tls.listen = "0.0.0.0:7778";
  settings.tls.http = "0.0.0.0:8443";
  EXPECT_FALSE(net::exposed(settings));
  settings.listen = "[::]:7777";
  EXPECT_TRUE(net::exposed(settings));
  settings.plain_beyond_loopback = true;
  EXPECT_FALSE(net::exposed(settings));
}

}  // namespace
}  // namespace poolhall::net_tests
