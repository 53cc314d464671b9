// A Swiss tournament as FIDE's TRF16 (Handbook C.04 annex 2), for other people's pairing programs:
// breaking first is White, a match is a game. With the lines XXR and XXC that those programs read.
//
//   std::string text = trf16({.name = "cup", .rounds = 5}, names, schedule);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/tournament/format.hpp"
#include "server/tournament/render.hpp"
#include "server/tournament/standings.hpp"

namespace poolhall::tournament {

struct TrfHead {
  std::string name;
  std::uint32_t rounds = 0;
};

// The rounds that are over; one that goes on is left out. Ranks are those of the standings. Lines
// end with '\n'; names are cut to 33 letters.
[[nodiscard]] std::string trf16(const TrfHead& head, const Names& names, const Schedule& schedule,
                                const Standings& standings);

}  // namespace poolhall::tournament
