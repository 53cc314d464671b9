// How far a tournament is and when it will be over, from games and times alone.
//
//   Progress now = progress({.finished = timed, .running = timed, .waiting = games,
//                            .finished_before = 3, .elapsed = 40s});
//   if (now.remaining) show(*now.remaining);
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "server/tournament/entry.hpp"

namespace poolhall::tournament {

using Seconds = std::chrono::duration<double>;

struct TimedGame {
  EntryId one{};
  EntryId two{};
  Seconds time{0};  // that it took, or has taken so far
};

struct ProgressInput {
  std::vector<TimedGame> finished;  // timed since `elapsed` began to count
  std::vector<TimedGame> running;
  std::vector<TimedGame> waiting;   // `time` means nothing
  std::size_t finished_before = 0;  // by an earlier run of the same tournament
  Seconds elapsed{0};
};

struct Progress {
  std::size_t finished = 0;
  std::size_t running = 0;
  std::size_t total = 0;
  Seconds elapsed{0};
  std::optional<Seconds> remaining{};  // none before the first game is over
};

// A game still to be played takes as long as the finished ones of the same two did on average, or
// as all finished ones; as many games go on at once as did so far.
[[nodiscard]] Progress progress(const ProgressInput& input);

}  // namespace poolhall::tournament
