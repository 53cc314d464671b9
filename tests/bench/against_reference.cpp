#include "tests/bench/against_reference.hpp"

#include <algorithm>
#include <sstream>

namespace poolhall::bench {

namespace {

// Takes from `reference` the hops for which entries of `found` stand beside the first one.
void drop_counted_hops(const std::vector<TimedEvent>& found, std::vector<TimedEvent>& reference) {
  for (const TimedEvent& entry : found) {
    std::uint32_t left = entry.count - 1;
    if (left == 0) {
      continue;
    }
    const double slack = 1e-9;
    std::erase_if(reference, [&](const TimedEvent& event) {
      const bool counted = left > 0 && event.key == entry.key && event.t > entry.t + slack &&
                           event.t <= entry.until + slack;
      left -= counted ? 1 : 0;
      return counted;
    });
  }
}

std::string words(const TimedEvent& event) {
  std::ostringstream out;
  out << physics::name(event.key.type) << " of ball " << number(event.key.first);
  if (event.key.second != event.key.first) {
    out << " and " << number(event.key.second);
  }
  if (event.key.place >= 0) {
    out << " at place " << event.key.place;
  }
  out << " at " << event.t << " s";
  return out.str();
}

}  // namespace

Sequence compare_sequences(const std::vector<TimedEvent>& found,
                           std::vector<TimedEvent> reference) {
  drop_counted_hops(found, reference);
  Sequence result;
  std::vector<TimedEvent> ordered = found;
  std::size_t begin = 0;
  while (begin < std::min(ordered.size(), reference.size())) {
    // Events of the reference that follow each other within a tie, in the order of their keys.
    std::size_t end = begin + 1;
    while (end < std::min(ordered.size(), reference.size()) &&
           reference[end].t - reference[end - 1].t < tie) {
      ++end;
    }
    const auto by_key = [](const TimedEvent& p, const TimedEvent& q) { return p.key < q.key; };
    const auto first = static_cast<std::ptrdiff_t>(begin);
    const auto last = static_cast<std::ptrdiff_t>(end);
    const auto is_ours = [&](const TimedEvent& event) { return event.key == ordered[begin].key; };
    if (end - begin > 1 && !is_ours(reference[begin]) &&
        std::any_of(reference.begin() + first, reference.begin() + last, is_ours)) {
      result.has_ties_in_another_order = true;
    }
    std::stable_sort(ordered.begin() + first, ordered.begin() + last, by_key);
    std::stable_sort(reference.begin() + first, reference.begin() + last, by_key);
    for (; begin < end; ++begin) {
      if (ordered[begin].key != reference[begin].key) {
        result.parted = true;
        result.first_difference = "event " + std::to_string(begin) + ": " + words(ordered[begin]) +
                                  ", but reference: " + words(reference[begin]);
        return result;
      }
      result.time_errors.push_back(std::abs(ordered[begin].t - reference[begin].t));
    }
  }
  result.same = ordered.size() == reference.size();
  if (!result.same) {
    result.first_difference = std::to_string(ordered.size()) +
                              " events, but reference: " + std::to_string(reference.size());
  }
  return result;
}

}  // namespace poolhall::bench
