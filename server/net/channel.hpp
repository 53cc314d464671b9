// A socket's bytes, plain or inside TLS, taken and given without waiting: whoever uses it waits
// for the socket. TLS's handshake happens within the first reads and writes.
//
//   Channel channel{std::move(socket), tls_context};   // null: plain
//   Channel::Result got = channel.read(buffer);
//   if (got.state == Channel::State::again) ...        // nothing has come
#pragma once

#include <openssl/types.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace poolhall::net {

class Channel {
 public:
  enum class State {
    done,
    again,         // the socket has, or takes, nothing more now
    needs_input,   // of a write: TLS must read first
    needs_output,  // of a read: TLS must write first
    at_end,        // of a read: the peer sends no more
    broken,
  };
  struct Result {
    State state = State::done;
    std::size_t bytes = 0;
  };

  // `tls` lives as long as the channel.
  Channel(boost::asio::ip::tcp::socket socket, SSL_CTX* tls);

  [[nodiscard]] Result read(std::span<char> buffer);
  // Of all buffers together, from the first on.
  [[nodiscard]] Result write(std::span<const boost::asio::const_buffer> buffers);
  // Bytes that a read gives though the socket has none.
  [[nodiscard]] bool has_unread() const;
  // The beginning of the last write is under way: the next one must begin with the same bytes.
  [[nodiscard]] bool has_unsent() const { return has_unsent_; }
  // No more will be written.
  void finish();
  void close();

  [[nodiscard]] boost::asio::ip::tcp::socket& socket() { return socket_; }
  [[nodiscard]] const boost::asio::ip::tcp::socket& socket() const { return socket_; }

 private:
  struct FreeSsl {
    void operator()(SSL* ssl) const;
  };

  [[nodiscard]] Result read_tls(std::span<char> buffer);
  [[nodiscard]] Result write_tls(std::span<const boost::asio::const_buffer> buffers);
  [[nodiscard]] State state_after(int returned) const;

  boost::asio::ip::tcp::socket socket_;
  std::unique_ptr<SSL, FreeSsl> ssl_;
  bool has_unsent_ = false;
};

}  // namespace poolhall::net
