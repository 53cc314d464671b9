// Decides which matches go on at once: a schedule, the limits, and what has begun and ended.
// Knows nothing of clocks, sockets or storage.
//
//   Director director(round_robin(4), {.games = 2, .games_per_entry = 1});
//   for (const Pairing& pairing : director.begin_due()) start(pairing);
//   director.end(pairing.number);   // then ask again
#pragma once

#include <cstdint>
#include <vector>

#include "server/tournament/round_robin.hpp"

namespace poolhall::tournament {

// A match plays one game at a time, so these bound matches too.
struct ConcurrencyLimits {
  std::uint32_t games = 1;
  std::uint32_t games_per_entry = 1;
};

class Director {
 public:
  Director(std::vector<Pairing> schedule, ConcurrencyLimits limits);

  // Those that are due now and were not before, in the order of the schedule; they count as
  // running from here on.
  [[nodiscard]] std::vector<Pairing> begin_due();

  // A match is going on already, from an earlier run of the tournament.
  void resume(std::uint32_t pairing);

  // A match is over, whether it was begun here or in an earlier run of the tournament.
  void end(std::uint32_t pairing);

  [[nodiscard]] bool is_running(std::uint32_t pairing) const;
  [[nodiscard]] bool is_over(std::uint32_t pairing) const;
  [[nodiscard]] bool all_over() const;
  [[nodiscard]] const std::vector<Pairing>& schedule() const { return schedule_; }

 private:
  enum class Status : std::uint8_t { waiting, running, over };

  [[nodiscard]] std::uint32_t running_of(EntryId entry) const;
  [[nodiscard]] bool may_begin(const Pairing& pairing) const;

  std::vector<Pairing> schedule_;  // Pairing::number is the index
  std::vector<Status> status_;
  ConcurrencyLimits limits_;
};

}  // namespace poolhall::tournament
