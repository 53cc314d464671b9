// Every latency of a run, and what share of them was below how much.
//
//   latencies.add(reply_read - scheduled_send);
//   latencies.share_below(0.99);      // p99
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

namespace poolhall::load {

class Latencies {
 public:
  using Duration = std::chrono::nanoseconds;

  void add(Duration latency) {
    all_.push_back(latency);
    sorted_ = false;
  }
  [[nodiscard]] std::size_t size() const { return all_.size(); }

  // The least latency that is not exceeded by `share` (0..1) of them: the nearest rank, no
  // interpolation. Zero if there is none.
  [[nodiscard]] Duration share_below(double share) {
    if (all_.empty()) {
      return Duration{0};
    }
    if (!sorted_) {
      std::sort(all_.begin(), all_.end());
      sorted_ = true;
    }
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(all_.size())));
    return all_[std::clamp<std::size_t>(rank, 1, all_.size()) - 1];
  }

 private:
  std::vector<Duration> all_;
  bool sorted_ = false;
};

}  // namespace poolhall::load
