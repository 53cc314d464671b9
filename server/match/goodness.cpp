#include "server/match/goodness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace poolhall::match {
namespace {

constexpr std::array<const char*, 5> parameters{"a", "b", "theta", "phi", "v"};
// Fewer values say nothing.
constexpr std::size_t least_values = 8;
constexpr std::size_t cells = 16;  // of each axis of the chi-square test
constexpr std::size_t most_distance = 10;

double normal_cdf(double x) {
  return std::erfc(-x / std::sqrt(2.0)) / 2;
}

NoiseTest kolmogorov_smirnov(const std::string& name, std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double d = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = normal_cdf(sample[i]);
    d = std::max({d, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
  }
  return {"KS " + name, sample.size(), d, kolmogorov_p(d, sample.size())};
}

std::vector<double> component(const std::vector<physics::ShotDeviates>& shots, std::size_t i) {
  std::vector<double> values(shots.size());
  std::transform(shots.begin(), shots.end(), values.begin(),
                 [i](const physics::ShotDeviates& shot) { return shot[i]; });
  return values;
}

std::vector<double> all_in_order(const std::vector<physics::ShotDeviates>& shots) {
  std::vector<double> values;
  values.reserve(5 * shots.size());
  for (const physics::ShotDeviates& shot : shots)
    values.insert(values.end(), shot.begin(), shot.end());
  return values;
}

// sqrt(n) times the mean product of independent standard normal deviates is one itself, nearly.
double product_z(const std::vector<double>& x, const std::vector<double>& y, std::size_t shift) {
  const double sum = std::inner_product(x.begin(), x.end() - static_cast<std::ptrdiff_t>(shift),
                                        y.begin() + static_cast<std::ptrdiff_t>(shift), 0.0);
  return sum / std::sqrt(static_cast<double>(x.size() - shift));
}

// The sum of squares of `count` such numbers, by Wilson and Hilferty's cube root, as a test.
NoiseTest correlations(const std::string& name, std::size_t values,
                       const std::vector<double>& scores) {
  const double sum = std::inner_product(scores.begin(), scores.end(), scores.begin(), 0.0);
  return {name, values, sum, chi_square_p(sum, static_cast<double>(scores.size()))};
}

NoiseTest within_shots(const std::array<std::vector<double>, 5>& components) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = i + 1; j < 5; ++j)
      scores.push_back(product_z(components[i], components[j], 0));
  }
  return correlations("correlation within a shot", 5 * components[0].size(), scores);
}

NoiseTest between_shots(const std::array<std::vector<double>, 5>& components) {
  std::vector<double> scores;
  for (const std::vector<double>& one : components) {
    for (const std::vector<double>& other : components) {
      for (std::size_t distance = 1; distance <= most_distance; ++distance)
        scores.push_back(product_z(one, other, distance));
    }
  }
  return correlations("correlation up to 10 shots apart", 5 * components[0].size(), scores);
}

// Squares less their mean 1, over their deviation sqrt 2.
NoiseTest of_squares(const std::vector<double>& all) {
  std::vector<double> squares(all.size());
  std::transform(all.begin(), all.end(), squares.begin(),
                 [](double x) { return (x * x - 1) / std::sqrt(2.0); });
  std::vector<double> scores;
  for (std::size_t distance = 1; distance <= most_distance; ++distance)
    scores.push_back(product_z(squares, squares, distance));
  return correlations("correlation of squares", all.size(), scores);
}

// Pairs that share no value, in cells of equal probability.
NoiseTest of_neighbours(const std::vector<double>& all) {
  std::array<std::array<double, cells>, cells> counts{};
  const auto cell = [](double x) {
    return std::min(cells - 1, static_cast<std::size_t>(normal_cdf(x) * cells));
  };
  for (std::size_t i = 0; i + 1 < all.size(); i += 2)
    counts[cell(all[i])][cell(all[i + 1])] += 1;
  const std::size_t pairs = all.size() / 2;
  const double expected = static_cast<double>(pairs) / (cells * cells);
  double chi_square = 0;
  for (const auto& row : counts) {
    for (const double count : row)
      chi_square += (count - expected) * (count - expected) / expected;
  }
  return {"chi-square of neighbours, 16 x 16", all.size(), chi_square,
          chi_square_p(chi_square, cells * cells - 1)};
}

}  // namespace

double two_sided(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

// Kolmogorov's series with Stephens's correction for finite samples (J. R. Statist. Soc. B 32,
// 1970, 115-122), good to 1e-3 from n = 8.
double kolmogorov_p(double d, std::size_t n) {
  const double root = std::sqrt(static_cast<double>(n));
  const double x = (root + 0.12 + 0.11 / root) * d;
  if (x < 0.2)
    return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k)
    sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

// Wilson and Hilferty, Proc. Natl. Acad. Sci. 17 (1931) 684.
double chi_square_p(double chi_square, double degrees) {
  const double ninth = 2 / (9 * degrees);
  const double z = (std::cbrt(chi_square / degrees) - (1 - ninth)) / std::sqrt(ninth);
  return std::erfc(z / std::sqrt(2.0)) / 2;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

std::vector<NoiseTest> test_deviates(const std::vector<physics::ShotDeviates>& shots) {
  std::vector<NoiseTest> tests;
  if (shots.size() < least_values)
    return tests;
  std::array<std::vector<double>, 5> components;
  for (std::size_t i = 0; i < components.size(); ++i) {
    components[i] = component(shots, i);
    tests.push_back(kolmogorov_smirnov(parameters[i], components[i]));
  }
  const std::vector<double> all = all_in_order(shots);
  tests.push_back(kolmogorov_smirnov("all", all));
  // Sums of products are normal only of many.
  constexpr std::size_t many = 200;
  if (shots.size() < many)
    return tests;
  tests.push_back(within_shots(components));
  tests.push_back(between_shots(components));
  tests.push_back(of_squares(all));
  constexpr std::size_t least_in_a_cell = 8;
  if (all.size() / 2 >= least_in_a_cell * cells * cells)
    tests.push_back(of_neighbours(all));
  return tests;
}

bool fit_together(const std::vector<NoiseTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [&](const NoiseTest& test) {
    return test.p * static_cast<double>(tests.size()) >= 0.001;
  });
}

}  // namespace poolhall::match
