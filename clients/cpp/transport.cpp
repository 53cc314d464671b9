#include "clients/cpp/transport.hpp"
#include "clients/cpp/awaited.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include <utility>

namespace poolhall::client {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

class TcpTransport : public Transport {
 public:
  explicit TcpTransport(tcp::socket socket) : socket_(std::move(socket)) {}

  asio::awaitable<tl::expected<std::size_t, ConnectionError>> read_some(
      std::span<char> buffer) override {
    const auto [error, count] =
        co_await socket_.async_read_some(asio::buffer(buffer.data(), buffer.size()), awaited);
    if (error) {
      co_return tl::unexpected(ConnectionError{error.message()});
    }
    co_return count;
  }

  asio::awaitable<tl::expected<void, ConnectionError>> write(std::string_view bytes) override {
    const auto [error, count] =
        co_await asio::async_write(socket_, asio::buffer(bytes.data(), bytes.size()), awaited);
    static_cast<void>(count);
    if (error) {
      co_return tl::unexpected(ConnectionError{error.message()});
    }
    co_return tl::expected<void, ConnectionError>{};
  }

  void close() override {
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  tcp::socket socket_;
};

}  // namespace

asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>> connect_tcp(
    std::string host, std::string port) {
  const auto executor = co_await asio::this_coro::executor;
  tcp::resolver resolver(executor);
  const auto [unresolved, endpoints] = co_await resolver.async_resolve(host, port, awaited);
  if (unresolved) {
    co_return tl::unexpected(ConnectionError{host + ":" + port + ": " + unresolved.message()});
  }
  tcp::socket socket(executor);
  const auto [unreachable, endpoint] = co_await asio::async_connect(socket, endpoints, awaited);
  static_cast<void>(endpoint);
  if (unreachable) {
    co_return tl::unexpected(ConnectionError{host + ":" + port + ": " + unreachable.message()});
  }
  boost::system::error_code ignored;  // both options only make things better
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  co_return std::make_unique<TcpTransport>(std::move(socket));
}

}  // namespace poolhall::client
