#include "server/ratings/connected_groups.hpp"

#include <algorithm>
#include <limits>

namespace poolhall::ratings {
namespace {

using Edges = std::vector<std::vector<std::size_t>>;

struct ScoredAgainst {
  Edges forward;   // from the one who scored
  Edges backward;  // from the one who was scored against
};

ScoredAgainst scored_against(std::size_t players, const std::vector<RatedGame>& games) {
  ScoredAgainst edges{Edges(players), Edges(players)};
  const auto add = [&](std::size_t from, std::size_t to) {
    edges.forward[from].push_back(to);
    edges.backward[to].push_back(from);
  };
  for (const RatedGame& game : games) {
    if (game.count > 0 && game.score > 0) {
      add(game.breaker, game.other);
    }
    if (game.count > 0 && game.score < 1) {
      add(game.other, game.breaker);
    }
  }
  return edges;
}

std::vector<bool> reached_from(std::size_t start, const Edges& edges) {
  std::vector<bool> reached(edges.size(), false);
  std::vector<std::size_t> open{start};
  reached[start] = true;
  while (!open.empty()) {
    const std::size_t player = open.back();
    open.pop_back();
    for (const std::size_t next : edges[player]) {
      if (!reached[next]) {
        reached[next] = true;
        open.push_back(next);
      }
    }
  }
  return reached;
}

}  // namespace

std::vector<std::size_t> connected_groups(std::size_t players,
                                          const std::vector<RatedGame>& games) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const ScoredAgainst edges = scored_against(players, games);
  std::vector<std::size_t> group(players, none);
  std::size_t groups = 0;
  for (std::size_t first = 0; first < players; ++first) {
    if (group[first] != none) {
      continue;
    }
    const std::vector<bool> forward = reached_from(first, edges.forward);
    const std::vector<bool> backward = reached_from(first, edges.backward);
    for (std::size_t other = first; other < players; ++other) {
      if (forward[other] && backward[other]) {
        group[other] = groups;
      }
    }
    ++groups;
  }
  return group;
}

}  // namespace poolhall::ratings
