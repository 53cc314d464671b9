#include "server/net/connection.hpp"

#include <netinet/tcp.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <cmath>
#include <span>

#include "server/meter/work_meter.hpp"
#include "server/net/awaited.hpp"
#include "server/net/socket_options.hpp"

namespace poolhall::net {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::size_t lines_in_one_write = 64;
constexpr std::size_t tls_record = 16 * 1024;  // the most that one holds
// How long the peer of an ended connection may take to read some more of its last lines, or to send
// some more of what it was about to send before it reads them; at most
// ConnectionContext::last_answers for all.
constexpr std::chrono::seconds linger{2};
// A peer that does not read closes its window, and its system answers the probes of it, at most
// two minutes apart.
constexpr std::chrono::seconds longest_probe_pause{150};
// What any connection may leave unread, however much all leave together.
constexpr std::size_t fair_share = 64 * 1024;
constexpr const char* ended = "the connection has ended";

}  // namespace

Connection::Connection(Channel channel, ConnectionId id, ConnectionContext& context)
    : channel_(std::move(channel)),
      id_(id),
      peer_(peer_name(channel_.socket())),
      address_(peer_address(channel_.socket())),
      context_(context),
      splitter_(context.limits.line_bytes_before_login),
      queued_in_all_(context.queued_bytes) {}

Connection::~Connection() {
  on_gone_ = nullptr;  // whoever counted may be gone by now
  close_socket();
}

void Connection::start(std::weak_ptr<Handler> handler) {
  handler_ = std::move(handler);
  set_agent_options(channel_.socket(), context_.limits.tcp_user_timeout);
  asio::co_spawn(channel_.socket().get_executor(), read_loop(shared_from_this()), asio::detached);
}

void Connection::send(Line line) {
  if (state_ != State::open) {
    return;
  }
  if (!has_room_for(line->size())) {
    drop_unsent();
    if (const auto handler = handler_.lock()) {
      handler->on_output_unread();
    }
    if (state_ == State::open) {
      abort("its output is not read");
    }
    return;
  }
  count_queued(line->size());
  out_.push_back(std::move(line));
  schedule_flush();
}

bool Connection::has_room_for(std::size_t bytes) const {
  const std::size_t queued = queued_bytes_ + bytes;
  const protocol::Limits& limits = context_.limits;
  return queued <= limits.output_queue_bytes &&
         (queued <= fair_share || *queued_in_all_ + bytes <= limits.output_bytes_in_all);
}

void Connection::count_queued(std::size_t bytes) {
  queued_bytes_ += bytes;
  *queued_in_all_ += bytes;
}

void Connection::count_unqueued(std::size_t bytes) {
  queued_bytes_ -= bytes;
  *queued_in_all_ -= bytes;
}

void Connection::close(Line last, std::string why) {
  if (state_ != State::open) {
    return;
  }
  state_ = State::closing;
  line_deadline_.cancel();
  count_queued(last->size());
  out_.push_back(std::move(last));
  tell_closed(std::move(why));
  end_at_most_ = std::chrono::steady_clock::now() + context_.last_answers;
  end_within(linger);
  schedule_flush();
}

void Connection::end_within(std::chrono::milliseconds time) {
  const SteadyTime end = std::min(std::chrono::steady_clock::now() + time, end_at_most_);
  end_deadline_ = context_.deadlines.at(end, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->abort("its last lines were not ready, or not read, in time");
    }
  });
}

void Connection::abort(std::string why) {
  if (state_ == State::open) {
    tell_closed(std::move(why));
  }
  close_socket();
}

void Connection::read_arrived() {
  boost::system::error_code error;
  std::size_t arrived = channel_.socket().available(error);
  if (channel_.has_unread()) {
    arrived = std::max(arrived, tls_record);
  }
  // TLS gives fewer bytes than arrive: it then says that there are no more.
  std::vector<char> buffer(std::min<std::size_t>(arrived, 64 * 1024));
  while (!error && arrived > 0 && state_ == State::open) {
    const Channel::Result got = channel_.read({buffer.data(), std::min(arrived, buffer.size())});
    if (got.state != Channel::State::done) {
      return;
    }
    pay_for(got.bytes);
    take({buffer.data(), got.bytes}, std::chrono::steady_clock::now());
    arrived -= got.bytes;
  }
}

asio::awaitable<void> Connection::read_loop(std::shared_ptr<Connection> self) {
  while (channel_.socket().is_open() && !input_over_) {
    if (channel_.has_unread()) {
      co_await asio::post(channel_.socket().get_executor(), asio::use_awaitable);
    } else {
      const auto what = awaits_room_ ? tcp::socket::wait_write : tcp::socket::wait_read;
      const auto [error] = co_await channel_.socket().async_wait(what, awaited);
      if (error) {
        abort(ended);
      }
    }
    if (channel_.socket().is_open()) {
      read_once();
    }
    if (channel_.socket().is_open() && is_ahead_of_its_pace()) {
      co_await keep_pace();
    }
  }
  static_cast<void>(self);
}

// Reading costs more than sending: who sends without an end waits, not the others.
asio::awaitable<void> Connection::keep_pace() {
  asio::steady_timer pause(channel_.socket().get_executor(),
                           paid_until_ - time_for(context_.limits.input_burst_bytes));
  co_await pause.async_wait(awaited);
}

bool Connection::is_ahead_of_its_pace() const {
  return paid_until_ - std::chrono::steady_clock::now() >
         time_for(context_.limits.input_burst_bytes);
}

void Connection::pay_for(std::size_t bytes) {
  paid_until_ = std::max(paid_until_, std::chrono::steady_clock::now()) + time_for(bytes);
}

std::chrono::nanoseconds Connection::time_for(std::size_t bytes) const {
  const double seconds =
      static_cast<double>(bytes) / static_cast<double>(context_.limits.input_bytes_per_second);
  return std::chrono::nanoseconds{std::llround(1e9 * seconds)};
}

// One read a turn, so that nobody's flood keeps others waiting.
void Connection::read_once() {
  const Channel::Result got =
      meter::metered(meter::Area::receiving, [this] { return channel_.read(context_.scratch); });
  awaits_room_ = got.state == Channel::State::needs_output;
  if (std::exchange(awaits_input_, false)) {
    schedule_flush();
  }
  pay_for(got.bytes);
  if (got.state == Channel::State::broken) {
    abort(ended);
  } else if (got.state == Channel::State::at_end) {
    end_input();
  } else if (got.state == Channel::State::done && state_ == State::open) {
    take({context_.scratch.data(), got.bytes}, std::chrono::steady_clock::now());
  } else if (got.state == Channel::State::done && state_ == State::closing) {
    end_within(linger);  // what it still sends is read and forgotten
  }
}

// Who sends no more may still read: what it has asked for in whole lines is answered.
void Connection::end_input() {
  input_over_ = true;
  line_deadline_.cancel();
  if (state_ == State::open) {
    end_within(context_.last_answers);
    if (const auto handler = handler_.lock()) {
      handler->on_input_over();
    }
  }
  schedule_flush();
}

void Connection::take(std::string_view bytes, SteadyTime read_at) {
  using Kind = protocol::LineSplitter::Kind;
  while (!bytes.empty() && state_ == State::open) {
    const auto handler = handler_.lock();
    if (!handler) {
      return;
    }
    const protocol::LineSplitter::Step step = splitter_.next(bytes);
    bytes = step.rest;
    if (step.kind == Kind::line) {
      line_deadline_.cancel();
      handler->on_line(step.line, read_at);
    } else if (step.kind == Kind::too_long) {
      handler->on_line_too_long();
    }
  }
  watch_line();
}

void Connection::watch_line() {
  if (!splitter_.inside_line() || state_ != State::open) {
    line_deadline_.cancel();
    return;
  }
  if (line_deadline_.is_set()) {
    return;
  }
  line_deadline_ = context_.deadlines.at(
      std::chrono::steady_clock::now() + context_.limits.line_deadline, [weak = weak_from_this()] {
        const auto self = weak.lock();
        const auto handler = self ? self->handler_.lock() : nullptr;
        if (handler) {
          handler->on_line_too_slow();
        }
      });
}

void Connection::schedule_flush() {
  if (flush_pending_ || writing_) {
    return;
  }
  flush_pending_ = true;
  asio::post(channel_.socket().get_executor(), [self = shared_from_this()] { self->flush(); });
}

// TCP_USER_TIMEOUT ends a connection whose peer acknowledges nothing, dead or not: a bot that
// thinks and does not read keeps its window closed and would be taken for dead. So it is suspended
// while the peer's system answers.
void Connection::watch_delivery() {
  if (delivery_check_.is_set()) {
    return;
  }
  const auto wait = context_.limits.tcp_user_timeout * 3 / 4;
  delivery_check_ =
      context_.deadlines.at(std::chrono::steady_clock::now() + wait, [weak = weak_from_this()] {
        if (const auto self = weak.lock()) {
          self->check_delivery();
        }
      });
}

void Connection::check_delivery() {
  delivery_check_.cancel();
  if (!channel_.socket().is_open()) {
    return;
  }
  const auto timeout = context_.limits.tcp_user_timeout;
  const Delivery delivery = delivery_of(channel_.socket());
  const auto pause = delivery.since_last_acknowledgement;
  if (delivery.unacknowledged_bytes == 0) {
    if (std::exchange(patient_, false)) {
      set_user_timeout(channel_.socket(), timeout);
    }
  } else if (patient_ && pause > longest_probe_pause) {
    abort("the peer's system does not answer any more");
  } else {
    if (!patient_ && pause < timeout * 3 / 4) {
      patient_ = true;
      set_user_timeout(channel_.socket(), std::chrono::milliseconds{0});
    }
    watch_delivery();
  }
}

void Connection::flush() {
  flush_pending_ = false;
  if (writing_ || !channel_.socket().is_open()) {
    return;
  }
  watch_delivery();
  if (write_some()) {
    finish_sending();
  } else if (channel_.socket().is_open() && !awaits_input_) {
    writing_ = true;
    asio::co_spawn(channel_.socket().get_executor(), write_loop(shared_from_this()),
                   asio::detached);
  }
}

asio::awaitable<void> Connection::write_loop(std::shared_ptr<Connection> self) {
  while (channel_.socket().is_open()) {
    const auto [error] = co_await channel_.socket().async_wait(tcp::socket::wait_write, awaited);
    if (error || write_some() || awaits_input_) {
      break;
    }
  }
  writing_ = false;
  if (out_.empty()) {
    finish_sending();
  }
  static_cast<void>(self);
}

bool Connection::write_some() {
  while (!out_.empty()) {
    std::array<asio::const_buffer, lines_in_one_write> buffers;
    std::size_t count = 0;
    for (; count < std::min(buffers.size(), out_.size()); ++count) {
      const std::size_t skip = count == 0 ? out_offset_ : 0;
      buffers[count] = asio::buffer(*out_[count]) + skip;
    }
    const Channel::Result sent = meter::metered(meter::Area::sending, [&] {
      return channel_.write({buffers.data(), count});
    });
    if (sent.state == Channel::State::broken) {
      abort("the connection is broken");
      return false;
    }
    awaits_input_ = sent.state == Channel::State::needs_input;
    if (sent.state != Channel::State::done) {
      return false;
    }
    written(sent.bytes);
  }
  return true;
}

void Connection::written(std::size_t bytes) {
  count_unqueued(bytes);
  if (state_ == State::closing) {
    end_within(linger);
  }
  while (bytes > 0) {
    const std::size_t left = out_.front()->size() - out_offset_;
    if (bytes < left) {
      out_offset_ += bytes;
      return;
    }
    bytes -= left;
    out_offset_ = 0;
    out_.pop_front();
  }
}

// All but the line that has begun: the peer would not find the beginning of the next.
void Connection::drop_unsent() {
  const std::size_t keep = out_offset_ > 0 || channel_.has_unsent() ? 1 : 0;
  out_.resize(keep);
  count_unqueued(queued_bytes_ - (keep == 0 ? 0 : out_.front()->size() - out_offset_));
}

// Ends the sending half; the rest of what the peer sends is read until it ends too, for a socket
// closed with bytes unread resets the connection and takes the last line with it.
void Connection::finish_sending() {
  if (!channel_.socket().is_open()) {
    return;
  }
  const auto handler = handler_.lock();
  const bool is_awaited = state_ == State::open && handler && handler->owes_answers();
  if (state_ == State::closing || (input_over_ && !is_awaited)) {
    channel_.finish();
  }
  if (input_over_ && !is_awaited) {
    abort(ended);
  }
}

void Connection::tell_closed(std::string why) {
  if (state_ == State::open) {
    state_ = State::closing;
  }
  asio::post(channel_.socket().get_executor(), [self = shared_from_this(), why = std::move(why)] {
    if (const auto handler = self->handler_.lock()) {
      handler->on_closed(why);
    }
    self->handler_.reset();
  });
}

void Connection::close_socket() {
  if (state_ == State::closed) {
    return;
  }
  state_ = State::closed;
  line_deadline_.cancel();
  end_deadline_.cancel();
  delivery_check_.cancel();
  channel_.close();
  out_.clear();
  count_unqueued(queued_bytes_);
  if (on_gone_) {
    std::exchange(on_gone_, nullptr)();
  }
}

}  // namespace poolhall::net
