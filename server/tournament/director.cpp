#include "server/tournament/director.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace poolhall::tournament {

Director::Director(const std::vector<Pairing>& schedule, ConcurrencyLimits limits, Pace pace)
    : limits_(limits), pace_(pace) {
  plan(schedule);
}

void Director::plan(const std::vector<Pairing>& schedule) {
  std::vector<Slot> planned;
  planned.reserve(schedule.size());
  auto known = slots_.cbegin();
  const auto keep_begun_before = [&](std::uint32_t number) {
    for (; known != slots_.cend() && known->pairing.number < number; ++known) {
      if (known->status != Status::waiting) {
        planned.push_back(*known);
      }
    }
  };
  for (const Pairing& pairing : schedule) {
    keep_begun_before(pairing.number);
    const bool is_known = known != slots_.cend() && known->pairing.number == pairing.number;
    planned.push_back(is_known && known->status != Status::waiting ? *known : Slot{pairing});
    known += is_known ? 1 : 0;
  }
  keep_begun_before(std::numeric_limits<std::uint32_t>::max());
  slots_ = std::move(planned);
}

std::vector<Pairing> Director::begin_due() {
  std::uint32_t running = 0;
  std::vector<std::uint32_t> of_entry;                                   // games that go on
  std::uint32_t open_round = std::numeric_limits<std::uint32_t>::max();  // the first that goes on
  for (const Slot& slot : slots_) {
    of_entry.resize(
        std::max({of_entry.size(), index(slot.pairing.first) + 1, index(slot.pairing.second) + 1}));
    if (slot.status == Status::running) {
      ++running;
      ++of_entry[index(slot.pairing.first)];
      ++of_entry[index(slot.pairing.second)];
    }
    if (slot.status != Status::over) {
      open_round = std::min(open_round, slot.pairing.round);
    }
  }
  std::vector<Pairing> due;
  for (Slot& slot : slots_) {
    if (running >= limits_.games) {
      break;
    }
    const Pairing& pairing = slot.pairing;
    std::uint32_t& of_first = of_entry[index(pairing.first)];
    std::uint32_t& of_second = of_entry[index(pairing.second)];
    if (slot.status == Status::waiting && of_first < limits_.games_per_entry &&
        of_second < limits_.games_per_entry &&
        (pace_ == Pace::free_running || pairing.round <= open_round)) {
      slot.status = Status::running;
      ++running;
      ++of_first;
      ++of_second;
      due.push_back(pairing);
    }
  }
  return due;
}

void Director::drop(std::uint32_t pairing) {
  std::erase_if(slots_, [pairing](const Slot& slot) { return slot.pairing.number == pairing; });
}

std::vector<std::uint32_t> Director::running() const {
  std::vector<std::uint32_t> numbers;
  for (const Slot& slot : slots_) {
    if (slot.status == Status::running) {
      numbers.push_back(slot.pairing.number);
    }
  }
  return numbers;
}

void Director::resume(std::uint32_t pairing) {
  Slot& slot = slots_.at(place_of(pairing));
  if (slot.status == Status::waiting) {
    slot.status = Status::running;
  }
}

void Director::end(std::uint32_t pairing) {
  slots_.at(place_of(pairing)).status = Status::over;
}

bool Director::is_known(std::uint32_t pairing) const {
  return place_of(pairing) < slots_.size();
}

bool Director::is_over(std::uint32_t pairing) const {
  return slots_.at(place_of(pairing)).status == Status::over;
}

bool Director::all_over() const {
  return std::all_of(slots_.begin(), slots_.end(),
                     [](const Slot& slot) { return slot.status == Status::over; });
}

std::size_t Director::place_of(std::uint32_t pairing) const {
  const auto found = std::lower_bound(
      slots_.begin(), slots_.end(), pairing,
      [](const Slot& slot, std::uint32_t number) { return slot.pairing.number < number; });
  const bool is_known = found != slots_.end() && found->pairing.number == pairing;
  return is_known ? static_cast<std::size_t>(found - slots_.begin()) : slots_.size();
}

}  // namespace poolhall::tournament
