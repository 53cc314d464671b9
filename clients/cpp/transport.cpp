#include "clients/cpp/transport.hpp"
#include "clients/cpp/awaited.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include <utility>

namespace poolhall::client {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace boost::asio::experimental::awaitable_operators;
constexpr std::chrono::seconds handshake_deadline{10};

// `Stream` is a socket, or TLS on one.
template <class Stream>
class StreamTransport : public Transport {
 public:
  explicit StreamTransport(Stream stream) : stream_(std::move(stream)) {}

  asio::awaitable<tl::expected<std::size_t, ConnectionError>> read_some(
      std::span<char> buffer) override {
    const auto [error, count] =
        co_await stream_.async_read_some(asio::buffer(buffer.data(), buffer.size()), awaited);
    if (error) {
      co_return tl::unexpected(ConnectionError{error.message()});
    }
    co_return count;
  }

  asio::awaitable<tl::expected<void, ConnectionError>> write(std::string_view bytes) override {
    const auto [error, count] =
        co_await asio::async_write(stream_, asio::buffer(bytes.data(), bytes.size()), awaited);
    static_cast<void>(count);
    if (error) {
      co_return tl::unexpected(ConnectionError{error.message()});
    }
    co_return tl::expected<void, ConnectionError>{};
  }

  void close() override {
    boost::system::error_code ignored;
    stream_.lowest_layer().close(ignored);
  }

 private:
  Stream stream_;
};

using TlsStream = asio::ssl::stream<tcp::socket>;

// TLS streams refer to their context, which is kept with them.
class TlsTransport : public StreamTransport<TlsStream> {
 public:
  TlsTransport(std::unique_ptr<asio::ssl::context> context, TlsStream stream)
      : StreamTransport(std::move(stream)), context_(std::move(context)) {}

 private:
  std::unique_ptr<asio::ssl::context> context_;
};

std::string place(const std::string& host, const std::string& port) {
  return host + ":" + port + ": ";
}

asio::awaitable<tl::expected<tcp::socket, ConnectionError>> connected(std::string host,
                                                                      std::string port) {
  const auto executor = co_await asio::this_coro::executor;
  tcp::resolver resolver(executor);
  const auto [unresolved, endpoints] = co_await resolver.async_resolve(host, port, awaited);
  if (unresolved) {
    co_return tl::unexpected(ConnectionError{place(host, port) + unresolved.message()});
  }
  tcp::socket socket(executor);
  const auto [unreachable, endpoint] = co_await asio::async_connect(socket, endpoints, awaited);
  static_cast<void>(endpoint);
  if (unreachable) {
    co_return tl::unexpected(ConnectionError{place(host, port) + unreachable.message()});
  }
  boost::system::error_code ignored;  // both options only make things better
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  co_return socket;
}

tl::expected<std::unique_ptr<asio::ssl::context>, ConnectionError> context_of(
    const TlsOptions& options) {
  auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_client);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  boost::system::error_code error;
  if (options.ca_file.empty()) {
    context->set_default_verify_paths(error);
  } else {
    context->load_verify_file(options.ca_file, error);
  }
  if (error) {
    return tl::unexpected(ConnectionError{options.ca_file + ": " + error.message()});
  }
  context->set_verify_mode(asio::ssl::verify_peer, error);
  return context;
}

}  // namespace

asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>> connect_tcp(
    std::string host, std::string port) {
  auto socket = co_await connected(std::move(host), std::move(port));
  if (!socket) {
    co_return tl::unexpected(socket.error());
  }
  co_return std::make_unique<StreamTransport<tcp::socket>>(*std::move(socket));
}

asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>> connect_tls(
    std::string host, std::string port, TlsOptions options) {
  auto context = context_of(options);
  if (!context) {
    co_return tl::unexpected(context.error());
  }
  auto socket = co_await connected(host, port);
  if (!socket) {
    co_return tl::unexpected(socket.error());
  }
  TlsStream stream(*std::move(socket), **context);
  static_cast<void>(SSL_set_tlsext_host_name(stream.native_handle(), host.c_str()));
  stream.set_verify_callback(asio::ssl::host_name_verification(host));
  asio::steady_timer late(co_await asio::this_coro::executor, handshake_deadline);
  const auto first = co_await (stream.async_handshake(asio::ssl::stream_base::client, awaited) ||
                               late.async_wait(awaited));
  if (first.index() == 1) {
    co_return tl::unexpected(ConnectionError{place(host, port) + "no TLS handshake in time"});
  }
  if (const auto [failed] = std::get<0>(first); failed) {
    co_return tl::unexpected(ConnectionError{place(host, port) + failed.message()});
  }
  co_return std::make_unique<TlsTransport>(*std::move(context), std::move(stream));
}

}  // namespace poolhall::client
