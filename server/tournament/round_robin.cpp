#include "server/tournament/round_robin.hpp"

#include <utility>

namespace poolhall::tournament {
namespace {

// The rule of the Berger tables (FIDE Handbook C.05, annex 1) on 0-based numbers: of two entries
// on the circle the lower one is first when the sum is odd; the one who stays outside the circle
// is first against the upper half.
std::pair<std::size_t, std::size_t> by_berger(std::size_t a, std::size_t b, std::size_t seats) {
  const std::size_t low = a < b ? a : b;
  const std::size_t high = a < b ? b : a;
  const bool outside = high == seats - 1;
  const bool low_first = outside ? low < seats / 2 : (low + high) % 2 == 1;
  return low_first ? std::pair(low, high) : std::pair(high, low);
}

}  // namespace

std::vector<Pairing> round_robin(std::size_t entries) {
  std::vector<Pairing> schedule;
  if (entries < 2) {
    return schedule;
  }
  // With an odd number the seat outside the circle stays empty.
  const std::size_t seats = entries + entries % 2;
  const std::size_t circle = seats - 1;
  const auto add = [&](std::size_t round, std::size_t a, std::size_t b) {
    if (a >= entries || b >= entries) {
      return;
    }
    const auto [first, second] = by_berger(a, b, seats);
    schedule.push_back({static_cast<std::uint32_t>(schedule.size()),
                        static_cast<std::uint32_t>(round), entry_id(first), entry_id(second)});
  };
  for (std::size_t round = 0; round < circle; ++round) {
    // Seats of the circle meet when their numbers add up to the round's; the one left over meets
    // the seat outside.
    for (std::size_t a = 0; a < circle; ++a) {
      const std::size_t b = (round + circle - a) % circle;
      if (a < b) {
        add(round, a, b);
      } else if (a == b) {
        add(round, a, seats - 1);
      }
    }
  }
  return schedule;
}

}  // namespace poolhall::tournament
