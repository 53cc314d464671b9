// The time-tables of many games, which together are an even row of answers: whenever each game
// begins, its first answer is due at the next of its own places in the row.
//
//   const Pace pace{.from = now, .period = 400ms, .games = 4};   // an answer every 100 ms
//   pace.first_due(1, now + 250ms)   // now + 500ms
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace poolhall::load {

struct Pace {
  using Time = std::chrono::steady_clock::time_point;

  Time from{};
  std::chrono::nanoseconds period{};  // of a game, between its answers
  std::size_t games = 1;

  // After `now`, which is not before `from`, and no more than a period away.
  [[nodiscard]] Time first_due(std::size_t game, Time now) const {
    const Time first =
        from + period * static_cast<std::int64_t>(game) / static_cast<std::int64_t>(games);
    return first > now ? first : first + period * ((now - first) / period + 1);
  }
};

}  // namespace poolhall::load
