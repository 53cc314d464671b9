// Kills the server (SIGKILL) again and again, at random moments and at the named failpoints, while
// games go on between agents that survive it; then holds the database against what the agents were
// told, and runs `poolhall verify` on it.
//
//   KillReport report = run_kills({.program = "/proc/self/exe", .kills = 1000, .games = 50});
//   print(report, std::cout);
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include "tests/fault/harness/ledger.hpp"
#include "tests/fault/harness/survivor.hpp"

namespace poolhall::fault {

struct KillOptions {
  std::filesystem::path program = "/proc/self/exe";
  std::filesystem::path directory;       // of the database; must exist
  std::uint32_t kills = 1'000;           // at random moments
  std::uint32_t kills_a_failpoint = 25;  // at each failpoint, besides
  std::uint32_t games = 50;
  std::uint64_t seed = 1;
  std::ostream* progress = nullptr;
};

struct KillReport {
  std::uint32_t random_kills = 0;
  std::map<std::string, std::uint32_t> failpoint_kills;
  double seconds = 0;
  double mean_start_ms = 0;  // of the server, until it listens
  double longest_start_ms = 0;
  SurvivorCounts agents;
  LedgerFindings findings;
  bool all_games_ended = false;  // while the agents still played
  int verify_exit = -1;

  [[nodiscard]] bool sound() const {
    return findings.sound() && all_games_ended && verify_exit == 0 && agents.complaints.empty();
  }
};

[[nodiscard]] KillReport run_kills(const KillOptions& options);
void print(const KillReport& report, std::ostream& out);

}  // namespace poolhall::fault
