#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

Deadline::Deadline(Deadline&& other) noexcept
    : queue_(std::exchange(other.queue_, nullptr)), key_(other.key_) {}

Deadline& Deadline::operator=(Deadline&& other) noexcept {
  if (this != &other) {
    cancel();
    queue_ = std::exchange(other.queue_, nullptr);
    key_ = other.key_;
  }
  return *this;
}

Deadline::~Deadline() {
  cancel();
}

void Deadline::cancel() {
  if (queue_ != nullptr) {
    queue_->actions_.erase(key_);
    queue_ = nullptr;
  }
}

Deadline DeadlineQueue::at(SteadyTime when, std::function<void()> action) {
  const Deadline::Key key{when, next_++};
  actions_.emplace(key, std::move(action));
  if (when < armed_for_) {
    arm();
  }
  return Deadline{*this, key};
}

void DeadlineQueue::clear() {
  actions_.clear();
  armed_for_ = SteadyTime::max();
  timer_.cancel();
}

void DeadlineQueue::arm() {
  // A cancelled deadline leaves the timer set: it then wakes for nothing once.
  armed_for_ = actions_.empty() ? SteadyTime::max() : actions_.begin()->first.first;
  if (actions_.empty()) {
    return;
  }
  timer_.expires_at(armed_for_);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      run_due();
    }
  });
}

void DeadlineQueue::run_due() {
  armed_for_ = SteadyTime::min();  // `at` leaves the arming to the end of this function
  const SteadyTime now = std::chrono::steady_clock::now();
  while (!actions_.empty() && actions_.begin()->first.first <= now) {
    auto node = actions_.extract(actions_.begin());
    node.mapped()();
  }
  arm();
}

}  // namespace poolhall::net
