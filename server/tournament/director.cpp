#include "server/tournament/director.hpp"

#include <algorithm>
#include <set>

namespace poolhall::tournament {

Director::Director(const std::vector<Pairing>& schedule, ConcurrencyLimits limits, Pace pace)
    : limits_(limits), pace_(pace) {
  plan(schedule);
}

void Director::plan(const std::vector<Pairing>& schedule) {
  std::set<std::uint32_t> planned;
  for (const Pairing& pairing : schedule) {
    planned.insert(pairing.number);
    Slot& slot = slots_[pairing.number];
    if (slot.status == Status::waiting) {
      slot.pairing = pairing;
    }
  }
  std::erase_if(slots_, [&](const auto& slot) {
    return slot.second.status == Status::waiting && !planned.contains(slot.first);
  });
}

std::vector<Pairing> Director::begin_due() {
  std::vector<Pairing> due;
  for (auto& [number, slot] : slots_) {
    if (slot.status == Status::waiting && may_begin(slot.pairing)) {
      slot.status = Status::running;
      due.push_back(slot.pairing);
    }
  }
  return due;
}

std::vector<std::uint32_t> Director::running() const {
  std::vector<std::uint32_t> numbers;
  for (const auto& [number, slot] : slots_) {
    if (slot.status == Status::running) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

void Director::resume(std::uint32_t pairing) {
  Slot& slot = slots_.at(pairing);
  if (slot.status == Status::waiting) {
    slot.status = Status::running;
  }
}

void Director::end(std::uint32_t pairing) {
  slots_.at(pairing).status = Status::over;
}

bool Director::is_over(std::uint32_t pairing) const {
  return slots_.at(pairing).status == Status::over;
}

bool Director::all_over() const {
  return std::all_of(slots_.begin(), slots_.end(),
                     [](const auto& slot) { return slot.second.status == Status::over; });
}

bool Director::may_begin(const Pairing& pairing) const {
  std::uint32_t running = 0;
  std::uint32_t of_first = 0;
  std::uint32_t of_second = 0;
  const auto plays = [](const Pairing& match, EntryId entry) {
    return match.first == entry || match.second == entry ? 1U : 0U;
  };
  for (const auto& [number, slot] : slots_) {
    if (slot.status == Status::running) {
      ++running;
      of_first += plays(slot.pairing, pairing.first);
      of_second += plays(slot.pairing, pairing.second);
    }
  }
  return running < limits_.games && of_first < limits_.games_per_entry &&
         of_second < limits_.games_per_entry &&
         !(pace_ == Pace::by_rounds && earlier_round_goes_on(pairing.round));
}

bool Director::earlier_round_goes_on(std::uint32_t round) const {
  return std::any_of(slots_.begin(), slots_.end(), [round](const auto& slot) {
    return slot.second.pairing.round < round && slot.second.status != Status::over;
  });
}

}  // namespace poolhall::tournament
