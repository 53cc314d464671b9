// What the system is told about a socket, and what it tells.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <string>

namespace poolhall::net {

// No delay, keep-alive, and an end when sent data stays unacknowledged for `unacknowledged`.
void set_agent_options(boost::asio::ip::tcp::socket& socket,
                       std::chrono::milliseconds unacknowledged);

// "127.0.0.1:40312", or "?" when the peer is gone already.
[[nodiscard]] std::string peer_name(const boost::asio::ip::tcp::socket& socket);

// As many file descriptors as the system lets us have; the limit now in force.
[[nodiscard]] std::uint64_t raise_descriptor_limit();

}  // namespace poolhall::net
