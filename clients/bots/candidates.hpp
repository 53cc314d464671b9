// Where greedy's shots come from: breaks, straight pots, and headings all around the table.
//
//   std::vector<Candidate> pots = straight_pots(turn, rehearsal, budget);
//   std::optional<Candidate> best = most_valuable(std::move(pots), rehearsal, budget);
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/bots/greedy_bot.hpp"
#include "clients/bots/rehearsal.hpp"

namespace poolhall::bots {

// Each stops adding once the rehearsal has spent `budget` events in all.
[[nodiscard]] std::vector<Candidate> breaks(const client::TurnView& turn, Rehearsal& rehearsal,
                                            std::uint64_t budget);
[[nodiscard]] std::vector<Candidate> straight_pots(const client::TurnView& turn,
                                                   Rehearsal& rehearsal, std::uint64_t budget);
// Safeties, and pots by way of rails and other balls where a heading happens to find one.
[[nodiscard]] std::vector<Candidate> all_around(const client::TurnView& turn, Rehearsal& rehearsal,
                                                Dice& dice, std::uint64_t budget);

// The best by successive halving: all candidates meet a few samples of the noise, the better half
// twice as many, and so on until the budget or the samples are used up.
[[nodiscard]] std::optional<Candidate> most_valuable(std::vector<Candidate> candidates,
                                                     Rehearsal& rehearsal, std::uint64_t budget);

}  // namespace poolhall::bots
