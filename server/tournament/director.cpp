#include "server/tournament/director.hpp"

#include <algorithm>
#include <utility>

namespace poolhall::tournament {

Director::Director(std::vector<Pairing> schedule, ConcurrencyLimits limits)
    : schedule_(std::move(schedule)), status_(schedule_.size(), Status::waiting), limits_(limits) {}

std::vector<Pairing> Director::begin_due() {
  std::vector<Pairing> due;
  for (const Pairing& pairing : schedule_) {
    if (status_[pairing.number] == Status::waiting && may_begin(pairing)) {
      status_[pairing.number] = Status::running;
      due.push_back(pairing);
    }
  }
  return due;
}

void Director::resume(std::uint32_t pairing) {
  if (status_.at(pairing) == Status::waiting) {
    status_[pairing] = Status::running;
  }
}

void Director::end(std::uint32_t pairing) {
  status_.at(pairing) = Status::over;
}

bool Director::is_running(std::uint32_t pairing) const {
  return status_.at(pairing) == Status::running;
}

bool Director::is_over(std::uint32_t pairing) const {
  return status_.at(pairing) == Status::over;
}

bool Director::all_over() const {
  return std::all_of(status_.begin(), status_.end(),
                     [](Status status) { return status == Status::over; });
}

std::uint32_t Director::running_of(EntryId entry) const {
  return static_cast<std::uint32_t>(
      std::count_if(schedule_.begin(), schedule_.end(), [&](const Pairing& pairing) {
        return status_[pairing.number] == Status::running &&
               (pairing.first == entry || pairing.second == entry);
      }));
}

bool Director::may_begin(const Pairing& pairing) const {
  const auto running = std::count(status_.begin(), status_.end(), Status::running);
  return running < static_cast<std::ptrdiff_t>(limits_.games) &&
         running_of(pairing.first) < limits_.games_per_entry &&
         running_of(pairing.second) < limits_.games_per_entry;
}

}  // namespace poolhall::tournament
