// Statistics of two agents over pairs of games, and the sequential test that stops a comparison as
// soon as it is decided.
//
//   SprtState state = sprt(scores, {.elo0 = 0, .elo1 = 10});   // in the order of the schedule
//   if (state.verdict != SprtVerdict::undecided) stop();
//
// Games 2k and 2k + 1 are a pair: mirrored, each player breaks once. The pair is the unit, since
// its games share their rack and are not independent.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace poolhall::ratings {

struct SprtSettings {
  double elo0 = 0;      // H0: the first is stronger by this
  double elo1 = 30;     // H1
  double alpha = 0.05;  // bound of the probability to accept H1 where H0 holds
  double beta = 0.05;   // the other way round
};

enum class SprtVerdict : std::uint8_t { undecided, h0, h1 };

// Pairs by the first player's points: 0 (LL), 1/2, 1 (split), 3/2, 2 (WW); halves only by draws.
struct PairCounts {
  std::array<std::uint32_t, 5> by_points{};

  [[nodiscard]] std::uint32_t pairs() const;
};
// From scores of the first player by game; a last game without its partner is left out.
[[nodiscard]] PairCounts pair_counts(const std::vector<double>& scores);

struct PairStatistics {
  double score = 0.5;         // mean a game
  double standard_error = 0;  // of it, over pairs
  double elo = 0;             // of the mean score; infinite at 0 and 1
  double elo_low = 0;         // 95 % interval
  double elo_high = 0;
  double superiority = 0.5;  // likelihood that the first is the stronger one
};
[[nodiscard]] PairStatistics pair_statistics(const PairCounts& counts);

struct SprtState {
  SprtVerdict verdict = SprtVerdict::undecided;
  double log_likelihood_ratio = 0;
  double lower = 0;         // H0 at or below
  double upper = 0;         // H1 at or above
  std::uint32_t pairs = 0;  // counted, up to the verdict
  PairCounts counts{};      // of these pairs
};

// The generalised sequential probability ratio test (Wald 1945 with the maximum likelihood of
// each hypothesis) over pairs in this order; what comes after the verdict does not count. Goes on
// from `so_far`, the state after the pairs before these.
[[nodiscard]] SprtState sprt(const std::vector<double>& scores, const SprtSettings& settings,
                             const SprtState& so_far = {});

// The log likelihood ratio of these pairs.
[[nodiscard]] double pair_log_likelihood_ratio(const PairCounts& counts,
                                               const SprtSettings& settings);

}  // namespace poolhall::ratings
