#include "server/ratings/bradley_terry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Dense>

#include "server/ratings/connected_groups.hpp"
#include "server/ratings/normal.hpp"

namespace poolhall::ratings {
namespace {

constexpr double elo_per_logit = 400 / std::numbers::ln10;
constexpr int max_newton_steps = 100;
constexpr double least_pairs_per_unknown = 10;
constexpr double step_tolerance = 1e-9;  // logits; the error left is about its square

// Unknowns: the strength of each player that has one, in logits, and then perhaps the advantage
// of the break. Each group of players has mean 0.
struct Problem {
  std::vector<RatedGame> games;                   // players are indices of unknowns
  std::vector<std::vector<Eigen::Index>> groups;  // unknowns by group
  Eigen::Index players = 0;
  bool with_break = false;

  [[nodiscard]] Eigen::Index unknowns() const { return players + (with_break ? 1 : 0); }
};

struct Fit {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
};

Eigen::Index index_of(std::size_t player) {
  return static_cast<Eigen::Index>(player);
}

double advantage(const Problem& problem, const Eigen::VectorXd& values, const RatedGame& game) {
  return values[index_of(game.breaker)] - values[index_of(game.other)] +
         (problem.with_break ? values[problem.players] : 0);
}

// log(1 / (1 + e^-x)) without overflow.
double log_logistic(double x) {
  return x < 0 ? x - std::log1p(std::exp(x)) : -std::log1p(std::exp(-x));
}

double log_likelihood(const Problem& problem, const Eigen::VectorXd& values) {
  double sum = 0;
  for (const RatedGame& game : problem.games) {
    const double x = advantage(problem, values, game);
    sum += game.count * (game.score * log_logistic(x) + (1 - game.score) * log_logistic(-x));
  }
  return sum;
}

// The few unknowns that a game or a pair tells about, each with its coefficient.
using Terms = std::vector<std::pair<Eigen::Index, double>>;

Terms direction_of(const Problem& problem, const RatedGame& game) {
  Terms direction{{index_of(game.breaker), 1}, {index_of(game.other), -1}};
  if (problem.with_break) {
    direction.emplace_back(problem.players, 1);
  }
  return direction;
}

// Adds `weight` times the square of the terms.
void add_square(const Terms& terms, double weight, Eigen::MatrixXd& matrix) {
  for (const auto& [row, one] : terms) {
    for (const auto& [column, other] : terms) {
      matrix(row, column) += weight * one * other;
    }
  }
}

double win_probability(const Problem& problem, const Eigen::VectorXd& values,
                       const RatedGame& game) {
  return 1 / (1 + std::exp(-advantage(problem, values, game)));
}

struct Derivatives {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;  // minus the second derivatives
};

Derivatives derivatives(const Problem& problem, const Eigen::VectorXd& values) {
  const Eigen::Index n = problem.unknowns();
  Derivatives d{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  for (const RatedGame& game : problem.games) {
    const double p = win_probability(problem, values, game);
    const Terms direction = direction_of(problem, game);
    for (const auto& [unknown, coefficient] : direction) {
      d.gradient[unknown] += game.count * (game.score - p) * coefficient;
    }
    add_square(direction, game.count * p * (1 - p), d.information);
  }
  return d;
}

// The likelihood does not change when a whole group moves; adding the square of each group's sum
// fixes its mean at 0 and leaves everything else as it is.
void fix_means(const Problem& problem, Eigen::MatrixXd& information) {
  for (const auto& group : problem.groups) {
    for (const Eigen::Index i : group) {
      for (const Eigen::Index j : group) {
        information(i, j) += 1;
      }
    }
  }
}

// Takes the added squares out of the inverse again: they gave each group's mean a variance.
void release_means(const Problem& problem, Eigen::MatrixXd& covariance) {
  for (const auto& group : problem.groups) {
    const auto size = static_cast<double>(group.size());
    for (const Eigen::Index i : group) {
      for (const Eigen::Index j : group) {
        covariance(i, j) -= 1 / (size * size);
      }
    }
  }
}

// Whether each unknown has pairs enough: those of others say nothing about its games.
bool are_enough(const std::map<std::uint64_t, Terms>& pairs, Eigen::Index unknowns) {
  Eigen::VectorXd own = Eigen::VectorXd::Zero(unknowns);
  for (const auto& [pair, terms] : pairs) {
    for (const auto& [unknown, value] : terms) {
      own[unknown] += 1;
    }
  }
  return static_cast<double>(pairs.size()) >=
             least_pairs_per_unknown * static_cast<double>(unknowns) &&
         own.minCoeff() >= least_pairs_per_unknown;
}

// The sums of the score function over each pair; nothing unless there are pairs enough.
std::optional<Eigen::MatrixXd> pair_scores(const Problem& problem, const Eigen::VectorXd& values) {
  std::map<std::uint64_t, Terms> sums;
  for (const RatedGame& game : problem.games) {
    if (!game.pair || game.count != 1) {
      return std::nullopt;
    }
    const double residual = game.score - win_probability(problem, values, game);
    Terms& sum = sums[*game.pair];
    for (const auto& [unknown, coefficient] : direction_of(problem, game)) {
      const auto known =
          std::find_if(sum.begin(), sum.end(),
                       [unknown = unknown](const auto& term) { return term.first == unknown; });
      if (known == sum.end()) {
        sum.emplace_back(unknown, residual * coefficient);
      } else {
        known->second += residual * coefficient;
      }
    }
  }
  const auto pairs = static_cast<double>(sums.size());
  if (!are_enough(sums, problem.unknowns())) {
    return std::nullopt;
  }
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(problem.unknowns(), problem.unknowns());
  for (const auto& [pair, sum] : sums) {
    add_square(sum, 1, meat);
  }
  // The usual correction for as many estimated unknowns as there are.
  return meat * (pairs / (pairs - static_cast<double>(problem.unknowns())));
}

// Newton's method on the concave likelihood, steps halved until they do not lose. Nothing when
// there is no finite maximum or it is not unique.
std::optional<Fit> maximise(const Problem& problem) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(problem.unknowns());
  double likelihood = log_likelihood(problem, values);
  for (int iteration = 0; iteration < max_newton_steps; ++iteration) {
    Derivatives d = derivatives(problem, values);
    fix_means(problem, d.information);
    const Eigen::LLT<Eigen::MatrixXd> factors(d.information);
    if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-12)) {
      return std::nullopt;
    }
    Eigen::VectorXd step = factors.solve(d.gradient);
    // Where there is no maximum the steps stay near 1 for ever, so this one is near it.
    if (step.cwiseAbs().maxCoeff() <= step_tolerance) {
      Eigen::MatrixXd covariance =
          factors.solve(Eigen::MatrixXd::Identity(problem.unknowns(), problem.unknowns()));
      if (const auto meat = pair_scores(problem, values + step)) {
        const Eigen::MatrixXd over_pairs = covariance * *meat * covariance;
        // Pairs that are all alike, as where each is split, do not tell how sure a rating is.
        if ((over_pairs.diagonal().array() > 1e-9 * covariance.diagonal().array()).all()) {
          return Fit{values + step, over_pairs};
        }
      }
      release_means(problem, covariance);
      return Fit{values + step, covariance};
    }
    const double rounding = 1e-12 * (1 + std::abs(likelihood));
    while (log_likelihood(problem, values + step) < likelihood - rounding) {
      step /= 2;
    }
    values += step;
    likelihood = log_likelihood(problem, values);
  }
  return std::nullopt;
}

RatingStatus status_without_rating(std::size_t player, const std::vector<RatedGame>& games) {
  double played = 0;
  double scored = 0;
  for (const RatedGame& game : games) {
    if (game.breaker == player || game.other == player) {
      played += game.count;
      scored += game.count * (game.breaker == player ? game.score : 1 - game.score);
    }
  }
  if (played == 0) {
    return RatingStatus::no_games;
  }
  if (scored == played) {
    return RatingStatus::won_everything;
  }
  return scored == 0 ? RatingStatus::lost_everything : RatingStatus::unconnected;
}

struct Compared {
  Problem problem;
  std::vector<std::optional<Eigen::Index>> unknown_of;  // by player
};

// The part of the results that maximum likelihood can tell about: games inside groups.
Compared comparable(std::size_t players, const std::vector<std::size_t>& group,
                    const std::vector<RatedGame>& games) {
  Compared compared{{}, std::vector<std::optional<Eigen::Index>>(players)};
  std::vector<std::vector<Eigen::Index>> groups(players);
  for (std::size_t player = 0; player < players; ++player) {
    if (std::count(group.begin(), group.end(), group[player]) > 1) {
      compared.unknown_of[player] = compared.problem.players++;
      groups[group[player]].push_back(*compared.unknown_of[player]);
    }
  }
  std::copy_if(groups.begin(), groups.end(), std::back_inserter(compared.problem.groups),
               [](const auto& members) { return !members.empty(); });
  for (RatedGame game : games) {
    if (game.count > 0 && group[game.breaker] == group[game.other]) {
      game.breaker = static_cast<std::size_t>(*compared.unknown_of[game.breaker]);
      game.other = static_cast<std::size_t>(*compared.unknown_of[game.other]);
      compared.problem.games.push_back(game);
    }
  }
  return compared;
}

Estimate estimate(const Fit& fit, Eigen::Index unknown) {
  return {elo_per_logit * fit.values[unknown],
          elo_per_logit * normal_quantile_975 * std::sqrt(fit.covariance(unknown, unknown))};
}

}  // namespace

RatingTable bradley_terry(std::size_t players, const std::vector<RatedGame>& games) {
  RatingTable table;
  table.players.resize(players);
  table.covariance.assign(players * players, 0);
  const std::vector<std::size_t> group = connected_groups(players, games);
  Compared compared = comparable(players, group, games);
  std::optional<Fit> fit;
  if (compared.problem.players > 0) {
    compared.problem.with_break = true;
    fit = maximise(compared.problem);
    if (fit) {
      table.break_advantage = estimate(*fit, compared.problem.players);
    } else {
      compared.problem.with_break = false;
      fit = maximise(compared.problem);
    }
  }
  for (std::size_t player = 0; player < players; ++player) {
    const auto unknown = compared.unknown_of[player];
    if (unknown && fit) {
      table.players[player] = {RatingStatus::rated, estimate(*fit, *unknown), group[player]};
    } else {
      table.players[player].status = status_without_rating(player, games);
    }
    for (std::size_t other = 0; other < players && unknown && fit; ++other) {
      if (const auto second = compared.unknown_of[other]) {
        table.covariance[player * players + other] =
            elo_per_logit * elo_per_logit * fit->covariance(*unknown, *second);
      }
    }
  }
  return table;
}

std::optional<double> likelihood_of_superiority(const RatingTable& table, std::size_t a,
                                                std::size_t b) {
  const std::size_t players = table.players.size();
  const PlayerRating& one = table.players[a];
  const PlayerRating& two = table.players[b];
  if (!one.rated || !two.rated || one.group != two.group) {
    return std::nullopt;
  }
  const double variance = table.covariance[a * players + a] + table.covariance[b * players + b] -
                          2 * table.covariance[a * players + b];
  if (!(variance > 0)) {
    return std::nullopt;
  }
  return 0.5 * std::erfc((two.rated->elo - one.rated->elo) / std::sqrt(2 * variance));
}

}  // namespace poolhall::ratings
