// What a thousand spectators of one game cost those who play others: windows with and without them
// in turn on one server, and the ratio of the players' p99. Server, generators and spectators share
// this machine's cores.
//
//   bool goal_met = bench_spectators({.program = "/proc/self/exe"}, std::cout);
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace poolhall::bench {

struct SpectatorsBenchOptions {
  std::filesystem::path program = "/proc/self/exe";
  std::filesystem::path directory;  // where the database is; empty: one that is on a disk
  double seconds = 8;               // of each window
  std::uint32_t pairs = 5;          // of windows
  std::uint32_t spectators = 1'000;
  std::uint32_t games = 64;  // besides the one that is watched
  double rate = 1'000;       // stored shots a second in all of them
  double watched_rate = 2;   // in the one that is watched
};

// Whether the players' p99 is within 10 % of what it is without spectators.
[[nodiscard]] bool bench_spectators(const SpectatorsBenchOptions& options, std::ostream& out);

}  // namespace poolhall::bench
