#include "rules/rack.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace poolhall::rules {
namespace {

using physics::Vec2;

constexpr double infinity = std::numeric_limits<double>::infinity();

// x of a row's balls, symmetric about `middle`, neighbours at least `pitch` apart as computed.
std::vector<double> row_across(std::size_t count, double middle, double pitch) {
  std::vector<double> xs(count, middle);
  const std::size_t half = count / 2;
  double right = middle;
  double left = middle;
  for (std::size_t k = 0; k < half; ++k) {
    const bool first_of_even = k == 0 && count % 2 == 0;
    const double step = first_of_even ? pitch / 2 : pitch;
    double next_right = right + step;
    double next_left = left - step;
    while (first_of_even ? next_right - next_left < pitch : next_right - right < pitch) {
      next_right = std::nextafter(next_right, infinity);
    }
    while (!first_of_even && left - next_left < pitch) {
      next_left = std::nextafter(next_left, -infinity);
    }
    right = next_right;
    left = next_left;
    xs[count - half + k] = right;
    xs[half - 1 - k] = left;
  }
  return xs;
}

bool apart(const std::vector<Vec2<double>>& row, const std::vector<Vec2<double>>& before,
           double pitch) {
  return std::all_of(row.begin(), row.end(), [&](const Vec2<double>& p) {
    return std::all_of(before.begin(), before.end(), [&](const Vec2<double>& q) {
      return dot(p - q, p - q) >= pitch * pitch && std::sqrt(dot(p - q, p - q)) >= pitch;
    });
  });
}

std::vector<Vec2<double>> lattice(const std::vector<std::size_t>& rows, double pitch,
                                  const physics::Table& table) {
  std::vector<Vec2<double>> places;
  std::vector<Vec2<double>> before;
  double y = table.foot_spot_y;
  for (const std::size_t count : rows) {
    if (!before.empty()) {
      y += std::sqrt(0.75) * pitch;
    }
    std::vector<Vec2<double>> row;
    for (const double x : row_across(count, table.foot_spot_x, pitch)) {
      row.push_back({x, y});
    }
    while (!apart(row, before, pitch)) {
      y = std::nextafter(y, infinity);
      for (Vec2<double>& place : row) {
        place.y = y;
      }
    }
    places.insert(places.end(), row.begin(), row.end());
    before = row;
  }
  return places;
}

}  // namespace

std::uint64_t RackRandom::bits() {
  const r123::Philox4x32 philox;
  const r123::Philox4x32::ctr_type counter{{drawn_, rack_, 0, 0}};
  const r123::Philox4x32::key_type key{
      {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
  const r123::Philox4x32::ctr_type drawn = philox(counter, key);
  ++drawn_;
  return (std::uint64_t{drawn[1]} << 32) | drawn[0];
}

std::size_t RackRandom::below(std::size_t bound) {
  const std::uint64_t n = bound;
  // The largest multiple of n: what lies above would favour small numbers.
  const std::uint64_t limit = std::numeric_limits<std::uint64_t>::max() / n * n;
  std::uint64_t drawn = bits();
  while (drawn >= limit) {
    drawn = bits();
  }
  return static_cast<std::size_t>(drawn % n);
}

double RackRandom::symmetric() {
  return static_cast<double>(bits() >> 11) * 0x1p-52 - 1.0;
}

std::vector<Vec2<double>> rack_places(const std::vector<std::size_t>& rows,
                                      const GameSettings& settings, RackRandom& random,
                                      const physics::Table& table,
                                      const physics::Materials& materials) {
  // Two neighbours, displaced towards each other by the jitter in x and in y, come nearer by at
  // most 2 sqrt(2) jitter; the last factor is for rounding.
  const double room = 2 * std::sqrt(2.0) * settings.rack_jitter * (1 + 1e-9);
  const double pitch = 2 * materials.ball_radius + std::max(settings.rack_gap, room);
  std::vector<Vec2<double>> places = lattice(rows, pitch, table);
  if (settings.rack_jitter > 0) {
    for (Vec2<double>& place : places) {
      place.x += settings.rack_jitter * random.symmetric();
      place.y += settings.rack_jitter * random.symmetric();
    }
  }
  return places;
}

}  // namespace poolhall::rules
