#include "clients/conformance/wire.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace poolhall::conformance {
namespace {

constexpr int unread_ms = 10'000;
constexpr int backlog = 16;
// For the other end to close too.
constexpr std::chrono::seconds farewell{1};
constexpr std::size_t crumb = 7;
// Between two segments: long enough that a reader sees them apart, now and then.
constexpr std::chrono::microseconds segment_pause{20};

}  // namespace

Link::Link(int descriptor, std::size_t line_limit)
    : descriptor_(descriptor), splitter_(line_limit), chunk_(64 * std::size_t{1024}) {
  const int on = 1;
  ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

Link::~Link() {
  ::close(descriptor_);
}

Link::Got Link::take_line() {
  while (true) {
    while (!rest_.empty()) {
      const auto step = splitter_.next(rest_);
      rest_ = step.rest;
      if (step.kind == protocol::LineSplitter::Kind::line) {
        return {Kind::line, std::string(step.line)};
      }
      if (step.kind == protocol::LineSplitter::Kind::too_long) {
        return {Kind::too_long, {}};
      }
    }
    const ssize_t count = ::recv(descriptor_, chunk_.data(), chunk_.size(), MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      return {};
    }
    if (count <= 0) {
      return {Kind::closed, {}};
    }
    rest_ = {chunk_.data(), static_cast<std::size_t>(count)};
  }
}

bool Link::send(std::string_view bytes, Pace pace) {
  if (pace == Pace::whole) {
    return send_all(bytes);
  }
  const std::size_t step = pace == Pace::crumbs ? crumb : 1;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(step, bytes.size()))) {
    if (!send_all(bytes.substr(0, step))) {
      return false;
    }
    std::this_thread::sleep_for(segment_pause);
  }
  return true;
}

bool Link::send_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd writable{descriptor_, POLLOUT, 0};
      if (::poll(&writable, 1, unread_ms) == 0) {
        return false;
      }
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void Link::finish() {
  ::shutdown(descriptor_, SHUT_WR);
  const auto deadline = std::chrono::steady_clock::now() + farewell;
  while (true) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd readable{descriptor_, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&readable, 1, static_cast<int>(left.count())) <= 0 ||
        ::recv(descriptor_, chunk_.data(), chunk_.size(), MSG_DONTWAIT) <= 0) {
      return;
    }
  }
}

void Link::reset() {
  const linger at_once{1, 0};
  ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
}

Doorway::Doorway() {
  bind_port();
  open();
}

Doorway::~Doorway() {
  ::close(descriptor_);
}

void Doorway::bind_port() {
  descriptor_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port_);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const name = reinterpret_cast<sockaddr*>(&address);
  if (descriptor_ < 0 || ::bind(descriptor_, name, size) != 0 ||
      ::getsockname(descriptor_, name, &size) != 0) {
    throw std::runtime_error("no port of 127.0.0.1 can be had");
  }
  port_ = ntohs(address.sin_port);
}

void Doorway::open() {
  if (::listen(descriptor_, backlog) != 0) {
    throw std::runtime_error("a port of 127.0.0.1 cannot be listened on");
  }
  ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) | O_NONBLOCK);
}

void Doorway::shut() {
  ::close(descriptor_);
  bind_port();  // bound and not listening: who comes is refused, and nobody else gets the port
}

std::unique_ptr<Link> Doorway::take(std::size_t line_limit) {
  const int connection = ::accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC);
  return connection < 0 ? nullptr : std::make_unique<Link>(connection, line_limit);
}

}  // namespace poolhall::conformance
