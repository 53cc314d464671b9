// Elo ratings by maximum likelihood (Bradley & Terry 1952, with the order effect of Davidson &
// Beaver 1977 as the advantage of the break), with 95 % intervals. A pure function of results.
//
//   std::vector<RatedGame> games{{.breaker = 0, .other = 1, .score = 1}, ...};
//   RatingTable table = bradley_terry(2, games);
//   if (table.players[0].rated) use(table.players[0].rated->elo);
//
// The model: the breaker wins with probability 1 / (1 + 10^(-(E_breaker - E_other + A) / 400)).
// A draw counts as half a win for each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace poolhall::ratings {

// Alike games between two players, as often as `count` says.
struct RatedGame {
  std::size_t breaker = 0;  // index of the player who breaks
  std::size_t other = 0;
  double score = 0;  // of the breaker: 1 won, 0.5 drawn, 0 lost
  std::uint32_t count = 1;
  // Games with the same number share a rack and are not independent; unset: independent.
  std::optional<std::uint64_t> pair{};
};

struct Estimate {
  double elo = 0;
  double margin = 0;  // half of the width of the 95 % interval
};

// Why a player has no finite rating, or `rated`.
enum class RatingStatus : std::uint8_t {
  rated,
  no_games,
  won_everything,   // the likelihood grows with the rating without end
  lost_everything,  // the same downwards
  unconnected,      // won all games against some and lost all against the rest
};

struct PlayerRating {
  RatingStatus status = RatingStatus::no_games;
  std::optional<Estimate> rated{};  // when rated
  std::size_t group = 0;            // when rated: only ratings of one group can be compared
};

struct RatingTable {
  std::vector<PlayerRating> players;        // a group's mean is 0
  std::vector<double> covariance;           // Elo^2, players by players, 0 for unrated ones
  std::optional<Estimate> break_advantage;  // none: the games do not tell it; ratings are without
};

// `players` is how many there are; games name them by index. The intervals come from the covariance
// over pairs (the sandwich estimator of Huber 1967 with pairs as clusters) where every game has its
// pair, there are at least ten pairs for every unknown, each player has ten of its own, and no
// variance is 0; else from the information matrix, which takes games as independent.
[[nodiscard]] RatingTable bradley_terry(std::size_t players, const std::vector<RatedGame>& games);

// The probability that `a` is stronger than `b`, from the difference of their ratings and its
// covariance; nothing when they cannot be compared.
[[nodiscard]] std::optional<double> likelihood_of_superiority(const RatingTable& table,
                                                              std::size_t a, std::size_t b);

}  // namespace poolhall::ratings
