// One connection with nothing around it.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "server/net/connection.hpp"

namespace poolhall::net {
namespace {

using boost::asio::ip::tcp;
using namespace std::chrono_literals;

// Owes an answer and never gives it.
class Debtor : public Connection::Handler {
 public:
  void on_line(std::string_view, SteadyTime) override {}
  void on_line_too_long() override {}
  void on_line_too_slow() override {}
  void on_output_unread() override {}
  void on_input_over() override { heard_the_end = true; }
  [[nodiscard]] bool owes_answers() const override { return true; }
  void on_closed(std::string_view why) override { closed = why; }

  bool heard_the_end = false;
  std::string closed;
};

struct ConnectionTest : testing::Test {
  ConnectionTest() { peer.connect(acceptor.local_endpoint()); }

  std::shared_ptr<Connection> accept() {
    return std::make_shared<Connection>(Channel{acceptor.accept(), nullptr}, ConnectionId{1},
                                        context);
  }

  boost::asio::io_context io{1};
  DeadlineQueue deadlines{io};
  const protocol::Limits limits;
  ConnectionContext context{limits, deadlines};
  tcp::acceptor acceptor{io, tcp::endpoint{boost::asio::ip::address_v4::loopback(), 0}};
  tcp::socket peer{io};
  std::shared_ptr<Debtor> debtor = std::make_shared<Debtor>();
};

TEST_F(ConnectionTest, WhoseInputIsOverIsNotKeptForEverForAnAnswer) {
  context.last_answers = 20ms;
  const auto connection = accept();
  connection->start(debtor);
  peer.shutdown(tcp::socket::shutdown_send);
  while (debtor->closed.empty() && io.run_one_for(60s) > 0) {
  }
  EXPECT_TRUE(debtor->heard_the_end);
  EXPECT_EQ(debtor->closed, "its last lines were not ready, or not read, in time");
  char byte = 0;
  boost::system::error_code end;
  peer.read_some(boost::asio::buffer(&byte, 1), end);
  EXPECT_EQ(end, boost::asio::error::eof);
}

// Who sends first and reads then finds the last line, however long it sends.
TEST_F(ConnectionTest, ThatEndsIsKeptWhileItsPeerStillSends) {
  const auto connection = accept();
  connection->start(debtor);
  connection->close(std::make_shared<const std::string>("bye\n"), "it was time");
  boost::system::error_code error;
  for (int i = 0; i < 12 && !error; ++i) {
    io.run_for(250ms);
    boost::asio::write(peer, boost::asio::buffer("more\n", 5), error);
  }
  ASSERT_FALSE(error) << error.message();
  EXPECT_EQ(debtor->closed, "it was time");
  peer.shutdown(tcp::socket::shutdown_send);
  std::string last;
  boost::asio::read(peer, boost::asio::dynamic_buffer(last), error);
  EXPECT_EQ(last, "bye\n");
  EXPECT_EQ(error, boost::asio::error::eof);
}

TEST_F(ConnectionTest, ThatEndsIsNotKeptForEverForAPeerThatStillSends) {
  context.last_answers = 500ms;
  const auto connection = accept();
  bool is_gone = false;
  connection->on_gone([&is_gone] { is_gone = true; });
  connection->start(debtor);
  connection->close(std::make_shared<const std::string>("bye\n"), "it was time");
  boost::system::error_code error;
  while (!is_gone && !error) {
    boost::asio::write(peer, boost::asio::buffer("more\n", 5), error);
    io.run_for(20ms);
  }
  EXPECT_TRUE(is_gone);
}

}  // namespace
}  // namespace poolhall::net
