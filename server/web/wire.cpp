#include "server/web/wire.hpp"

#include <boost/asio/bind_executor.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl.hpp>
#include <optional>
#include <utility>

#include "server/web/awaited.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

namespace {

constexpr std::chrono::seconds handshake_patience{10};
constexpr std::chrono::seconds farewell{2};
constexpr std::size_t farewell_bytes = 1024 * 1024;

}  // namespace

struct Wire::Streams {
  // One of the two.
  std::optional<beast::tcp_stream> plain{};
  std::optional<beast::ssl_stream<beast::tcp_stream>> tls{};

  beast::tcp_stream& lowest() { return tls ? beast::get_lowest_layer(*tls) : *plain; }
};

Wire::Wire(tcp::socket socket, asio::ssl::context* tls) : streams_(std::make_unique<Streams>()) {
  if (tls != nullptr) {
    streams_->tls.emplace(std::move(socket), *tls);
  } else {
    streams_->plain.emplace(std::move(socket));
  }
}

Wire::Wire(Wire&& other) noexcept = default;
Wire& Wire::operator=(Wire&& other) noexcept = default;
Wire::~Wire() = default;

Wire::executor_type Wire::get_executor() {
  return streams_->lowest().get_executor();
}

asio::awaitable<Wire::Error> Wire::shake_hands() {
  if (!streams_->tls) {
    co_return Error{};
  }
  expires_after(handshake_patience);
  const auto [failed] =
      co_await streams_->tls->async_handshake(asio::ssl::stream_base::server, awaited);
  co_return failed;
}

asio::awaitable<Wire::Error> Wire::shake_hands_with(std::string host) {
  if (!streams_->tls) {
    co_return Error{};
  }
  expires_after(handshake_patience);
  static_cast<void>(SSL_set_tlsext_host_name(streams_->tls->native_handle(), host.c_str()));
  streams_->tls->set_verify_mode(asio::ssl::verify_peer);
  streams_->tls->set_verify_callback(asio::ssl::host_name_verification(host));
  const auto [failed] =
      co_await streams_->tls->async_handshake(asio::ssl::stream_base::client, awaited);
  co_return failed;
}

asio::awaitable<void> Wire::part() {
  expires_after(farewell);
  if (streams_->tls) {
    co_await streams_->tls->async_shutdown(awaited);
  }
  beast::tcp_stream& stream = streams_->lowest();
  Error ignored;
  stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
  std::array<char, 4096> bytes{};
  for (std::size_t total = 0; total < farewell_bytes;) {
    const auto [failed, got] = co_await stream.async_read_some(asio::buffer(bytes), awaited);
    if (failed) {
      co_return;
    }
    total += got;
  }
}

void Wire::expires_after(std::chrono::milliseconds time) {
  streams_->lowest().expires_after(time);
}

void Wire::expires_never() {
  streams_->lowest().expires_never();
}

void Wire::limit_send_buffer(int bytes) {
  Error ignored;
  streams_->lowest().socket().set_option(tcp::socket::send_buffer_size(bytes), ignored);
}

// The executor of a handler whose type is forgotten is not enough for Beast; all of a wire runs on
// its own.
void Wire::start_reading(asio::mutable_buffer into, Moved moved) {
  auto handler = asio::bind_executor(get_executor(), std::move(moved));
  if (streams_->tls) {
    streams_->tls->async_read_some(into, std::move(handler));
  } else {
    streams_->plain->async_read_some(into, std::move(handler));
  }
}

void Wire::start_writing(const Pieces& pieces, Moved moved) {
  auto handler = asio::bind_executor(get_executor(), std::move(moved));
  if (streams_->tls) {
    streams_->tls->async_write_some(pieces, std::move(handler));
  } else {
    streams_->plain->async_write_some(pieces, std::move(handler));
  }
}

void Wire::start_parting(Done handler) {
  asio::co_spawn(
      get_executor(), part(),
      [handler = std::move(handler)](std::exception_ptr) mutable { std::move(handler)(Error{}); });
}

void Wire::shut(Error& error) {
  streams_->lowest().socket().shutdown(tcp::socket::shutdown_both, error);
}

void Wire::close() {
  streams_->lowest().close();
}

}  // namespace poolhall::web
