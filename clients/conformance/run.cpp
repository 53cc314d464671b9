#include "clients/conformance/run.hpp"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "clients/conformance/checks.hpp"

namespace poolhall::conformance {
namespace {

constexpr std::size_t shown_lines = 8;
constexpr std::size_t shown_log_lines = 5;

bool is_wanted(const RunOptions& options, std::string_view name) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

// Names of the scripts to be run: those that are wanted, and those in which a standing check that
// is wanted shows.
std::set<std::string_view> scripts_to_run(const RunOptions& options) {
  std::set<std::string_view> names;
  for (const Script& script : scripts()) {
    if (is_wanted(options, script.info.name)) {
      names.insert(script.info.name);
    }
  }
  for (const StandingCheck& check : standing_checks()) {
    if (is_wanted(options, check.info.name)) {
      names.insert(check.occasions.begin(), check.occasions.end());
    }
  }
  return names;
}

void add_log(const std::filesystem::path& log, std::vector<std::string>& lines) {
  std::ifstream in(log);
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    all.push_back("  its log: " + line);
  }
  const auto shown = static_cast<std::ptrdiff_t>(std::min(shown_log_lines, all.size()));
  lines.insert(lines.end(), all.end() - shown, all.end());
}

Outcome outcome_of(const Script& script, const RunOptions& options, Conduct& conduct) {
  const auto log = options.logs / (std::string(script.info.name) + ".log");
  Outcome outcome{Verdict::pass, {}, {}};
  Bot bot(options.command, log, options.starter);
  std::optional<Host> host;
  try {
    host.emplace(options.host, bot, conduct);
    script.run(*host);
  } catch (const Stop& stop) {
    outcome = {stop.verdict, stop.why, {}};
  } catch (const std::exception& failure) {
    outcome = {Verdict::not_reached, std::string("the tool failed: ") + failure.what(), {}};
  }
  bot.kill();
  if (outcome.verdict != Verdict::pass && host) {
    outcome.lines = host->transcript().tail(shown_lines);
    add_log(log, outcome.lines);
  }
  return outcome;
}

class Runner {
 public:
  explicit Runner(const RunOptions& options)
      : options_(options), outcomes_(scripts().size()), to_run_(scripts_to_run(options)) {}

  void work() {
    while (true) {
      const std::size_t index = next_++;
      if (index >= scripts().size()) {
        return;
      }
      const Script& script = scripts()[index];
      if (!to_run_.contains(script.info.name)) {
        continue;
      }
      Conduct conduct;
      outcomes_[index] = outcome_of(script, options_, conduct);
      const std::scoped_lock lock(mutex_);
      conduct_.add(conduct);
    }
  }

  [[nodiscard]] Report report() const {
    Report report;
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
      if (is_wanted(options_, scripts()[i].info.name)) {
        report.results.push_back({scripts()[i].info, outcomes_[i]});
      }
    }
    for (const StandingCheck& check : standing_checks()) {
      if (is_wanted(options_, check.info.name)) {
        report.results.push_back({check.info, conduct_.outcome(check.info.name)});
      }
    }
    return report;
  }

 private:
  const RunOptions& options_;
  std::vector<Outcome> outcomes_;  // by script
  std::set<std::string_view> to_run_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  Conduct conduct_;
};

}  // namespace

std::size_t Report::count(Verdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(),
                    [verdict](const Result& result) { return result.outcome.verdict == verdict; }));
}

std::vector<CheckInfo> all_checks() {
  std::vector<CheckInfo> all;
  for (const Script& script : scripts()) {
    all.push_back(script.info);
  }
  for (const StandingCheck& check : standing_checks()) {
    all.push_back(check.info);
  }
  return all;
}

Report run(const RunOptions& options) {
  Runner runner(options);
  // Each bot dies with the thread that has started it.
  std::vector<std::thread> threads;
  for (unsigned job = 0; job < std::max(options.jobs, 1U); ++job) {
    threads.emplace_back([&runner] { runner.work(); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return runner.report();
}

}  // namespace poolhall::conformance
