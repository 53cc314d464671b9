#include "server/ratings/sprt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "server/ratings/normal.hpp"

namespace poolhall::ratings {
namespace {

constexpr std::size_t outcomes = 5;
// Outcomes that have not come yet weigh this many pairs, so that every mean is possible.
constexpr double unseen = 1e-3;
// A verdict needs so many pairs: the shares of the outcomes are estimates.
constexpr std::uint32_t least_pairs = 16;

using Shares = std::array<double, outcomes>;

double score_of(double elo) {
  return 1 / (1 + std::pow(10.0, -elo / 400));
}

double elo_of(double score) {
  if (score <= 0 || score >= 1) {
    const double infinite = std::numeric_limits<double>::infinity();
    return score <= 0 ? -infinite : infinite;
  }
  return -400 * std::log10(1 / score - 1);
}

double score_at(std::size_t outcome) {
  return static_cast<double>(outcome) / (outcomes - 1);
}

// The root of sum p_i d_i / (1 + t d_i), where the outcomes' most likely shares with mean `mean`
// are p_i / (1 + t d_i), d_i = score_i - mean (Owen 1988, empirical likelihood of a mean).
double tilt(const Shares& shares, double mean) {
  double low = -1 / (1 - mean);
  double high = 1 / mean;
  for (int i = 0; i < 64; ++i) {  // to the last bit
    const double middle = (low + high) / 2;
    double sum = 0;
    for (std::size_t k = 0; k < outcomes; ++k) {
      const double d = score_at(k) - mean;
      sum += shares[k] * d / (1 + middle * d);
    }
    (sum > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

std::uint32_t PairCounts::pairs() const {
  return std::accumulate(by_points.begin(), by_points.end(), 0U);
}

PairCounts pair_counts(const std::vector<double>& scores) {
  PairCounts counts;
  for (std::size_t i = 0; i + 1 < scores.size(); i += 2) {
    ++counts.by_points[static_cast<std::size_t>(std::lround(2 * (scores[i] + scores[i + 1])))];
  }
  return counts;
}

PairStatistics pair_statistics(const PairCounts& counts) {
  PairStatistics statistics;
  const double pairs = counts.pairs();
  if (pairs < 1) {
    return statistics;
  }
  double sum = 0;
  double squares = 0;
  for (std::size_t k = 0; k < outcomes; ++k) {
    sum += counts.by_points[k] * score_at(k);
    squares += counts.by_points[k] * score_at(k) * score_at(k);
  }
  statistics.score = sum / pairs;
  const double variance =
      pairs > 1 ? std::max(0.0, squares - pairs * statistics.score * statistics.score) / (pairs - 1)
                : 0.25;
  statistics.standard_error = std::sqrt(variance / pairs);
  const double margin = normal_quantile_975 * statistics.standard_error;
  statistics.elo = elo_of(statistics.score);
  statistics.elo_low = elo_of(statistics.score - margin);
  statistics.elo_high = elo_of(statistics.score + margin);
  const double lead = statistics.score - 0.5;
  if (statistics.standard_error > 0) {
    statistics.superiority =
        0.5 * std::erfc(-lead / statistics.standard_error / std::numbers::sqrt2);
  } else if (lead != 0) {
    statistics.superiority = lead > 0 ? 1 : 0;
  }
  return statistics;
}

double pair_log_likelihood_ratio(const PairCounts& counts, const SprtSettings& settings) {
  Shares shares{};
  double pairs = 0;
  for (std::size_t k = 0; k < outcomes; ++k) {
    shares[k] = std::max<double>(counts.by_points[k], k % 2 == 0 ? unseen : 0);
    pairs += shares[k];
  }
  for (double& share : shares) {
    share /= pairs;
  }
  const double mean0 = score_of(settings.elo0);
  const double mean1 = score_of(settings.elo1);
  const double tilt0 = tilt(shares, mean0);
  const double tilt1 = tilt(shares, mean1);
  double ratio = 0;
  for (std::size_t k = 0; k < outcomes; ++k) {
    if (shares[k] > 0) {
      ratio += shares[k] * (std::log1p(tilt0 * (score_at(k) - mean0)) -
                            std::log1p(tilt1 * (score_at(k) - mean1)));
    }
  }
  return pairs * ratio;
}

SprtState sprt(const std::vector<double>& scores, const SprtSettings& settings,
               const SprtState& so_far) {
  SprtState state = so_far;
  state.lower = std::log(settings.beta / (1 - settings.alpha));
  state.upper = std::log((1 - settings.beta) / settings.alpha);
  for (std::size_t i = 0; i + 1 < scores.size() && state.verdict == SprtVerdict::undecided;
       i += 2) {
    ++state.counts
          .by_points[static_cast<std::size_t>(std::lround(2 * (scores[i] + scores[i + 1])))];
    ++state.pairs;
    state.log_likelihood_ratio = pair_log_likelihood_ratio(state.counts, settings);
    if (state.pairs < least_pairs) {
      continue;
    }
    if (state.log_likelihood_ratio <= state.lower || state.log_likelihood_ratio >= state.upper) {
      state.verdict = state.log_likelihood_ratio >= state.upper ? SprtVerdict::h1 : SprtVerdict::h0;
    }
  }
  return state;
}

}  // namespace poolhall::ratings
