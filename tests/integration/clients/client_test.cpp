// The client over real sockets, against a server that is a script.
#include "clients/cpp/client.hpp"

#include <gtest/gtest.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>

#include <future>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>

#include "protocol/codec.hpp"
#include "tests/support/scripted_game.hpp"

namespace poolhall::client {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using protocol::GameId;
using protocol::Outgoing;

// The server's end of one connection. Every read blocks until the client says something.
class Peer {
 public:
  explicit Peer(tcp::socket socket) : socket_(std::move(socket)) {}

  protocol::Incoming read() {
    const std::size_t length = asio::read_until(socket_, asio::dynamic_buffer(input_), '\n');
    const auto incoming = protocol::decode_request(input_.substr(0, length - 1), {});
    input_.erase(0, length);
    last_ = incoming.value();
    return last_;
  }

  // The next request, which has to be a `Request`.
  template <class Request>
  Request expect() {
    return std::get<Request>(read().request);
  }

  void reply(const protocol::Reply<Outgoing>& reply) {
    write(protocol::encode_reply(*last_.id, reply));
  }
  void notify(const protocol::Notification<Outgoing>& notification) {
    write(protocol::encode_notification(notification, ++seq_));
  }

  void log_in() {
    expect<protocol::Hello>();
    reply(protocol::HelloReply{});
    read();  // register or login
    reply(protocol::LoginReply{"tester", {}, {}});
  }

  void close() { socket_.close(); }

 private:
  void write(const std::string& line) { asio::write(socket_, asio::buffer(line)); }

  tcp::socket socket_;
  std::string input_;
  protocol::Incoming last_;
  std::uint64_t seq_ = 0;
};

class ClientTest : public testing::Test {
 protected:
  ClientTest() : acceptor_(io_, {asio::ip::address_v4::loopback(), 0}) {
    options_.port = std::to_string(acceptor_.local_endpoint().port());
    options_.agent.name = "tester";
    options_.agent.noise = NoisePart::none;  // agent_test.cpp has the other way
    options_.first_backoff = std::chrono::milliseconds(1);
    options_.last_backoff = std::chrono::milliseconds(2);
  }

  void TearDown() override {
    if (client_) {
      client_->stop();
    }
  }

  void start(PlayerFactory factory) {
    client_.emplace(options_, std::move(factory));
    end_ = std::async(std::launch::async, [this] { return client_->run(); });
  }
  void start() {
    start(player_from(
        [](const TurnView&) -> Move { return Shot{.stroke = {.theta = 5, .phi = 90, .v = 3}}; }));
  }

  Peer accept() { return Peer(acceptor_.accept()); }

  asio::io_context io_;
  tcp::acceptor acceptor_;
  ClientOptions options_;
  std::optional<Client> client_;
  std::future<End> end_;
};

TEST_F(ClientTest, PlaysAGameToItsEnd) {
  options_.agent.games = 1;
  start();
  Peer peer = accept();
  peer.log_in();
  peer.notify(test_support::scripted_start(GameId{17}));
  peer.notify(test_support::scripted_turn(GameId{17}, 1));
  EXPECT_EQ(peer.expect<protocol::Shot>().turn, 1U);
  peer.notify(test_support::scripted_over(GameId{17}));
  EXPECT_EQ(peer.expect<protocol::Ack>().what, protocol::Ended{GameId{17}});
  peer.reply(protocol::AckReply{GameId{17}});
  EXPECT_EQ(end_.get().ending, Ending::finished);
}

TEST_F(ClientTest, ComesBackWithTheSameTokenAndSendsTheSameShotAgain) {
  start();
  Peer first = accept();
  first.expect<protocol::Hello>();
  first.reply(protocol::HelloReply{});
  const auto token = first.expect<protocol::Register>().token;
  first.reply(protocol::LoginReply{"tester", {}, {}});
  first.notify(test_support::scripted_start(GameId{17}));
  first.notify(test_support::scripted_turn(GameId{17}, 1));
  const auto shot = first.expect<protocol::Shot>();
  first.close();

  Peer second = accept();
  second.expect<protocol::Hello>();
  second.reply(protocol::HelloReply{});
  EXPECT_EQ(second.expect<protocol::Login>().token, token);
  second.reply(protocol::LoginReply{"tester", {}, {}});
  second.notify(test_support::scripted_turn(GameId{17}, 1));
  EXPECT_EQ(second.expect<protocol::Shot>(), shot);
}

TEST_F(ClientTest, DoesNotComeBackOnceSuperseded) {
  start();
  Peer peer = accept();
  peer.log_in();
  peer.notify(protocol::Superseded{});
  EXPECT_EQ(end_.get().ending, Ending::superseded);
}

TEST_F(ClientTest, AnswersTheServersProbesWhileItThinks) {
  std::promise<void> may_go_on;
  const std::shared_future<void> gate = may_go_on.get_future().share();
  start(player_from([gate](const TurnView&) -> Move {
    gate.wait();
    return Concede{};
  }));
  Peer peer = accept();
  peer.log_in();
  peer.notify(test_support::scripted_start(GameId{17}));
  peer.notify(test_support::scripted_turn(GameId{17}, 1));
  peer.notify(protocol::LagProbe{4711});
  EXPECT_EQ(peer.expect<protocol::Lag>().t, 4711);
  may_go_on.set_value();
  peer.expect<protocol::Concede>();
}

TEST_F(ClientTest, ThinksAboutSeveralGamesAtOnce) {
  options_.threads = 2;
  std::latch both{2};
  start(player_from([&both](const TurnView&) -> Move {
    both.arrive_and_wait();
    return Concede{};
  }));
  Peer peer = accept();
  peer.log_in();
  for (const GameId game : {GameId{17}, GameId{18}}) {
    peer.notify(test_support::scripted_start(game));
    peer.notify(test_support::scripted_turn(game, 1));
  }
  peer.expect<protocol::Concede>();
  peer.expect<protocol::Concede>();
}

TEST_F(ClientTest, StopsWhileNobodyListens) {
  acceptor_.close();
  start();
  client_->stop();
  EXPECT_EQ(end_.get().ending, Ending::stopped);
}

TEST_F(ClientTest, HandsOnWhatAPlayerThrows) {
  start(player_from([](const TurnView&) -> Move { throw std::runtime_error("no idea"); }));
  Peer peer = accept();
  peer.log_in();
  peer.notify(test_support::scripted_start(GameId{17}));
  peer.notify(test_support::scripted_turn(GameId{17}, 1));
  EXPECT_THROW(end_.get(), std::runtime_error);
}

TEST_F(ClientTest, GivesUpAConnectionOnWhichTheServerSaysNothing) {
  options_.login_deadline = std::chrono::milliseconds(20);
  start();
  Peer silent = accept();
  Peer second = accept();
  second.log_in();
}

}  // namespace
}  // namespace poolhall::client
