// A connection, plain or by TLS, as one stream: what reads requests and talks to spectators is
// compiled once, which for Beast's templates is half a minute.
//
//   Wire wire{std::move(socket), tls};                 // null: plain
//   if (const auto [failed] = co_await wire.shake_hands(); failed) ...
//   co_await http::async_read(wire, buffer, parser, awaited);
//   co_await wire.part();
#pragma once

#include <array>
#include <boost/asio/any_completion_handler.hpp>
#include <boost/asio/async_result.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace poolhall::web {

class Wire {
 public:
  using executor_type = boost::asio::ip::tcp::socket::executor_type;
  using Error = boost::system::error_code;
  using Moved = boost::asio::any_completion_handler<void(Error, std::size_t)>;
  using Done = boost::asio::any_completion_handler<void(Error)>;

  // `tls` outlives the wire.
  Wire(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls);
  Wire(Wire&& other) noexcept;
  Wire& operator=(Wire&& other) noexcept;
  ~Wire();

  [[nodiscard]] executor_type get_executor();
  // Before anything else; nothing to do on a plain connection.
  [[nodiscard]] boost::asio::awaitable<Error> shake_hands();
  // The same for who calls: the certificate must be good, as `tls` has it, and for this host.
  [[nodiscard]] boost::asio::awaitable<Error> shake_hands_with(std::string host);
  // So that what was said last is not lost with what the other side still sends.
  [[nodiscard]] boost::asio::awaitable<void> part();

  // Of what begins from now on; it then fails with beast::error::timeout.
  void expires_after(std::chrono::milliseconds time);
  void expires_never();
  // What a visitor that does not read costs the system.
  void limit_send_buffer(int bytes);

  // As Asio's AsyncReadStream and AsyncWriteStream have it.
  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(Error, std::size_t)>(
        [this](auto handler, boost::asio::mutable_buffer into) {
          start_reading(into, Moved{std::move(handler)});
        },
        token, first_of(buffers));
  }
  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(Error, std::size_t)>(
        [this](auto handler, const Pieces& pieces) {
          start_writing(pieces, Moved{std::move(handler)});
        },
        token, Pieces{buffers});
  }

  // What a WebSocket asks of the stream below it.
  template <class Handler>
  friend void async_teardown(boost::beast::role_type, Wire& wire, Handler&& handler) {
    wire.start_parting(Done{std::forward<Handler>(handler)});
  }
  friend void teardown(boost::beast::role_type, Wire& wire, Error& error) { wire.shut(error); }
  friend void beast_close_socket(Wire& wire) { wire.close(); }

 private:
  struct Streams;

  // The first buffers of a sequence that have bytes: as many as the system takes at once.
  class Pieces {
   public:
    template <class Buffers>
    explicit Pieces(const Buffers& buffers) {
      const auto end = boost::asio::buffer_sequence_end(buffers);
      for (auto i = boost::asio::buffer_sequence_begin(buffers); i != end && count_ < most; ++i) {
        if (const boost::asio::const_buffer piece = *i; piece.size() > 0) {
          pieces_[count_++] = piece;
        }
      }
    }
    [[nodiscard]] const boost::asio::const_buffer* begin() const { return pieces_.data(); }
    [[nodiscard]] const boost::asio::const_buffer* end() const { return pieces_.data() + count_; }

   private:
    static constexpr std::size_t most = 64;
    std::array<boost::asio::const_buffer, most> pieces_;
    std::size_t count_ = 0;
  };

  template <class Buffers>
  static boost::asio::mutable_buffer first_of(const Buffers& buffers) {
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto i = boost::asio::buffer_sequence_begin(buffers); i != end; ++i) {
      if (const boost::asio::mutable_buffer buffer = *i; buffer.size() > 0) {
        return buffer;
      }
    }
    return {};
  }

  void start_reading(boost::asio::mutable_buffer into, Moved handler);
  void start_writing(const Pieces& pieces, Moved handler);
  void start_parting(Done handler);
  void shut(Error& error);
  void close();

  std::unique_ptr<Streams> streams_;
};

}  // namespace poolhall::web
