// One step of an ordinary differential equation by Gragg's modified midpoint rule, extrapolated
// to step size zero (Bulirsch, Stoer 1966; Hairer, Norsett, Wanner, Solving ODEs I, II.9). Of
// order 2 x columns for smooth right-hand sides, with + - * / alone.
//
//   const auto step = extrapolated_step<6>(rate, y, h);   // y' = rate(y)
//   if (step.error <= tolerance) y = step.end;
#pragma once

#include <array>
#include <cstddef>

#include "physics/math.hpp"

namespace poolhall::physics {

template <class Real, std::size_t n>
using StateVector = std::array<Real, n>;

// y + h d
template <class Real, std::size_t n>
[[nodiscard]] StateVector<Real, n> advanced(const StateVector<Real, n>& y, const Real& h,
                                            const StateVector<Real, n>& d) {
  StateVector<Real, n> sum;
  for (std::size_t i = 0; i < n; ++i)
    sum[i] = y[i] + h * d[i];
  return sum;
}

template <class Real, std::size_t n>
struct ExtrapolatedStep {
  StateVector<Real, n> end{};
  // Largest difference between the last two extrapolations, in units of max(1, |y_i|).
  Real error{};
};

// `intervals` even; `slope` is rate(y).
template <class Real, std::size_t n, class Rate>
[[nodiscard]] StateVector<Real, n> modified_midpoint(const Rate& rate,
                                                     const StateVector<Real, n>& y,
                                                     const StateVector<Real, n>& slope,
                                                     const Real& step, int intervals) {
  const Real h = step / Real(intervals);
  const Real two_h = h + h;
  StateVector<Real, n> before = y;
  StateVector<Real, n> here = advanced(y, h, slope);
  for (int i = 1; i < intervals; ++i) {
    const StateVector<Real, n> next = advanced(before, two_h, rate(here));
    before = here;
    here = next;
  }
  const StateVector<Real, n> last = advanced(here, h, rate(here));
  StateVector<Real, n> smoothed;
  for (std::size_t i = 0; i < n; ++i)
    smoothed[i] = (before[i] + last[i]) / Real(2);
  return smoothed;
}

template <std::size_t columns, class Real, std::size_t n, class Rate>
[[nodiscard]] ExtrapolatedStep<Real, n> extrapolated_step(const Rate& rate,
                                                          const StateVector<Real, n>& y,
                                                          const Real& step) {
  const StateVector<Real, n> slope = rate(y);
  std::array<StateVector<Real, n>, columns> row{};  // the last row of the tableau
  StateVector<Real, n> previous{};
  for (std::size_t j = 0; j < columns; ++j) {
    StateVector<Real, n> entry =
        modified_midpoint(rate, y, slope, step, static_cast<int>(2 * (j + 1)));
    for (std::size_t k = 0; k <= j; ++k) {
      const StateVector<Real, n> above = row[k];
      row[k] = entry;
      if (k == j)
        break;
      // T(j,k+1) = T(j,k) + (T(j,k) - T(j-1,k)) / ((n_j / n_(j-k-1))^2 - 1)
      const Real fine(static_cast<int>(j + 1));
      const Real coarse(static_cast<int>(j - k));
      const Real weight = coarse * coarse / (fine * fine - coarse * coarse);
      previous = entry;
      for (std::size_t i = 0; i < n; ++i)
        entry[i] = entry[i] + weight * (entry[i] - above[i]);
    }
  }
  ExtrapolatedStep<Real, n> result{row[columns - 1], Real(0)};
  for (std::size_t i = 0; i < n; ++i) {
    const Real size = absolute(y[i]);
    const Real difference =
        absolute(Real(result.end[i] - previous[i])) / (size > Real(1) ? size : Real(1));
    // Written so that what is not a number counts as an error.
    if (!(difference <= result.error))
      result.error = difference;
  }
  return result;
}

}  // namespace poolhall::physics
