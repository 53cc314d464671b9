#include "tests/bench/server/audience.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace poolhall::bench {

namespace asio = boost::asio;
using asio::ip::tcp;
using std::chrono::steady_clock;

namespace {

constexpr std::chrono::seconds patience{60};
constexpr int niceness = 10;
constexpr rlim_t descriptors_besides = 256;

// Counts a server's frames (RFC 6455: never masked), without keeping what is in them.
class FrameCounter {
 public:
  // Calls `whole` at the end of each text frame.
  template <class Whole>
  void take(const char* bytes, std::size_t count, Whole whole) {
    for (std::size_t at = 0; at < count;) {
      if (left_ > 0) {
        const auto skipped = std::min<std::uint64_t>(left_, count - at);
        left_ -= skipped;
        at += skipped;
      } else {
        head_[held_++] = static_cast<unsigned char>(bytes[at++]);
        if (held_ < 2 || held_ < head_bytes()) {
          continue;
        }
        left_ = payload();
        held_ = 0;
      }
      if (left_ == 0 && (head_[0] & 0x0FU) == 1) {
        whole();
      }
    }
  }

 private:
  [[nodiscard]] std::size_t head_bytes() const {
    const unsigned length = head_[1] & 0x7FU;
    return length == 127 ? 10 : length == 126 ? 4 : 2;
  }
  [[nodiscard]] std::uint64_t payload() const {
    if (head_bytes() == 2) {
      return head_[1] & 0x7FU;
    }
    std::uint64_t length = 0;
    for (std::size_t i = 2; i < head_bytes(); ++i) {
      length = length << 8U | head_[i];
    }
    return length;
  }

  std::array<unsigned char, 10> head_{};
  std::size_t held_ = 0;
  std::uint64_t left_ = 0;
};

}  // namespace

class Audience::Room {
 public:
  Room(std::uint16_t port, std::int64_t game, std::uint32_t count)
      : server_(asio::ip::address_v4::loopback(), port),
        request_("GET /ws/games/" + std::to_string(game) +
                 " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                 "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                 "Sec-WebSocket-Key: cG9vbGhhbGwgc3BlY3Rhbg==\r\n\r\n") {
    raise_descriptors(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      seats_.push_back(std::make_unique<Seat>(io_));
    }
    thread_ = std::thread([this] {
      static_cast<void>(::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + niceness));
      for (const auto& seat : seats_) {
        enter(*seat);
      }
      io_.run();
    });
    if (all_in_.get_future().wait_for(patience) != std::future_status::ready) {
      close();
      throw std::runtime_error("not all spectators had a snapshot after a minute");
    }
  }
  ~Room() { close(); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  void close() {
    if (thread_.joinable()) {
      io_.stop();
      thread_.join();
    }
  }

  [[nodiscard]] Told told() const {
    Told told;
    told.gone = gone_;
    told.bytes = bytes_;
    told.fewest = ~std::uint64_t{0};
    for (const auto& seat : seats_) {
      told.fewest = std::min(told.fewest, seat->turns);
      told.most = std::max(told.most, seat->turns);
    }
    std::vector<double> spreads;
    for (const Turn& turn : turns_) {
      if (turn.heard == seats_.size()) {
        spreads.push_back(
            std::chrono::duration<double, std::milli>(turn.last - turn.first).count());
      }
    }
    if (!spreads.empty()) {
      std::sort(spreads.begin(), spreads.end());
      told.median_spread_ms = spreads[spreads.size() / 2];
      told.longest_spread_ms = spreads.back();
    }
    return told;
  }

 private:
  struct Seat {
    explicit Seat(asio::io_context& io) : socket(io) {}
    tcp::socket socket;
    std::string head;  // of the handshake's answer, until it is whole
    bool is_open = false;
    bool has_snapshot = false;
    FrameCounter frames;
    std::uint64_t turns = 0;
  };
  struct Turn {
    steady_clock::time_point first;
    steady_clock::time_point last;
    std::size_t heard = 0;
  };

  static void raise_descriptors(std::uint32_t count) {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = std::max<rlim_t>(limit.rlim_cur, count + descriptors_besides);
    limit.rlim_max = std::max(limit.rlim_max, limit.rlim_cur);
    if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) {
      throw std::runtime_error("too few file descriptors for the spectators (ulimit -n)");
    }
  }

  void enter(Seat& seat) {
    seat.socket.async_connect(server_, [this, &seat](const boost::system::error_code& error) {
      if (error) {
        ++gone_;
        return;
      }
      asio::async_write(seat.socket, asio::buffer(request_),
                        [this, &seat](const boost::system::error_code& failed, std::size_t) {
                          if (!failed) {
                            read(seat);
                          }
                        });
    });
  }

  void read(Seat& seat) {
    seat.socket.async_wait(tcp::socket::wait_read, [this,
                                                    &seat](const boost::system::error_code& error) {
      boost::system::error_code failed = error;
      const std::size_t got = failed ? 0 : seat.socket.read_some(asio::buffer(bytes_read_), failed);
      if (failed) {
        ++gone_;
        return;
      }
      take(seat, got);
      read(seat);
    });
  }

  void take(Seat& seat, std::size_t got) {
    bytes_ += got;
    const char* bytes = bytes_read_.data();
    if (!seat.is_open) {
      const std::size_t before = seat.head.size();
      seat.head.append(bytes, got);
      const auto end = seat.head.find("\r\n\r\n");
      if (end == std::string::npos) {
        return;
      }
      seat.is_open = true;
      bytes += end + 4 - before;
      got -= end + 4 - before;
    }
    seat.frames.take(bytes, got, [this, &seat] { heard(seat); });
  }

  void heard(Seat& seat) {
    if (!seat.has_snapshot) {
      seat.has_snapshot = true;
      if (++seated_ == seats_.size()) {
        for (const auto& other : seats_) {
          other->turns = 0;
        }
        turns_.clear();
        bytes_ = 0;
        all_in_.set_value();
      }
      return;
    }
    ++seat.turns;
    if (turns_.size() < seat.turns) {
      turns_.resize(seat.turns, {steady_clock::now(), {}, 0});
    }
    Turn& turn = turns_[seat.turns - 1];
    turn.last = steady_clock::now();
    ++turn.heard;
  }

  asio::io_context io_{1};
  tcp::endpoint server_;
  std::string request_;
  std::vector<std::unique_ptr<Seat>> seats_;
  std::array<char, 64 * 1024> bytes_read_{};
  std::vector<Turn> turns_;
  std::size_t seated_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t gone_ = 0;
  std::promise<void> all_in_;
  std::thread thread_;
};

Audience::Audience(std::uint16_t port, std::int64_t game, std::uint32_t count)
    : room_(std::make_unique<Room>(port, game, count)) {}

Audience::~Audience() = default;

Audience::Told Audience::leave() {
  room_->close();
  return room_->told();
}

}  // namespace poolhall::bench
