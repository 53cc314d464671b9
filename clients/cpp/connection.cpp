#include "clients/cpp/connection.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include <utility>

namespace poolhall::client {

namespace asio = boost::asio;

Connection::Connection(asio::any_io_executor executor, std::unique_ptr<Transport> transport,
                       std::size_t line_limit)
    : executor_(std::move(executor)), transport_(std::move(transport)), splitter_(line_limit) {}

void Connection::send(std::string line) {
  if (!is_open_) {
    return;
  }
  output_.push_back(std::move(line));
  if (!is_writing_) {
    is_writing_ = true;
    asio::co_spawn(executor_, drain(shared_from_this()), asio::detached);
  }
}

asio::awaitable<void> Connection::drain(std::shared_ptr<Connection> self) {
  while (self->is_open_ && !self->output_.empty()) {
    const std::string line = std::move(self->output_.front());
    self->output_.pop_front();
    if (!co_await self->transport_->write(line)) {
      self->close();
    }
  }
  self->is_writing_ = false;
}

asio::awaitable<tl::expected<std::string, ConnectionError>> Connection::read_line() {
  while (true) {
    while (!rest_.empty()) {
      const auto step = splitter_.next(rest_);
      rest_ = step.rest;
      if (step.kind == protocol::LineSplitter::Kind::line) {
        co_return std::string(step.line);
      }
      if (step.kind == protocol::LineSplitter::Kind::too_long) {
        co_return tl::unexpected(ConnectionError{"the server sent a line beyond its own limit"});
      }
    }
    const auto count = co_await transport_->read_some(chunk_);
    if (!count) {
      co_return tl::unexpected(count.error());
    }
    rest_ = {chunk_.data(), *count};
  }
}

void Connection::close() {
  is_open_ = false;
  transport_->close();
}

}  // namespace poolhall::client
