// Bytes to a server and back: plain TCP, or TLS. What carries the bytes is behind an interface, so
// that the rest of the client does not see whether they are encrypted.
//
//   auto transport = co_await connect_tcp("127.0.0.1", "7777");
//   auto encrypted = co_await connect_tls("pool.example", "7778", {.ca_file = "host.pem"});
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <boost/asio/awaitable.hpp>
#include <tl/expected.hpp>

namespace poolhall::client {

// Why a connection could not be made or broke, in one line.
struct ConnectionError {
  std::string reason;
};

class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  // At least one byte, or the reason why there are none.
  virtual boost::asio::awaitable<tl::expected<std::size_t, ConnectionError>> read_some(
      std::span<char> buffer) = 0;
  virtual boost::asio::awaitable<tl::expected<void, ConnectionError>> write(
      std::string_view bytes) = 0;
  // Ends pending reads and writes.
  virtual void close() = 0;
};

[[nodiscard]] boost::asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>>
connect_tcp(std::string host, std::string port);

struct TlsOptions {
  std::string ca_file{};  // PEM: whose certificates are believed; empty: those the system believes
};
// The server's certificate must be good, and for this host.
[[nodiscard]] boost::asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>>
connect_tls(std::string host, std::string port, TlsOptions options);

}  // namespace poolhall::client
