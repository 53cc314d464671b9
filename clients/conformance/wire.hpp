// The hostile server's end of the wire: blocking sockets with deadlines, because its scripts go
// straight on from one line to the next. Loopback only.
//
//   Doorway doorway;                                  // 127.0.0.1, a free port
//   std::unique_ptr<Link> link = doorway.take();      // once doorway.descriptor() is readable
//   link->send(line, Pace::byte_by_byte);
//   Link::Got got = link->take_line();
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/framing.hpp"

namespace poolhall::conformance {

enum class Pace : std::uint8_t {
  whole,         // a line is one segment, if the system likes it so
  byte_by_byte,  // each byte a segment of its own
  crumbs,        // segments of seven bytes, across characters and numbers
};

class Link {
 public:
  enum class Kind : std::uint8_t {
    nothing,  // no complete line yet
    line,
    too_long,  // the line is longer than the limit
    closed,    // by the other end; no line will come any more
  };
  struct Got {
    Kind kind = Kind::nothing;
    std::string line{};
  };

  explicit Link(int descriptor, std::size_t line_limit);
  ~Link();  // closes
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  void set_line_limit(std::size_t limit) { splitter_.set_limit(limit); }
  // Reads what there is; never blocks.
  [[nodiscard]] Got take_line();
  // False if the other end is gone or does not read for ten seconds.
  bool send(std::string_view bytes, Pace pace);
  // Ends as a server does that stops: the other end gets all that was sent and then the end of the
  // stream. Closing at once would take both from it (RST) where a line of its own is still unread.
  void finish();
  // Closes with RST instead of FIN.
  void reset();

 private:
  bool send_all(std::string_view bytes);

  int descriptor_;
  protocol::LineSplitter splitter_;
  std::vector<char> chunk_;
  std::string_view rest_;  // of chunk_, read and not yet split
};

class Doorway {
 public:
  // Throws std::runtime_error if there is no port.
  Doorway();
  ~Doorway();
  Doorway(const Doorway&) = delete;
  Doorway& operator=(const Doorway&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  // The connection that waits; null if none does.
  [[nodiscard]] std::unique_ptr<Link> take(std::size_t line_limit);
  // Connections are refused from now on; the port stays ours.
  void shut();
  void open();

 private:
  void bind_port();

  int descriptor_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace poolhall::conformance
