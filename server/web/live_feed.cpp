#include "server/web/live_feed.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <utility>
#include <vector>

namespace poolhall::web {

namespace asio = boost::asio;
using std::chrono::steady_clock;

bool Spectator::offer(const Message& message) {
  if (gap_ || left_) {
    return false;
  }
  // One message always fits, however long.
  if (!queue_.empty() && queued_ + message->size() > queue_bytes) {
    queue_.clear();
    queued_ = 0;
    gap_ = true;
    bell_.cancel();
    return false;
  }
  queued_ += message->size();
  queue_.push_back(message);
  bell_.cancel();
  return true;
}

Message Spectator::take() {
  if (queue_.empty()) {
    return nullptr;
  }
  Message message = std::move(queue_.front());
  queue_.pop_front();
  queued_ -= message->size();
  return message;
}

void Spectator::leave() {
  left_ = true;
  queue_.clear();
  queued_ = 0;
  bell_.cancel();
}

LiveFeed::LiveFeed(asio::io_context& io, std::chrono::milliseconds delay, Publisher publisher)
    : io_(io), delay_(delay), publisher_(std::move(publisher)), delay_timer_(io) {}

void LiveFeed::join(const std::shared_ptr<Spectator>& spectator, Topic topic) {
  catch_up(spectator, topic);
}

// One snapshot serves all who wait for it.
void LiveFeed::catch_up(const std::shared_ptr<Spectator>& spectator, Topic topic) {
  Audience& audience = audiences_[topic];
  spectator->forget_gap();
  audience.watching.erase(spectator);
  const bool asked = !audience.waiting.empty();
  audience.waiting.insert(spectator);
  if (!asked) {
    audience.awaited = Ticket{next_ticket_++};
    publisher_.watch(topic, audience.awaited);
  }
}

void LiveFeed::leave(const std::shared_ptr<Spectator>& spectator, Topic topic) {
  const auto found = audiences_.find(topic);
  if (found == audiences_.end()) {
    return;
  }
  found->second.watching.erase(spectator);
  found->second.waiting.erase(spectator);
  if (found->second.watching.empty() && found->second.waiting.empty()) {
    audiences_.erase(found);
    publisher_.unwatch(topic);
  }
}

void LiveFeed::close() {
  delay_timer_.cancel();
  delayed_.clear();
  for (const auto& [topic, audience] : audiences_) {
    for (const auto& spectator : audience.watching) {
      spectator->leave();
    }
    for (const auto& spectator : audience.waiting) {
      spectator->leave();
    }
  }
}

std::size_t LiveFeed::spectators() const {
  std::size_t count = 0;
  for (const auto& [topic, audience] : audiences_) {
    count += audience.watching.size() + audience.waiting.size();
  }
  return count;
}

void LiveFeed::publish(Topic topic, Message message) {
  asio::post(io_, [this, topic, message = std::move(message)]() mutable {
    after_delay([this, topic, message = std::move(message)] { tell(topic, message); });
  });
}

void LiveFeed::snapshot(Topic topic, Ticket ticket, Message message) {
  asio::post(io_, [this, topic, ticket, message = std::move(message)]() mutable {
    after_delay([this, topic, ticket, message = std::move(message)] {
      tell_snapshot(topic, ticket, message);
    });
  });
}

void LiveFeed::after_delay(std::function<void()> action) {
  if (delay_ == std::chrono::milliseconds{0}) {
    action();
    return;
  }
  delayed_.push_back({steady_clock::now() + delay_, std::move(action)});
  if (delayed_.size() == 1) {
    wait_for_delayed();
  }
}

void LiveFeed::wait_for_delayed() {
  delay_timer_.expires_at(delayed_.front().due);
  delay_timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) {
      return;
    }
    while (!delayed_.empty() && delayed_.front().due <= steady_clock::now()) {
      const auto action = std::move(delayed_.front().action);
      delayed_.pop_front();
      action();
    }
    if (!delayed_.empty()) {
      wait_for_delayed();
    }
  });
}

void LiveFeed::tell(Topic topic, const Message& message) {
  const auto found = audiences_.find(topic);
  if (found == audiences_.end()) {
    return;
  }
  for (const auto& spectator : found->second.watching) {
    static_cast<void>(spectator->offer(message));  // whoever has a gap asks for a snapshot itself
  }
}

void LiveFeed::tell_snapshot(Topic topic, Ticket ticket, const Message& message) {
  const auto found = audiences_.find(topic);
  if (found == audiences_.end() || found->second.awaited != ticket) {
    return;
  }
  Audience& audience = found->second;
  for (const auto& spectator : std::exchange(audience.waiting, {})) {
    audience.watching.insert(spectator);
    static_cast<void>(spectator->offer(message));
  }
}

}  // namespace poolhall::web
