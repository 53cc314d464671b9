#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

Deadline& Deadline::operator=(Deadline&& other) noexcept {
  if (this != &other) {
    cancel();
    actions_ = std::move(other.actions_);
    key_ = other.key_;
  }
  return *this;
}

Deadline::~Deadline() {
  cancel();
}

void Deadline::cancel() {
  if (const auto actions = actions_.lock()) {
    // What the action holds may own this deadline: let go of it last.
    const auto action = actions->extract(key_);
  }
  actions_.reset();
}

Deadline DeadlineQueue::at(SteadyTime when, std::function<void()> action) {
  const Deadline::Key key{when, next_++};
  actions_->emplace(key, std::move(action));
  if (when < armed_for_) {
    arm();
  }
  return Deadline{actions_, key};
}

void DeadlineQueue::arm() {
  // A cancelled deadline leaves the timer set: it then wakes for nothing once.
  armed_for_ = actions_->empty() ? SteadyTime::max() : actions_->begin()->first.first;
  if (actions_->empty()) {
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
  while (!actions_->empty() && actions_->begin()->first.first <= now) {
    const auto node = actions_->extract(actions_->begin());
    node.mapped()();
  }
  arm();
}

}  // namespace poolhall::net
