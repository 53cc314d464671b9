// Accepts connections, counts them, and goes on accepting whatever happens: refusals are said in
// the protocol, and running out of file descriptors is waited out.
//
//   Listener listener{io, visitors, [&](tcp::socket socket, auto gone) { arena.accept(...);
//   }}; if (auto bound = listener.open(endpoint); !bound) die(bound.error()); listener.start();
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "protocol/errors.hpp"
#include "server/net/server.hpp"
#include "server/net/visitors.hpp"

namespace poolhall::net {

class Listener {
 public:
  // `gone` is to be called when the socket has been closed.
  using Accept =
      std::function<void(boost::asio::ip::tcp::socket socket, std::function<void()> gone)>;
  // Says why, and ends.
  using TurnAway =
      std::function<void(boost::asio::ip::tcp::socket socket, const protocol::Error& error)>;

  // Without `turn_away` refusals are written in plain text.
  Listener(boost::asio::io_context& io, Visitors& visitors, Accept accept, TurnAway turn_away = {});
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // The error is one line for a person: "127.0.0.1:7777: Address already in use".
  [[nodiscard]] tl::expected<void, std::string> open(const Endpoint& endpoint);
  void start();
  void stop();
  // With the port that the system picked.
  [[nodiscard]] Endpoint endpoint() const;
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  boost::asio::awaitable<void> accept_loop();
  boost::asio::awaitable<void> out_of_descriptors();
  void accepted(boost::asio::ip::tcp::socket socket);
  void refuse(boost::asio::ip::tcp::socket socket, const protocol::Error& error);
  void reserve();

  boost::asio::io_context& io_;
  Accept accept_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  int reserved_ = -1;  // a descriptor to give up when there are no others
  Visitors& visitors_;
  TurnAway turn_away_;
  std::uint64_t refused_ = 0;
};

}  // namespace poolhall::net
