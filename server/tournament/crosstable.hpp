// Who scored what against whom.
//
//   Crosstable table = crosstable(3, games);
//   table.at(entry_id(0), entry_id(1)).points;
#pragma once

#include <cstdint>
#include <vector>

#include "server/tournament/played_game.hpp"

namespace poolhall::tournament {

struct CrosstableCell {
  double points = 0;
  std::uint32_t games = 0;
};

class Crosstable {
 public:
  explicit Crosstable(std::size_t entries) : entries_(entries), cells_(entries * entries) {}

  [[nodiscard]] std::size_t entries() const { return entries_; }
  // What `entry` scored against `opponent`.
  [[nodiscard]] const CrosstableCell& at(EntryId entry, EntryId opponent) const {
    return cells_[index(entry) * entries_ + index(opponent)];
  }
  void add(const PlayedGame& game);

 private:
  std::size_t entries_;
  std::vector<CrosstableCell> cells_;
};

[[nodiscard]] Crosstable crosstable(std::size_t entries, const std::vector<PlayedGame>& games);

}  // namespace poolhall::tournament
