// Clients that behave badly, while a game between two good ones goes on.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

#include "../../integration/net/scripted_play.hpp"
#include "../../integration/net/test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using rules::Seat;

// A socket without manners.
class Rude {
 public:
  explicit Rude(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("a rude client cannot connect");
    }
  }
  ~Rude() {
    if (socket_ >= 0) {
      ::close(socket_);
    }
  }
  Rude(const Rude&) = delete;
  Rude& operator=(const Rude&) = delete;

  void say(std::string_view bytes) {
    static_cast<void>(!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  void reset() {
    const linger at_once{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    ::close(std::exchange(socket_, -1));
  }
  void half_close() { ::shutdown(socket_, SHUT_WR); }

 private:
  int socket_;
};

class BadClients : public ::testing::Test {
 protected:
  BadClients() {
    anna_.join("anna");
    bert_token_ = bert_.join("bert");
    game_ = start_game(anna_, bert_, "bert");
  }

  // The good game goes on for two turns.
  void play_on() {
    const rules::GameState after = play_turns({anna_, bert_}, to_move_, played_ += 2);
    ASSERT_FALSE(after.result);
    to_move_ = after.to_move;
  }

  test_support::TemporaryDirectory directory_;
  TestServer server_{directory_ / "test.db"};
  WireClient anna_{server_.port()};
  WireClient bert_{server_.port()};
  std::string bert_token_;
  protocol::GameId game_{};
  Seat to_move_ = Seat::first;
  std::uint32_t played_ = 0;
};

TEST_F(BadClients, MayResetInTheMiddleOfALine) {
  for (int i = 0; i < 20; ++i) {
    Rude rude{server_.port()};
    rude.say("{\"jsonrpc\":\"2.0\",\"id\":1,\"meth");
    rude.reset();
  }
  play_on();
}

TEST_F(BadClients, MaySendWhatIsNoText) {
  for (int i = 0; i < 10; ++i) {
    Rude rude{server_.port()};
    std::string bytes(10'000, '\0');
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      bytes[k] = static_cast<char>(k * 131 + static_cast<std::size_t>(i));
    }
    rude.say(bytes);
  }
  play_on();
}

TEST_F(BadClients, MayCloseTheirHalfAndStay) {
  Rude rude{server_.port()};
  rude.say("{\"jsonrpc\":\"2.0\"}\n");
  rude.half_close();
  play_on();
}

TEST_F(BadClients, MayNestAndRepeatWithoutEnd) {
  WireClient rude{server_.port()};
  rude.send_bytes(std::string(3'000, '[') + "\n");
  rude.send_bytes(R"({"jsonrpc":"2.0","id":1,"id":2,"method":"ping"})"
                  "\n");
  rude.send_bytes(R"({"jsonrpc":"2.0","id":1,"method":"hello","params":{"name":"\ud800"}})"
                  "\n");
  for (int i = 0; i < 3; ++i) {
    const auto message = rude.next_message();
    ASSERT_TRUE(message);
    EXPECT_TRUE(std::holds_alternative<protocol::ErrorMessage>(*message));
  }
  play_on();
}

TEST_F(BadClients, CannotPlayOthersGames) {
  WireClient rude{server_.port()};
  rude.join("rude");
  for (std::int64_t id = 1; id < 5; ++id) {
    EXPECT_EQ(rude.refused(protocol::Concede{protocol::GameId{id}}).code, "unknown_game");
    EXPECT_EQ(rude.refused(protocol::Ack{protocol::GameId{id}}).code, "unknown_game");
  }
  play_on();
}

TEST_F(BadClients, CannotGuessTokens) {
  WireClient rude{server_.port()};
  rude.hello();
  std::string near = bert_token_;
  near.back() = near.back() == '0' ? '1' : '0';
  EXPECT_EQ(rude.refused(protocol::Login{{near}}).code, "unauthorized");
  play_on();
}

}  // namespace
}  // namespace poolhall::net_tests
