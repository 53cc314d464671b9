#include "server/ratings/glicko2.hpp"

#include <cmath>
#include <numbers>

namespace poolhall::ratings {
namespace {

// Steps and symbols are those of Glickman 2013.
constexpr double scale = 173.7178;   // step 2
constexpr double tolerance = 1e-10;  // epsilon of step 5

double g(double phi) {
  return 1 / std::sqrt(1 + 3 * phi * phi / (std::numbers::pi * std::numbers::pi));
}

struct Period {
  double v = 0;         // step 3: estimated variance of the rating from these games alone
  double delta = 0;     // step 4: estimated improvement
  double surprise = 0;  // sum of g(phi_j) (s_j - E_j)
};

Period period(double mu, const std::vector<Glicko2Game>& games) {
  double information = 0;
  Period result;
  for (const Glicko2Game& game : games) {
    const double mu_j = (game.opponent.rating - 1500) / scale;
    const double g_j = g(game.opponent.deviation / scale);
    const double expected = 1 / (1 + std::exp(-g_j * (mu - mu_j)));
    information += g_j * g_j * expected * (1 - expected);
    result.surprise += g_j * (game.score - expected);
  }
  result.v = 1 / information;
  result.delta = result.v * result.surprise;
  return result;
}

// Step 5: the root of f by the Illinois variant of regula falsi.
double new_volatility(double phi, double sigma, const Period& p, double tau) {
  const double a = std::log(sigma * sigma);
  const auto f = [&](double x) {
    const double e = std::exp(x);
    const double d = phi * phi + p.v + e;
    return e * (p.delta * p.delta - d) / (2 * d * d) - (x - a) / (tau * tau);
  };
  double low = a;
  double high = 0;
  if (p.delta * p.delta > phi * phi + p.v) {
    high = std::log(p.delta * p.delta - phi * phi - p.v);
  } else {
    double k = 1;
    while (f(a - k * tau) < 0) {
      ++k;
    }
    high = a - k * tau;
  }
  double f_low = f(low);
  double f_high = f(high);
  while (std::abs(high - low) > tolerance) {
    const double middle = low + (low - high) * f_low / (f_high - f_low);
    const double f_middle = f(middle);
    if (f_middle * f_high <= 0) {
      low = high;
      f_low = f_high;
    } else {
      f_low /= 2;
    }
    high = middle;
    f_high = f_middle;
  }
  return std::exp(low / 2);
}

}  // namespace

Glicko2Rating glicko2(const Glicko2Rating& before, const std::vector<Glicko2Game>& games,
                      double tau) {
  const double mu = (before.rating - 1500) / scale;
  const double phi = before.deviation / scale;
  if (games.empty()) {
    return {before.rating, scale * std::hypot(phi, before.volatility), before.volatility};
  }
  const Period p = period(mu, games);
  const double sigma = new_volatility(phi, before.volatility, p, tau);
  const double phi_star_squared = phi * phi + sigma * sigma;             // step 6
  const double new_phi = 1 / std::sqrt(1 / phi_star_squared + 1 / p.v);  // step 7
  const double new_mu = mu + new_phi * new_phi * p.surprise;
  return {scale * new_mu + 1500, scale * new_phi, sigma};  // step 8
}

}  // namespace poolhall::ratings
