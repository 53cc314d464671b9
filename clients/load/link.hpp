// One of many thousand connections: lines in, lines out, as little memory and time as it takes. It
// waits until bytes are there and reads them into a buffer that all share.
//
//   auto link = std::make_shared<Link>(io, traffic);
//   link->open(endpoint, {.on_open = ..., .on_line = ..., .on_end = ...});
//   link->send(line);
//
// All of it happens on the io_context's one thread.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/framing.hpp"

namespace poolhall::load {

// What all links of a run have in common; outlives them.
struct Traffic {
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t lines_in = 0;
  std::uint64_t lines_out = 0;
  std::vector<char> scratch = std::vector<char>(256 * 1024);
};

class Link : public std::enable_shared_from_this<Link> {
 public:
  struct Handler {
    std::function<void()> on_open;
    std::function<void(std::string_view line)> on_line;
    // Once, whoever ended it; not from within send or close.
    std::function<void(const std::string& why)> on_end;
  };

  Link(boost::asio::io_context& io, Traffic& traffic);

  void open(const boost::asio::ip::tcp::endpoint& server, Handler handler);
  // With its end. What is sent after the end is dropped.
  void send(std::string line);
  void close();
  [[nodiscard]] bool is_open() const { return open_; }

 private:
  void await_bytes();
  void read();
  void await_room();
  // What the socket takes now.
  void write();
  void end(const std::string& why);

  boost::asio::ip::tcp::socket socket_;
  Traffic& traffic_;
  Handler handler_;
  protocol::LineSplitter splitter_;
  std::string out_;  // not yet taken by the socket
  bool open_ = false;
  bool writing_ = false;
  bool ended_ = false;
};

}  // namespace poolhall::load
