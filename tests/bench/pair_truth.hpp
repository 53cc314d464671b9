// The exact answer to when two discs first meet, found without any code of the solvers: the
// expanded gap, every critical point isolated, the sign at each proven against the rounding that
// it may carry, in 64 bits where those suffice, then in 113, and by the reference in 332.
//
//   PairTruth truth = true_contact(pair);
//   truth.contact;                          // whether there is one in [0, horizon]
//   agrees(truth, 0.25);                    // whether a solver's answer is that one
//   is_marginal(pair, std::nullopt, 1);     // whether a change of an ulp makes this answer right
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>

#include "tests/bench/pair_classes.hpp"

namespace poolhall::bench {

// 113 bits.
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;

enum class DecidedBy : std::uint8_t { bits_64, bits_113, bits_332 };

// The first time at which the discs touch or overlap and come closer.
struct PairTruth {
  bool contact = false;
  Quad t = 0;             // s
  long double from = 0;   // s, the gap falls all the way from here, where it is largest or time
  long double until = 0;  // begins, to here
  DecidedBy decided_by = DecidedBy::bits_64;
};

[[nodiscard]] PairTruth true_contact(const DiscPair& pair);

// Right is a time on the stretch on which the gap falls through the true one, 1e-12 s more or less:
// another root lies on another stretch. How far off it is on its own is another question.
[[nodiscard]] bool agrees(const PairTruth& truth, const std::optional<long double>& answer);

// The centres' distance at time t less 2R, m.
[[nodiscard]] long double gap_in_metres(const DiscPair& pair, long double t);

// Whether `answer`, wrong for `pair`, is right when each number of the pair changes by at most so
// many units in its last place: then what decides is less than the input can say.
[[nodiscard]] bool is_marginal(const DiscPair& pair, const std::optional<long double>& answer,
                               int ulps);

}  // namespace poolhall::bench
