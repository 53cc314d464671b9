#include "clients/load/link.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <utility>

#include "protocol/limits.hpp"

namespace poolhall::load {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

bool must_wait(const boost::system::error_code& error) {
  return error == asio::error::would_block || error == asio::error::try_again;
}

}  // namespace

Link::Link(asio::io_context& io, Traffic& traffic)
    : socket_(io), traffic_(traffic), splitter_(protocol::Limits{}.server_line_bytes) {}

void Link::open(const tcp::endpoint& server, Handler handler) {
  handler_ = std::move(handler);
  socket_.async_connect(server,
                        [self = shared_from_this()](const boost::system::error_code& error) {
                          if (error) {
                            self->end("cannot connect: " + error.message());
                            return;
                          }
                          boost::system::error_code ignored;
                          self->socket_.non_blocking(true, ignored);
                          self->socket_.set_option(tcp::no_delay(true), ignored);
                          self->open_ = true;
                          self->handler_.on_open();
                          self->await_bytes();
                        });
}

void Link::send(std::string line) {
  if (!open_) {
    return;
  }
  traffic_.bytes_out += line.size();
  ++traffic_.lines_out;
  if (out_.empty()) {
    out_ = std::move(line);
  } else {
    out_ += line;
  }
  if (!writing_) {
    write();
  }
}

void Link::close() {
  boost::system::error_code ignored;
  open_ = false;
  socket_.close(ignored);
}

void Link::await_bytes() {
  if (!open_) {
    return;
  }
  socket_.async_wait(tcp::socket::wait_read,
                     [self = shared_from_this()](const boost::system::error_code& error) {
                       if (error) {
                         self->end(error.message());
                         return;
                       }
                       self->read();
                       self->await_bytes();
                     });
}

void Link::read() {
  boost::system::error_code error;
  const std::size_t count = socket_.read_some(asio::buffer(traffic_.scratch), error);
  if (error) {
    if (!must_wait(error)) {
      end(error == asio::error::eof ? "ended by the server" : error.message());
    }
    return;
  }
  traffic_.bytes_in += count;
  for (std::string_view rest(traffic_.scratch.data(), count); !rest.empty() && open_;) {
    const auto step = splitter_.next(rest);
    rest = step.rest;
    if (step.kind == protocol::LineSplitter::Kind::line) {
      ++traffic_.lines_in;
      handler_.on_line(step.line);
    } else if (step.kind == protocol::LineSplitter::Kind::too_long) {
      end("the server sent a line beyond its own limit");
    }
  }
}

void Link::write() {
  boost::system::error_code error;
  const std::size_t count = socket_.write_some(asio::buffer(out_), error);
  if (error && !must_wait(error)) {
    // The reading side hears of it too, and of what the server said before.
    out_.clear();
    return;
  }
  out_.erase(0, count);
  if (!out_.empty()) {
    await_room();
  }
}

void Link::await_room() {
  writing_ = true;
  socket_.async_wait(tcp::socket::wait_write,
                     [self = shared_from_this()](const boost::system::error_code& error) {
                       self->writing_ = false;
                       if (!error && self->open_) {
                         self->write();
                       }
                     });
}

void Link::end(const std::string& why) {
  close();
  if (std::exchange(ended_, true)) {
    return;
  }
  asio::post(socket_.get_executor(), [self = shared_from_this(), why] {
    if (self->handler_.on_end) {
      self->handler_.on_end(why);
    }
    self->handler_ = {};
  });
}

}  // namespace poolhall::load
