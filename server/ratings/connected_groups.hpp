// Who can be compared by maximum likelihood: two players whose wins lead from one to the other and
// back (Ford 1957), which are the strongly connected components of "scored against".
//
//   std::vector<std::size_t> group = connected_groups(players, games);
#pragma once

#include <cstddef>
#include <vector>

#include "server/ratings/bradley_terry.hpp"

namespace poolhall::ratings {

// For each player the number of its group; groups are numbered by their first member.
[[nodiscard]] std::vector<std::size_t> connected_groups(std::size_t players,
                                                        const std::vector<RatedGame>& games);

}  // namespace poolhall::ratings
