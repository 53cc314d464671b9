#include "clients/bots/workshop.hpp"

#include <algorithm>
#include <thread>

namespace poolhall::bots {

Workshop::Workshop(const Hall& hall, unsigned cores) {
  for (unsigned i = 0; i < std::max(1U, cores); ++i) {
    trials_.push_back(std::make_unique<Trial>(hall));
  }
}

bool Workshop::is_late() const {
  return deadline_ && std::chrono::steady_clock::now() >= *deadline_;
}

std::uint64_t Workshop::events() const {
  std::uint64_t sum = 0;
  for (const auto& trial : trials_) {
    sum += trial->events();
  }
  return sum;
}

bool Workshop::for_each(std::size_t count, const std::function<void(Trial&, std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  const auto take_turns = [&](Trial& trial) {
    for (std::size_t i = next++; i < count; i = next++) {
      if (is_late()) {
        return;
      }
      work(trial, i);
      ++done;
    }
  };
  std::vector<std::jthread> helpers;
  for (std::size_t k = 1; k < std::min(trials_.size(), count); ++k) {
    helpers.emplace_back([&, k] { take_turns(*trials_[k]); });
  }
  take_turns(*trials_.front());
  helpers.clear();
  return done == count;
}

}  // namespace poolhall::bots
