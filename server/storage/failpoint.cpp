#include "server/storage/failpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string>
#include <utility>

#include "physics/words.hpp"

namespace poolhall::storage {
namespace {

constexpr physics::Words<Failpoint, 5> places{{
    {Failpoint::after_receive, "after_receive"},
    {Failpoint::after_simulate, "after_simulate"},
    {Failpoint::before_commit, "before_commit"},
    {Failpoint::after_commit, "after_commit"},
    {Failpoint::before_send, "before_send"},
}};

// What the environment asks for: the process dies at the `passes`-th time at `place`.
struct Order {
  std::optional<Failpoint> place{};
  std::uint64_t passes = 1;
};

Order order_from_environment() {
  const char* text = std::getenv("POOLHALL_FAILPOINT");
  if (text == nullptr)
    return {};
  const std::string_view whole(text);
  const std::size_t colon = whole.find(':');
  Order order{failpoint_named(whole.substr(0, colon)), 1};
  if (colon != std::string_view::npos) {
    const std::string_view count = whole.substr(colon + 1);
    std::from_chars(count.data(), count.data() + count.size(), order.passes);
  }
  return order;
}

void count_hit(Failpoint place) {
  const char* file = std::getenv("POOLHALL_FAILPOINT_COUNT");
  if (file == nullptr)
    return;
  const int descriptor = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor < 0)
    return;
  const std::string line = std::string(name(place)) + "\n";
  if (write(descriptor, line.data(), line.size()) < 0)
    perror("POOLHALL_FAILPOINT_COUNT");
  close(descriptor);
}

std::mutex handler_mutex;
std::function<void(Failpoint)> handler;
std::atomic<bool> has_handler{false};

}  // namespace

std::string_view name(Failpoint place) {
  return physics::word_of(places, place);
}

std::optional<Failpoint> failpoint_named(std::string_view name) {
  return physics::value_of(places, name);
}

void failpoint(Failpoint place) {
  static const Order order = order_from_environment();
  static std::atomic<std::uint64_t> passes{0};
  if (has_handler.load(std::memory_order_relaxed)) {
    const std::lock_guard lock(handler_mutex);
    if (handler)
      handler(place);
    return;
  }
  if (order.place != place || ++passes != order.passes)
    return;
  count_hit(place);
  std::raise(SIGKILL);
}

void set_failpoint_handler(std::function<void(Failpoint)> new_handler) {
  const std::lock_guard lock(handler_mutex);
  handler = std::move(new_handler);
  has_handler = static_cast<bool>(handler);
}

}  // namespace poolhall::storage
