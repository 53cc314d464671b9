// Lines to a server and back over a transport. Not thread-safe: everything happens on one
// executor.
//
//   Connection connection(executor, std::move(transport), limit);
//   connection.send(line);                                // never blocks
//   tl::expected<std::string, ConnectionError> line = co_await connection.read_line();
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <tl/expected.hpp>

#include "clients/cpp/transport.hpp"
#include "protocol/framing.hpp"

namespace poolhall::client {

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::any_io_executor executor, std::unique_ptr<Transport> transport,
             std::size_t line_limit);

  // `line` with its end. What is sent after the connection broke is dropped.
  void send(std::string line);
  // Without its end.
  [[nodiscard]] boost::asio::awaitable<tl::expected<std::string, ConnectionError>> read_line();
  void close();

 private:
  [[nodiscard]] static boost::asio::awaitable<void> drain(std::shared_ptr<Connection> self);

  boost::asio::any_io_executor executor_;
  std::unique_ptr<Transport> transport_;
  protocol::LineSplitter splitter_;
  std::array<char, 16 * 1024> chunk_{};
  std::string_view rest_;  // of chunk_, read and not yet split
  std::deque<std::string> output_;
  bool is_writing_ = false;
  bool is_open_ = true;
};

}  // namespace poolhall::client
