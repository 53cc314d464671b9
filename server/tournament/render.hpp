// Tables and the progress line as text for a terminal of fixed-width letters: ASCII, aligned, no
// control characters, every line ended by '\n' (the progress line has no end).
//
//   std::cout << standings_text(table, names) << crosstable_text(cross, table, names);
#pragma once

#include <string>
#include <vector>

#include "server/tournament/crosstable.hpp"
#include "server/tournament/progress.hpp"
#include "server/tournament/standings.hpp"

namespace poolhall::tournament {

using Names = std::vector<std::string>;  // by entry

// Rank, name, points, won, lost, drawn, Elo with its 95 % interval, tie-breaks; below it the
// advantage of the break and what needs a word.
[[nodiscard]] std::string standings_text(const Standings& table, const Names& names);

// In the order of the standings.
[[nodiscard]] std::string crosstable_text(const Crosstable& cross, const Standings& table,
                                          const Names& names);

// "Games ended: 8 pocketed 10, timeout 2".
[[nodiscard]] std::string endings_text(const Standings& table);

// "[#####.....] 6/12 games, 2 running, 0:35 gone, about 0:40 left".
[[nodiscard]] std::string progress_text(const Progress& progress);

// 75 s is "1:15", 3700 s is "1:01:40".
[[nodiscard]] std::string duration_text(Seconds duration);

}  // namespace poolhall::tournament
