// Runs checks against a bot: each script with a process of the bot's and a host of its own, several
// at the same time.
//
//   Report report = run({.command = "python3 bot.py {server}", .starter = start, ...});
//   std::cout << text_of(report);   return report.failures() == 0 ? 0 : 1;
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "clients/conformance/bot.hpp"
#include "clients/conformance/conduct.hpp"
#include "clients/conformance/host.hpp"

namespace poolhall::conformance {

struct RunOptions {
  std::string command;
  BotStarter starter;
  HostOptions host{};
  std::vector<std::string> only{};  // names of checks; empty: all
  unsigned jobs = 2;                // checks at the same time
  std::filesystem::path logs;       // a folder; what the bot writes in a check is in CHECK.log
};

struct Result {
  CheckInfo info;
  Outcome outcome;
};

struct Report {
  std::vector<Result> results;

  [[nodiscard]] std::size_t count(Verdict verdict) const;
};

// Every check, in the order of the report.
[[nodiscard]] std::vector<CheckInfo> all_checks();

// `only` has names of all_checks().
[[nodiscard]] Report run(const RunOptions& options);

[[nodiscard]] std::string text_of(const Report& report);
// {"checks": [{"name", "demand", "section", "verdict", "why", "lines"}], "passed", "warned",
// "failed", "not_reached"}
[[nodiscard]] std::string json_of(const Report& report);

}  // namespace poolhall::conformance
