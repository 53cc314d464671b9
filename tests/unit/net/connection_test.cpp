// One connection with nothing around it.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

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

TEST(Connection, WhoseInputIsOverIsNotKeptForEverForAnAnswer) {
  boost::asio::io_context io{1};
  DeadlineQueue deadlines{io};
  const protocol::Limits limits;
  ConnectionContext context{limits, deadlines};
  context.last_answers = 20ms;
  tcp::acceptor acceptor{io, tcp::endpoint{boost::asio::ip::address_v4::loopback(), 0}};
  tcp::socket peer{io};
  peer.connect(acceptor.local_endpoint());
  const auto connection =
      std::make_shared<Connection>(Channel{acceptor.accept(), nullptr}, ConnectionId{1}, context);
  const auto debtor = std::make_shared<Debtor>();
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

}  // namespace
}  // namespace poolhall::net
