// Decides which matches go on at once: a schedule, the limits, and what has begun and ended.
// Knows nothing of clocks, sockets or storage.
//
//   Director director(round_robin(4), {.games = 2, .games_per_entry = 1});
//   for (const Pairing& pairing : director.begin_due()) start(pairing);
//   director.end(pairing.number);
//   director.plan(schedule(format, field, happened).pairings);   // when results make new ones
//   known
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/tournament/round_robin.hpp"

namespace poolhall::tournament {

// A match plays one game at a time, so these bound matches too.
struct ConcurrencyLimits {
  std::uint32_t games = 1;
  std::uint32_t games_per_entry = 1;
};

enum class Pace : std::uint8_t {
  free_running,  // a match begins as soon as the limits allow
  by_rounds,     // none of a round before all of the rounds before are over
};

class Director {
 public:
  Director(const std::vector<Pairing>& schedule, ConcurrencyLimits limits,
           Pace pace = Pace::free_running);

  // The schedule as it is now, by number: new pairings wait, waiting ones are replaced or, when
  // they are not in it any more, dropped; what has begun stays.
  void plan(const std::vector<Pairing>& schedule);

  // Those that are due now and were not before, in the order of the schedule; they count as
  // running from here on.
  [[nodiscard]] std::vector<Pairing> begin_due();

  // An order was taken back: as if it had never been due.
  void drop(std::uint32_t pairing);
  [[nodiscard]] std::vector<std::uint32_t> running() const;

  // A match is going on already, from an earlier run of the tournament.
  void resume(std::uint32_t pairing);

  // A match is over, whether it was begun here or in an earlier run of the tournament.
  void end(std::uint32_t pairing);

  [[nodiscard]] bool is_known(std::uint32_t pairing) const;
  [[nodiscard]] bool is_over(std::uint32_t pairing) const;
  [[nodiscard]] bool all_over() const;

 private:
  enum class Status : std::uint8_t { waiting, running, over };
  struct Slot {
    Pairing pairing;
    Status status = Status::waiting;
  };

  // In slots_, whose size for one that is not known.
  [[nodiscard]] std::size_t place_of(std::uint32_t pairing) const;

  // By Pairing::number. There may be 100,000, and whenever a match ends they are walked a few
  // times.
  std::vector<Slot> slots_;
  ConcurrencyLimits limits_;
  Pace pace_;
};

}  // namespace poolhall::tournament
