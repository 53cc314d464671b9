#include "tests/support/simulated_ratings.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "server/ratings/bradley_terry.hpp"

namespace poolhall::test_support {
namespace {

constexpr std::array<double, 4> strengths{120, 30, -40, -110};  // Elo, mean 0
constexpr double break_bonus = 60;
constexpr double rack_effect = 150;
constexpr std::size_t most_pairs = 20'000;

double win_probability(double elo) {
  return 1 / (1 + std::pow(10.0, -elo / 400));
}

class Coins {
 public:
  explicit Coins(std::uint64_t seed) : random_(seed) {}
  [[nodiscard]] bool happens(double chance) {
    return static_cast<double>(random_() >> 11U) * 0x1p-53 < chance;
  }

 private:
  std::mt19937_64 random_;
};

void add_pair(Coins& coins, Rack rack, std::size_t one, std::size_t two,
              std::vector<ratings::RatedGame>& games) {
  const bool good = coins.happens(0.5);
  const double effect = rack == Rack::independent ? 0 : good ? rack_effect : -rack_effect;
  const std::uint64_t pair = games.size();
  for (const auto& [breaker, other] : {std::pair(one, two), std::pair(two, one)}) {
    const double elo = strengths[breaker] - strengths[other] + break_bonus + effect;
    games.push_back({breaker, other, coins.happens(win_probability(elo)) ? 1.0 : 0.0, 1, pair});
  }
}

// The strengths that games with racks like these show: differences of 400 Elo mean odds of ten to
// one over racks, which is what the model is about; found by a tournament without end.
std::array<double, 4> shown_strengths(Rack rack) {
  if (rack == Rack::independent) {
    return strengths;
  }
  std::vector<ratings::RatedGame> games;
  constexpr std::uint32_t many = 1'000'000;
  for (std::size_t one = 0; one < strengths.size(); ++one) {
    for (std::size_t two = 0; two < strengths.size(); ++two) {
      if (one == two) {
        continue;
      }
      double chance = 0;
      for (const double effect : {rack_effect, -rack_effect}) {
        chance += win_probability(strengths[one] - strengths[two] + break_bonus + effect) / 2;
      }
      const auto won = static_cast<std::uint32_t>(std::lround(chance * many));
      games.push_back({one, two, 1, won});
      games.push_back({one, two, 0, many - won});
    }
  }
  const ratings::RatingTable table = ratings::bradley_terry(strengths.size(), games);
  std::array<double, 4> shown{};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    shown[i] = table.players[i].rated->elo;
  }
  return shown;
}

// Scores of the first of two players with a true difference of `elo`: racks good for the break,
// the breaks in turn.
std::vector<double> simulated_scores(Coins& coins, double elo, std::size_t pairs) {
  // The mean score over both breaks is the one that the difference means.
  const double mean = win_probability(elo);
  const double tilt = 0.08;
  std::vector<double> scores;
  for (std::size_t i = 0; i < pairs; ++i) {
    scores.push_back(coins.happens(mean + tilt) ? 1 : 0);
    scores.push_back(coins.happens(mean - tilt) ? 1 : 0);
  }
  return scores;
}

}  // namespace

Coverage interval_coverage(Rack rack, std::size_t tournaments, std::size_t games,
                           std::uint64_t seed) {
  Coins coins(seed);
  const std::array<double, 4> truth = shown_strengths(rack);
  Coverage coverage;
  for (std::size_t i = 0; i < tournaments; ++i) {
    std::vector<ratings::RatedGame> played;
    for (std::size_t one = 0; one < strengths.size(); ++one) {
      for (std::size_t two = one + 1; two < strengths.size(); ++two) {
        for (std::size_t pair = 0; pair < games / 2; ++pair) {
          add_pair(coins, rack, one, two, played);
        }
      }
    }
    const ratings::RatingTable table = ratings::bradley_terry(strengths.size(), played);
    for (std::size_t player = 0; player < strengths.size(); ++player) {
      const auto& rated = table.players[player].rated;
      ++coverage.intervals;
      coverage.covered += rated && std::abs(rated->elo - truth[player]) <= rated->margin ? 1U : 0U;
    }
  }
  return coverage;
}

SprtErrors sprt_errors(const ratings::SprtSettings& settings, std::size_t trials,
                       std::uint64_t seed) {
  Coins coins(seed);
  SprtErrors errors;
  double pairs = 0;
  for (std::size_t trial = 0; trial < 2 * trials; ++trial) {
    const bool h0_holds = trial < trials;
    std::vector<double> scores;
    ratings::SprtState state;
    // More games are played only as long as they are needed.
    for (std::size_t chunk = 256; scores.size() < 2 * most_pairs; chunk *= 2) {
      const auto more = simulated_scores(coins, h0_holds ? settings.elo0 : settings.elo1, chunk);
      scores.insert(scores.end(), more.begin(), more.end());
      state = ratings::sprt(scores, settings);
      if (state.verdict != ratings::SprtVerdict::undecided) {
        break;
      }
    }
    pairs += state.pairs;
    errors.undecided += state.verdict == ratings::SprtVerdict::undecided ? 1U : 0U;
    const double share = 1 / static_cast<double>(trials);
    errors.wrong_h1 += h0_holds && state.verdict == ratings::SprtVerdict::h1 ? share : 0;
    errors.wrong_h0 += !h0_holds && state.verdict == ratings::SprtVerdict::h0 ? share : 0;
  }
  errors.mean_pairs = pairs / static_cast<double>(2 * trials);
  return errors;
}

}  // namespace poolhall::test_support
