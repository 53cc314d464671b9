// One agent's socket: lines in, a bounded queue of lines out, and an end with a stated reason.
// It knows nothing of what the lines mean.
//
//   auto connection = std::make_shared<Connection>(std::move(channel), id, context);
//   connection->start(session);          // lines go to session.on_line
//   connection->send(line);              // never blocks
//   connection->close(last_line, "superseded");
//
// The network thread's own. An idle connection holds no buffer: it waits until bytes are there and
// reads them into one that all share.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/framing.hpp"
#include "protocol/limits.hpp"
#include "server/net/channel.hpp"
#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

enum class ConnectionId : std::uint64_t {};
[[nodiscard]] constexpr std::uint64_t number(ConnectionId id) {
  return static_cast<std::uint64_t>(id);
}

// A line with its "\n", shared by all who get it.
using Line = std::shared_ptr<const std::string>;

// What all connections of a server have in common; outlives them.
struct ConnectionContext {
  const protocol::Limits& limits;
  DeadlineQueue& deadlines;
  // How long a connection whose input is over may wait for answers to what was asked.
  std::chrono::milliseconds last_answers{10'000};
  // Of all connections; theirs too, for the last of them may outlive the rest.
  std::shared_ptr<std::size_t> queued_bytes = std::make_shared<std::size_t>(0);
  std::vector<char> scratch = std::vector<char>(64 * 1024);
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  // Who hears the lines. Not called after `closed`, nor before `start` has returned.
  class Handler {
   public:
    virtual ~Handler() = default;
    virtual void on_line(std::string_view line, SteadyTime read_at) = 0;
    virtual void on_line_too_long() = 0;
    virtual void on_line_too_slow() = 0;
    virtual void on_output_unread() = 0;  // may close with a last line
    virtual void on_input_over() = 0;     // no line comes any more
    // What keeps a connection open, for a while, whose input is over.
    [[nodiscard]] virtual bool owes_answers() const = 0;
    virtual void on_closed(std::string_view why) = 0;  // once, never from within send or close
  };

  Connection(Channel channel, ConnectionId id, ConnectionContext& context);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start(std::weak_ptr<Handler> handler);
  void send(Line line);
  // Sends what is queued and `last`, then ends. Lines that come in later are not read.
  void close(Line last, std::string why);
  // Ends at once.
  void abort(std::string why);
  // Reads now what has arrived until now, before something else is decided by the clock.
  void read_arrived();

  void set_line_limit(std::size_t bytes) { splitter_.set_limit(bytes); }
  [[nodiscard]] ConnectionId id() const { return id_; }
  [[nodiscard]] const std::string& peer() const { return peer_; }
  [[nodiscard]] const boost::asio::ip::address& address() const { return address_; }
  [[nodiscard]] bool open() const { return state_ == State::open; }
  [[nodiscard]] std::size_t queued_bytes() const { return queued_bytes_; }
  // Called when the socket is gone; for whoever counts sockets.
  void on_gone(std::function<void()> action) { on_gone_ = std::move(action); }

 private:
  enum class State : std::uint8_t { open, closing, closed };

  boost::asio::awaitable<void> read_loop(std::shared_ptr<Connection> self);
  boost::asio::awaitable<void> write_loop(std::shared_ptr<Connection> self);
  void read_once();
  // Until it has sent no more than it may have.
  [[nodiscard]] bool is_ahead_of_its_pace() const;
  boost::asio::awaitable<void> keep_pace();
  void pay_for(std::size_t bytes);
  [[nodiscard]] std::chrono::nanoseconds time_for(std::size_t bytes) const;
  [[nodiscard]] bool has_room_for(std::size_t bytes) const;
  void count_queued(std::size_t bytes);
  void count_unqueued(std::size_t bytes);
  void take(std::string_view bytes, SteadyTime read_at);
  void watch_line();
  void end_input();
  void end_within(std::chrono::milliseconds time);
  void schedule_flush();
  void watch_delivery();
  void check_delivery();
  void flush();
  // What the socket takes now; false when it is full or broken.
  [[nodiscard]] bool write_some();
  void written(std::size_t bytes);
  void drop_unsent();
  void finish_sending();
  void tell_closed(std::string why);
  void close_socket();

  Channel channel_;
  ConnectionId id_;
  std::string peer_;
  boost::asio::ip::address address_;
  ConnectionContext& context_;
  std::weak_ptr<Handler> handler_;
  protocol::LineSplitter splitter_;
  Deadline line_deadline_;
  Deadline end_deadline_;
  Deadline delivery_check_;
  std::deque<Line> out_;
  std::size_t out_offset_ = 0;  // bytes of out_.front() that the socket has taken
  std::size_t queued_bytes_ = 0;
  std::shared_ptr<std::size_t> queued_in_all_;
  SteadyTime paid_until_{};  // what has been read is within the rate from then on
  SteadyTime end_at_most_ = SteadyTime::max();  // when it closes
  State state_ = State::open;
  bool input_over_ = false;  // the peer has closed its sending half
  bool flush_pending_ = false;
  bool writing_ = false;       // write_loop runs
  bool awaits_input_ = false;  // TLS cannot write before it has read
  bool awaits_room_ = false;   // nor read before it has written
  bool patient_ = false;       // the peer reads nothing and its system says that it lives
  std::function<void()> on_gone_;
};

}  // namespace poolhall::net
