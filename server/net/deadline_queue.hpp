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
#include <memory>
#include <utility>

namespace poolhall::net {

using SteadyTime = std::chrono::steady_clock::time_point;

class DeadlineQueue;

// May outlive its queue.
class Deadline {
 public:
  Deadline() = default;
  Deadline(Deadline&& other) noexcept = default;
  Deadline& operator=(Deadline&& other) noexcept;
  ~Deadline();

  void cancel();
  // Given and not cancelled; it may have run.
  [[nodiscard]] bool is_set() const { return !actions_.expired(); }

 private:
  friend class DeadlineQueue;
  using Key = std::pair<SteadyTime, std::uint64_t>;
  using Actions = std::map<Key, std::function<void()>>;
  Deadline(std::weak_ptr<Actions> actions, Key key) : actions_(std::move(actions)), key_(key) {}

  std::weak_ptr<Actions> actions_;
  Key key_{};
};

class DeadlineQueue {
 public:
  explicit DeadlineQueue(boost::asio::io_context& io) : timer_(io) {}

  // `action` runs on the network thread, not before `when`; once at most.
  [[nodiscard]] Deadline at(SteadyTime when, std::function<void()> action);

 private:
  void arm();
  void run_due();

  boost::asio::steady_timer timer_;
  std::shared_ptr<Deadline::Actions> actions_ = std::make_shared<Deadline::Actions>();
  std::uint64_t next_ = 0;
  SteadyTime armed_for_ = SteadyTime::max();
};

}  // namespace poolhall::net
