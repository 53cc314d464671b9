#include "server/net/socket_options.hpp"

#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include "server/net/server.hpp"

namespace poolhall::net {

namespace {

// Keep-alive: a silent peer is probed after a minute, every 10 s, and given up after 6 probes.
constexpr int keep_alive_idle_s = 60;
constexpr int keep_alive_interval_s = 10;
constexpr int keep_alive_probes = 6;

void set(int descriptor, int level, int option, int value) {
  // An option that the system refuses costs speed or an earlier notice, never a game.
  static_cast<void>(::setsockopt(descriptor, level, option, &value, sizeof value));
}

}  // namespace

void set_agent_options(boost::asio::ip::tcp::socket& socket,
                       std::chrono::milliseconds unacknowledged) {
  const int descriptor = socket.native_handle();
  set(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, keep_alive_idle_s);
  set(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, keep_alive_interval_s);
  set(descriptor, IPPROTO_TCP, TCP_KEEPCNT, keep_alive_probes);
  set_user_timeout(socket, unacknowledged);
}

void set_user_timeout(boost::asio::ip::tcp::socket& socket,
                      std::chrono::milliseconds unacknowledged) {
  set(socket.native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT,
      static_cast<int>(unacknowledged.count()));
}

Delivery delivery_of(boost::asio::ip::tcp::socket& socket) {
  Delivery delivery;
  int bytes = 0;
  if (::ioctl(socket.native_handle(), SIOCOUTQ, &bytes) == 0 && bytes > 0) {
    delivery.unacknowledged_bytes = static_cast<std::size_t>(bytes);
  }
  tcp_info info{};
  socklen_t size = sizeof info;
  if (::getsockopt(socket.native_handle(), IPPROTO_TCP, TCP_INFO, &info, &size) == 0) {
    delivery.since_last_acknowledgement = std::chrono::milliseconds{info.tcpi_last_ack_recv};
  }
  return delivery;
}

boost::asio::ip::address peer_address(const boost::asio::ip::tcp::socket& socket) {
  boost::system::error_code error;
  return socket.remote_endpoint(error).address();
}

std::string peer_name(const boost::asio::ip::tcp::socket& socket) {
  boost::system::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  if (error) {
    return "?";
  }
  return to_string(Endpoint{endpoint.address().to_string(), endpoint.port()});
}

std::uint64_t raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) {
    return 0;
  }
  limit.rlim_cur = limit.rlim_max;
  static_cast<void>(::setrlimit(RLIMIT_NOFILE, &limit));
  static_cast<void>(::getrlimit(RLIMIT_NOFILE, &limit));
  return limit.rlim_cur;
}

}  // namespace poolhall::net
