// How often the 95 % intervals of ratings hold the truth, and how often the sequential test is
// wrong, in simulated tournaments (tests/support/simulated_ratings.hpp).
#include <cmath>
#include <ostream>

#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/simulated_ratings.hpp"

namespace poolhall::bench {

namespace {

using test_support::Rack;

constexpr std::size_t full_tournaments = 2'000;
constexpr std::size_t games_a_pair = 100;
constexpr std::size_t full_trials = 2'000;
// Of a share that is estimated from the trials.
constexpr double allowed_standard_errors = 3;

bool show_coverage(const BenchOptions& options, std::ostream& out) {
  ReportTable table{"95 % intervals of ratings, four players",
                    {"games of a pair", "tournaments", "intervals", "covered %"}};
  bool holds = true;
  for (const Rack rack : {Rack::independent, Rack::favours_the_breaker}) {
    const auto coverage = test_support::interval_coverage(
        rack, scaled_count(full_tournaments, options), games_a_pair, options.seed);
    holds = holds && coverage.share() >= 0.93 && coverage.share() <= 0.97;
    table.add({rack == Rack::independent ? "independent" : "share their rack",
               std::to_string(scaled_count(full_tournaments, options)),
               std::to_string(coverage.intervals), cell(100 * coverage.share(), 4)});
  }
  table.print(out);
  table.write_csv(options.directory / "ratings_coverage.csv");
  return holds;
}

double upper_bound_of(double rate, double count) {
  return rate + allowed_standard_errors * std::sqrt(rate * (1 - rate) / count);
}

bool show_sprt(const BenchOptions& options, std::ostream& out) {
  ReportTable table{"SPRT over pairs",
                    {"elo0", "elo1", "alpha", "beta", "trials", "wrongly H1", "wrongly H0",
                     "undecided", "pairs on average"}};
  bool holds = true;
  const std::size_t count = scaled_count(full_trials, options);
  for (const ratings::SprtSettings& settings :
       {ratings::SprtSettings{0, 30, 0.05, 0.05}, ratings::SprtSettings{0, 60, 0.05, 0.1},
        ratings::SprtSettings{-20, 20, 0.02, 0.02}, ratings::SprtSettings{0, 100, 0.1, 0.1}}) {
    const auto errors = test_support::sprt_errors(settings, count, options.seed);
    holds = holds && errors.undecided == 0 &&
            errors.wrong_h1 <= upper_bound_of(settings.alpha, static_cast<double>(count)) &&
            errors.wrong_h0 <= upper_bound_of(settings.beta, static_cast<double>(count));
    table.add({cell(settings.elo0), cell(settings.elo1), cell(settings.alpha), cell(settings.beta),
               std::to_string(count), cell(errors.wrong_h1), cell(errors.wrong_h0),
               std::to_string(errors.undecided), cell(errors.mean_pairs)});
  }
  table.print(out);
  table.write_csv(options.directory / "ratings_sprt.csv");
  return holds;
}

}  // namespace

bool bench_ratings(const BenchOptions& options, std::ostream& out) {
  std::filesystem::create_directories(options.directory);
  const bool coverage_holds = show_coverage(options, out);
  return show_sprt(options, out) && coverage_holds;
}

}  // namespace poolhall::bench
