// The server under load: memory of idle agents, durable shots a second in closed loop, latencies
// in open loop, where the time goes, bytes a shot. Server and generator are processes of their own
// on this machine; the database is on a disk.
//
//   bool goals_met = bench_server({.program = "/proc/self/exe"}, std::cout);
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>

namespace poolhall::bench {

struct ServerBenchOptions {
  std::filesystem::path program = "/proc/self/exe";
  std::filesystem::path directory;  // where the databases are; empty: one that is on a disk
  double seconds = 10;              // of each measurement
  std::uint32_t idle = 10'000;
  std::uint32_t games = 64;           // in closed loop
  std::uint32_t paced_games = 1'000;  // in open loop
  double rate = 2'500;                // stored shots a second in all paced games
};

// Whether every figure reaches its goal.
[[nodiscard]] bool bench_server(const ServerBenchOptions& options, std::ostream& out);

}  // namespace poolhall::bench
