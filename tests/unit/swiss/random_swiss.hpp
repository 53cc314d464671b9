// A Swiss tournament with results from a pinned random generator: draws, byes, absences with half
// a point or none, withdrawals, late entries and forfeits.
//
//   RandomSwiss swiss(16, 7);
//   while (swiss.next_round()) check(swiss);
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "server/tournament/swiss_history.hpp"
#include "server/tournament/swiss_pairing.hpp"

namespace poolhall::tournament {

class RandomSwiss {
 public:
  RandomSwiss(std::size_t entries, std::uint64_t seed);

  // Draws who is there and pairs them; false when all rounds are played or fewer than two are
  // left. The round before is played first.
  [[nodiscard]] bool next_round();

  // Before this round's games.
  [[nodiscard]] const std::vector<SwissEntry>& entries() const { return entries_; }
  [[nodiscard]] const std::vector<EntryId>& present() const { return present_; }
  [[nodiscard]] std::vector<SwissPlayer> players() const;
  [[nodiscard]] const SwissPairings& pairings() const { return pairings_; }
  [[nodiscard]] SwissTerms terms() const { return {.rounds = rounds_}; }

 private:
  [[nodiscard]] bool happens(double chance);
  void play();

  std::mt19937_64 random_;
  std::uint32_t rounds_;
  std::vector<SwissEntry> entries_;
  std::vector<bool> withdrawn_;
  std::vector<std::size_t> from_round_;
  std::vector<EntryId> present_;
  std::vector<RoundKind> away_;  // of those not present, by entry
  SwissPairings pairings_;
  bool paired_ = false;
};

// ceil(log2 n) + 1.
[[nodiscard]] std::uint32_t swiss_rounds(std::size_t entries);

}  // namespace poolhall::tournament
