// Glicko-2 (Glickman 2013, "Example of the Glicko-2 system"): a rating that is updated after each
// period and knows how sure it is. A pure function.
//
//   Glicko2Rating after = glicko2(before, {{opponent, 1.0}}, 0.5);
#pragma once

#include <vector>

namespace poolhall::ratings {

struct Glicko2Rating {
  double rating = 1500;
  double deviation = 350;  // standard deviation of the rating
  double volatility = 0.06;
};

struct Glicko2Game {
  Glicko2Rating opponent;  // before the period
  double score = 0;        // 1 won, 0.5 drawn, 0 lost
};

// The rating after a period with these games; without games only the deviation grows. `tau`
// bounds how the volatility changes, reasonably from 0.3 to 1.2.
[[nodiscard]] Glicko2Rating glicko2(const Glicko2Rating& before,
                                    const std::vector<Glicko2Game>& games, double tau);

}  // namespace poolhall::ratings
