// Everything that must happen at a time, on one timer: logins and lines that take too long, flags,
// challenges that expire. Not thread-safe: the network thread's own.
//
//   Deadline deadline = queue.at(steady_clock::now() + 5s, [this] { close("too late"); });
//   deadline.cancel();   // its destructor does the same
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>

namespace poolhall::net {

using SteadyTime = std::chrono::steady_clock::time_point;

class DeadlineQueue;

class Deadline {
 public:
  Deadline() = default;
  Deadline(Deadline&& other) noexcept;
  Deadline& operator=(Deadline&& other) noexcept;
  ~Deadline();

  void cancel();
  [[nodiscard]] bool is_set() const { return queue_ != nullptr; }

 private:
  friend class DeadlineQueue;
  using Key = std::pair<SteadyTime, std::uint64_t>;
  Deadline(DeadlineQueue& queue, Key key) : queue_(&queue), key_(key) {}

  DeadlineQueue* queue_ = nullptr;
  Key key_{};
};

// Outlives the deadlines it gave.
class DeadlineQueue {
 public:
  explicit DeadlineQueue(boost::asio::io_context& io) : timer_(io) {}

  // `action` runs on the network thread, not before `when`; once at most.
  [[nodiscard]] Deadline at(SteadyTime when, std::function<void()> action);
  // Forgets all; nothing runs any more.
  void clear();

 private:
  friend class Deadline;
  void arm();
  void run_due();

  boost::asio::steady_timer timer_;
  std::map<Deadline::Key, std::function<void()>> actions_;
  std::uint64_t next_ = 0;
  SteadyTime armed_for_ = SteadyTime::max();
};

}  // namespace poolhall::net
