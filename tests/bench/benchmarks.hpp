// The benchmarks behind `poolhall bench`. Each prints its tables, writes them as CSV and its plots
// as SVG into `directory`, and returns whether everything that it checks held.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace poolhall::bench {

struct BenchOptions {
  std::filesystem::path directory = "bench-results";
  double share = 1;  // of the full number of scenes, for a quick look
  std::uint64_t seed = 1;
  std::string part{};              // bench_precision: only this one of precision_parts
  std::filesystem::path scenes{};  // bench_speed: times these instead, one scene a line
};

// At least one, and `share` of `full`.
[[nodiscard]] std::size_t scaled_count(std::size_t full, const BenchOptions& options);

// Against the 100-digit reference: random shots and breaks ("accuracy"), every solver on random
// pairs ("solvers"), every method's error against its run time ("methods"), how errors grow
// ("growth"), and the paper's count of operations ("operations").
inline constexpr std::array<const char*, 5> precision_parts{"accuracy", "solvers", "methods",
                                                            "growth", "operations"};
bool bench_precision(const BenchOptions& options, std::ostream& out);

// Extreme scenes, expected against found, and random shots and breaks.
bool bench_stability(const BenchOptions& options, std::ostream& out);

// What each omission saves.
bool bench_lean(const BenchOptions& options, std::ostream& out);

// Microseconds a shot, alone and as a ratio to the paper's own scheme; or of the
// scenes in a file. Throws std::runtime_error that names the file and line of what cannot be read.
bool bench_speed(const BenchOptions& options, std::ostream& out);

// Coverage of the ratings' intervals and error rates of the sequential test, simulated.
bool bench_ratings(const BenchOptions& options, std::ostream& out);

// A million deviates of fresh keys: whether they are normal and independent.
bool bench_noise(const BenchOptions& options, std::ostream& out);

// The variance of the score difference of two bots, in independent and in mirrored pairs.
bool bench_mirrored(const BenchOptions& options, std::ostream& out);

// One bit of every stored value, and bits anywhere in the file: whether verify finds them.
bool bench_tamper(const BenchOptions& options, std::ostream& out);

// Random games of both rule sets, and what must hold of every game.
bool bench_rules(const BenchOptions& options, std::ostream& out);

}  // namespace poolhall::bench
