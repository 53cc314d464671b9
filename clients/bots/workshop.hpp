// The cores that a plan may use, each with a workspace of its own. What is computed does not hang
// on their number: every item of work writes its own place.
//
//   Workshop workshop(hall, 4);
//   workshop.for_each(plans.size(), [&](Trial& trial, std::size_t i) { ... plans[i] ... });
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "clients/bots/trial.hpp"

namespace poolhall::bots {

class Workshop {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  Workshop(const Hall& hall, unsigned cores);

  // Calls `work` for 0 .. count-1. Says whether all were done: none begins after the deadline.
  bool for_each(std::size_t count, const std::function<void(Trial&, std::size_t)>& work);

  void set_deadline(std::optional<Instant> deadline) { deadline_ = deadline; }
  [[nodiscard]] bool is_late() const;
  [[nodiscard]] Trial& first() { return *trials_.front(); }
  // Events simulated so far by all.
  [[nodiscard]] std::uint64_t events() const;
  [[nodiscard]] std::size_t cores() const { return trials_.size(); }

 private:
  std::vector<std::unique_ptr<Trial>> trials_;
  std::optional<Instant> deadline_{};
};

}  // namespace poolhall::bots
