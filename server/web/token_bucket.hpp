// A rate with a burst, counted in whole nanoseconds: nothing drifts.
//
//   TokenBucket bucket{50, 100};           // 50 a second, 100 at once
//   if (!bucket.take(now)) refuse();
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace poolhall::web {

class TokenBucket {
 public:
  using Time = std::chrono::steady_clock::time_point;

  TokenBucket(std::uint32_t per_second, std::uint32_t burst)
      : cost_(std::chrono::nanoseconds{std::chrono::seconds{1}} / std::max(per_second, 1U)),
        capacity_(cost_ * burst) {}

  [[nodiscard]] bool take(Time now) {
    // `empty_at_` is when the bucket would have been empty with the rate alone.
    const Time floor = now - capacity_;
    empty_at_ = std::max(empty_at_, floor);
    if (empty_at_ + cost_ > now) {
      return false;
    }
    empty_at_ += cost_;
    return true;
  }

 private:
  std::chrono::nanoseconds cost_;
  std::chrono::nanoseconds capacity_;
  Time empty_at_{Time::min() + std::chrono::hours{1}};
};

}  // namespace poolhall::web
