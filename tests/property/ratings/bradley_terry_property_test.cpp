#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "server/ratings/bradley_terry.hpp"

namespace poolhall::ratings {
namespace {

struct Results {
  std::size_t players;
  std::vector<RatedGame> games;
};

Results any_results() {
  Results results{*rc::gen::inRange<std::size_t>(2, 7), {}};
  const auto count = *rc::gen::inRange<std::size_t>(0, 60);
  for (std::size_t i = 0; i < count; ++i) {
    const auto breaker = *rc::gen::inRange<std::size_t>(0, results.players);
    const auto step = *rc::gen::inRange<std::size_t>(1, results.players);
    results.games.push_back({breaker, (breaker + step) % results.players,
                             *rc::gen::element(0.0, 0.5, 1.0),
                             *rc::gen::inRange<std::uint32_t>(1, 4)});
  }
  return results;
}

// At the maximum every group's expected score equals its score, player by player.
double residual(const Results& results, const RatingTable& table, std::size_t player) {
  const double advantage = table.break_advantage ? table.break_advantage->elo : 0;
  double sum = 0;
  for (const RatedGame& game : results.games) {
    const PlayerRating& breaker = table.players[game.breaker];
    const PlayerRating& other = table.players[game.other];
    const bool concerns = game.breaker == player || game.other == player;
    if (!concerns || !breaker.rated || !other.rated || breaker.group != other.group) {
      continue;
    }
    const double expected =
        1 / (1 + std::pow(10, -(breaker.rated->elo - other.rated->elo + advantage) / 400));
    sum += (game.breaker == player ? 1.0 : -1.0) * game.count * (game.score - expected);
  }
  return sum;
}

RC_GTEST_PROP(BradleyTerryProperty, TheScoresExpectedOfRatedPlayersAreThoseTheyMade, ()) {
  const Results results = any_results();
  const RatingTable table = bradley_terry(results.players, results.games);
  for (std::size_t player = 0; player < results.players; ++player) {
    if (table.players[player].rated) {
      RC_ASSERT(std::isfinite(table.players[player].rated->elo));
      RC_ASSERT(table.players[player].rated->margin > 0);
      RC_ASSERT(std::abs(residual(results, table, player)) < 1e-6);
    }
  }
}

RC_GTEST_PROP(BradleyTerryProperty, RenumberingThePlayersRenumbersTheRatings, ()) {
  const Results results = any_results();
  const RatingTable table = bradley_terry(results.players, results.games);
  Results turned = results;
  for (RatedGame& game : turned.games) {
    game.breaker = results.players - 1 - game.breaker;
    game.other = results.players - 1 - game.other;
  }
  const RatingTable turned_table = bradley_terry(turned.players, turned.games);
  for (std::size_t player = 0; player < results.players; ++player) {
    const PlayerRating& one = table.players[player];
    const PlayerRating& two = turned_table.players[results.players - 1 - player];
    RC_ASSERT(one.status == two.status);
    RC_ASSERT(one.rated.has_value() == two.rated.has_value());
    if (one.rated) {
      RC_ASSERT(std::abs(one.rated->elo - two.rated->elo) < 1e-6);
      RC_ASSERT(std::abs(one.rated->margin - two.rated->margin) < 1e-6);
    }
  }
}

}  // namespace
}  // namespace poolhall::ratings
