// What the system is told about a socket, and what it tells.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <string>

namespace poolhall::net {

// No delay, keep-alive, and an end when sent data stays unacknowledged for `unacknowledged`.
void set_agent_options(boost::asio::ip::tcp::socket& socket,
                       std::chrono::milliseconds unacknowledged);

// What the peer's system has not acknowledged, and when it last acknowledged anything.
struct Delivery {
  std::size_t unacknowledged_bytes = 0;
  std::chrono::milliseconds since_last_acknowledgement{0};
};
[[nodiscard]] Delivery delivery_of(boost::asio::ip::tcp::socket& socket);
// 0: the connection does not end for want of acknowledgements.
void set_user_timeout(boost::asio::ip::tcp::socket& socket,
                      std::chrono::milliseconds unacknowledged);

// "127.0.0.1:40312", or "?" when the peer is gone already.
[[nodiscard]] std::string peer_name(const boost::asio::ip::tcp::socket& socket);
// Unspecified when the peer is gone already.
[[nodiscard]] boost::asio::ip::address peer_address(const boost::asio::ip::tcp::socket& socket);

// As many file descriptors as the system lets us have; the limit now in force.
[[nodiscard]] std::uint64_t raise_descriptor_limit();

}  // namespace poolhall::net
