#include "server/net/channel.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <new>
#include <utility>

namespace poolhall::net {

namespace asio = boost::asio;

namespace {

// OpenSSL's own BIO of sockets would raise SIGPIPE when the peer is gone; this one does not.
int descriptor_of(BIO* bio) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(BIO_get_data(bio)));
}

bool nothing_now() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

int bio_write(BIO* bio, const char* data, int size) {
  BIO_clear_retry_flags(bio);
  const auto sent = ::send(descriptor_of(bio), data, static_cast<std::size_t>(size), MSG_NOSIGNAL);
  if (sent < 0 && nothing_now()) {
    BIO_set_retry_write(bio);
  }
  return static_cast<int>(sent);
}

int bio_read(BIO* bio, char* data, int size) {
  BIO_clear_retry_flags(bio);
  const auto got = ::recv(descriptor_of(bio), data, static_cast<std::size_t>(size), 0);
  if (got < 0 && nothing_now()) {
    BIO_set_retry_read(bio);
  }
  return static_cast<int>(got);
}

long bio_control(BIO*, int command, long, void*) {
  return command == BIO_CTRL_FLUSH ? 1 : 0;
}

BIO_METHOD* socket_method() {
  static BIO_METHOD* const method = [] {
    BIO_METHOD* made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "quiet socket");
    BIO_meth_set_write(made, bio_write);
    BIO_meth_set_read(made, bio_read);
    BIO_meth_set_ctrl(made, bio_control);
    return made;
  }();
  return method;
}

BIO* bio_of(int descriptor) {
  BIO* bio = BIO_new(socket_method());
  if (bio == nullptr) {
    throw std::bad_alloc();
  }
  // NOLINTNEXTLINE(performance-no-int-to-ptr): a BIO has a pointer for what its methods need
  BIO_set_data(bio, reinterpret_cast<void*>(static_cast<std::intptr_t>(descriptor)));
  BIO_set_init(bio, 1);
  return bio;
}

Channel::State state_of(const boost::system::error_code& error) {
  if (!error) {
    return Channel::State::done;
  }
  if (error == asio::error::eof) {
    return Channel::State::at_end;
  }
  const bool later = error == asio::error::would_block || error == asio::error::try_again;
  return later ? Channel::State::again : Channel::State::broken;
}

}  // namespace

void Channel::FreeSsl::operator()(SSL* ssl) const {
  SSL_free(ssl);
}

Channel::Channel(asio::ip::tcp::socket socket, SSL_CTX* tls) : socket_(std::move(socket)) {
  boost::system::error_code error;
  socket_.non_blocking(true, error);
  if (tls == nullptr) {
    return;
  }
  ssl_.reset(SSL_new(tls));
  if (!ssl_) {
    throw std::bad_alloc();
  }
  BIO* const bio = bio_of(socket_.native_handle());
  SSL_set_bio(ssl_.get(), bio, bio);
  SSL_set_accept_state(ssl_.get());
}

Channel::Result Channel::read(std::span<char> buffer) {
  if (ssl_) {
    return read_tls(buffer);
  }
  boost::system::error_code error;
  const std::size_t got = socket_.read_some(asio::buffer(buffer.data(), buffer.size()), error);
  return {state_of(error), got};
}

Channel::Result Channel::write(std::span<const asio::const_buffer> buffers) {
  if (ssl_) {
    return write_tls(buffers);
  }
  boost::system::error_code error;
  const std::size_t sent = socket_.write_some(buffers, error);
  return {state_of(error), sent};
}

Channel::Result Channel::read_tls(std::span<char> buffer) {
  ERR_clear_error();
  std::size_t got = 0;
  const int returned = SSL_read_ex(ssl_.get(), buffer.data(), buffer.size(), &got);
  if (returned == 1) {
    return {State::done, got};
  }
  if (SSL_get_error(ssl_.get(), returned) == SSL_ERROR_ZERO_RETURN) {
    return {State::at_end, 0};  // the peer has said so: an end without a word may be another's work
  }
  switch (state_after(returned)) {
    case State::needs_input:
      return {State::again, 0};
    case State::needs_output:
      return {State::needs_output, 0};
    default:
      return {State::broken, 0};
  }
}

Channel::Result Channel::write_tls(std::span<const asio::const_buffer> buffers) {
  Result result;
  has_unsent_ = false;
  for (const asio::const_buffer& buffer : buffers) {
    ERR_clear_error();
    std::size_t sent = 0;
    const int returned = SSL_write_ex(ssl_.get(), buffer.data(), buffer.size(), &sent);
    result.bytes += returned == 1 ? sent : 0;
    if (returned != 1) {
      const State state = state_after(returned);
      has_unsent_ = state == State::needs_output;
      result.state = has_unsent_ ? State::again : state;
    }
    if (returned != 1 || sent < buffer.size()) {
      break;
    }
  }
  if (result.bytes > 0) {
    result.state = State::done;  // the next write says what is the matter
  }
  return result;
}

Channel::State Channel::state_after(int returned) const {
  switch (SSL_get_error(ssl_.get(), returned)) {
    case SSL_ERROR_WANT_READ:
      return State::needs_input;
    case SSL_ERROR_WANT_WRITE:
      return State::needs_output;
    default:
      return State::broken;
  }
}

bool Channel::has_unread() const {
  return ssl_ && SSL_pending(ssl_.get()) > 0;
}

void Channel::finish() {
  if (ssl_ && SSL_is_init_finished(ssl_.get()) == 1) {
    ERR_clear_error();
    static_cast<void>(SSL_shutdown(ssl_.get()));  // one byte of politeness; it may get lost
  }
  boost::system::error_code error;
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, error);
}

void Channel::close() {
  boost::system::error_code error;
  socket_.close(error);
}

}  // namespace poolhall::net
