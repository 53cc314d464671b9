// The lag of one connection: the least of the last round trips of the server's own probes. A
// client that never answers a probe gets no credit. An answer that comes late measures the client,
// not the network: so the first few probes follow each other at once, and a late answer the next.
//
//   std::uint64_t t = meter.probe(now);     // send lag {t}
//   meter.answered(t, now);                 // lag {t} came back
//   meter.lag();
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace poolhall::net {

class LagMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Micros = std::chrono::microseconds;

  [[nodiscard]] bool wants_probe(Time now) const {
    const bool knows_too_little = known_ < first_probes && !waiting_;
    return !sent_at_ || knows_too_little || now - *sent_at_ >= std::chrono::seconds{2};
  }

  // The value to send; the one before it, if still unanswered, counts no more.
  [[nodiscard]] std::uint64_t probe(Time now) {
    sent_at_ = now;
    waiting_ = true;
    return ++number_;
  }

  // False if `t` is not the probe that waits for its answer.
  bool answered(std::uint64_t t, Time now) {
    if (!waiting_ || t != number_) {
      return false;
    }
    waiting_ = false;
    trips_[next_] = std::chrono::duration_cast<Micros>(now - *sent_at_);
    next_ = (next_ + 1) % trips_.size();
    known_ = std::min(known_ + 1, trips_.size());
    return true;
  }

  [[nodiscard]] Micros lag() const {
    if (known_ == 0) {
      return Micros{0};
    }
    return *std::min_element(trips_.begin(), trips_.begin() + static_cast<std::ptrdiff_t>(known_));
  }

 private:
  static constexpr std::size_t first_probes = 4;

  std::optional<Time> sent_at_{};
  bool waiting_ = false;
  std::uint64_t number_ = 0;
  std::array<Micros, 8> trips_{};
  std::size_t next_ = 0;
  std::size_t known_ = 0;
};

}  // namespace poolhall::net
