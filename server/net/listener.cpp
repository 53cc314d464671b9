#include "server/net/listener.hpp"
#include "server/net/awaited.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

#include "protocol/codec.hpp"

namespace poolhall::net {

namespace asio = boost::asio;
using asio::ip::tcp;
using protocol::Error;
using protocol::ErrorCode;

namespace {

constexpr int backlog = 4'096;
constexpr std::chrono::milliseconds breath{50};

bool means_no_resources(const boost::system::error_code& error) {
  return error == asio::error::no_descriptors || error.value() == ENFILE ||
         error == asio::error::no_buffer_space || error == asio::error::no_memory;
}

}  // namespace

Listener::Listener(asio::io_context& io, Visitors& visitors, Accept accept, TurnAway turn_away)
    : io_(io),
      accept_(std::move(accept)),
      acceptor_(io),
      pause_(io),
      visitors_(visitors),
      turn_away_(std::move(turn_away)) {
  reserve();
}

Listener::~Listener() {
  if (reserved_ >= 0) {
    ::close(reserved_);
  }
}

void Listener::reserve() {
  reserved_ = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

tl::expected<void, std::string> Listener::open(const Endpoint& endpoint) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(endpoint.host, error);
  if (error) {
    return tl::unexpected(
        fmt::format("{}: expected the address of this machine to listen on", endpoint.host));
  }
  const tcp::endpoint local{address, endpoint.port};
  if (!acceptor_.open(local.protocol(), error) &&
      !acceptor_.set_option(tcp::acceptor::reuse_address(true), error) &&
      !acceptor_.bind(local, error)) {
    acceptor_.listen(backlog, error);
  }
  if (error) {
    acceptor_.close();
    return tl::unexpected(fmt::format("{}: {}", to_string(endpoint), error.message()));
  }
  return {};
}

void Listener::start() {
  asio::co_spawn(io_, accept_loop(), asio::detached);
}

void Listener::stop() {
  boost::system::error_code error;
  acceptor_.close(error);
  pause_.cancel();
}

Endpoint Listener::endpoint() const {
  boost::system::error_code error;
  const auto local = acceptor_.local_endpoint(error);
  return {local.address().to_string(), local.port()};
}

asio::awaitable<void> Listener::accept_loop() {
  while (acceptor_.is_open()) {
    auto [error, socket] = co_await acceptor_.async_accept(awaited);
    if (!error) {
      accepted(std::move(socket));
    } else if (means_no_resources(error)) {
      co_await out_of_descriptors();
    } else if (error != asio::error::operation_aborted) {
      spdlog::warn("a connection could not be accepted: {}", error.message());
    }
  }
}

// The reserved descriptor makes room to tell one of those that wait; the others are told in turn.
asio::awaitable<void> Listener::out_of_descriptors() {
  spdlog::warn("no file descriptors left at {} connections", visitors_.connections());
  if (reserved_ >= 0) {
    ::close(std::exchange(reserved_, -1));
  }
  boost::system::error_code error;
  acceptor_.non_blocking(true, error);
  tcp::socket socket = acceptor_.accept(error);
  if (!error) {
    refuse(std::move(socket),
           {ErrorCode::server_full, "", "the server has no file descriptors left"});
  }
  reserve();
  pause_.expires_after(breath);
  co_await pause_.async_wait(awaited);
}

void Listener::accepted(tcp::socket socket) {
  boost::system::error_code error;
  const auto peer = socket.remote_endpoint(error);
  if (error) {
    return;  // gone already
  }
  if (const auto refused = visitors_.arrives(peer.address(), std::chrono::steady_clock::now())) {
    refuse(std::move(socket), *refused);
    return;
  }
  accept_(std::move(socket),
          [&visitors = visitors_, address = peer.address()] { visitors.leaves(address); });
}

// One line, whatever of it the socket takes at once, and the end. What has come in is read first:
// unread bytes would reset the connection, and the line with it.
void Listener::refuse(tcp::socket socket, const Error& error) {
  ++refused_;
  if (turn_away_) {
    turn_away_(std::move(socket), error);
    return;
  }
  const std::string line = protocol::encode_error({}, error);
  boost::system::error_code ignored;
  socket.non_blocking(true, ignored);
  socket.write_some(asio::buffer(line), ignored);
  socket.shutdown(tcp::socket::shutdown_send, ignored);
  std::array<char, 4096> unread{};
  socket.read_some(asio::buffer(unread), ignored);
  socket.close(ignored);
}

}  // namespace poolhall::net
