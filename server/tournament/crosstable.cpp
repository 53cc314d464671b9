#include "server/tournament/crosstable.hpp"

namespace poolhall::tournament {

void Crosstable::add(const PlayedGame& game) {
  for (const auto& [entry, opponent] :
       {std::pair(game.breaker, game.other), std::pair(game.other, game.breaker)}) {
    CrosstableCell& cell = cells_[index(entry) * entries_ + index(opponent)];
    cell.points += score_of(game, entry);
    ++cell.games;
  }
}

Crosstable crosstable(std::size_t entries, const std::vector<PlayedGame>& games) {
  Crosstable table(entries);
  for (const PlayedGame& game : games) {
    table.add(game);
  }
  return table;
}

}  // namespace poolhall::tournament
