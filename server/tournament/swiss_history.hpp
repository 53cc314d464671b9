// What the Swiss system knows of an entry: its rounds so far, and what follows from them for the
// next one. Points are counted in halves. The one who breaks in the first game of a match has the
// place of White in FIDE's rules.
//
//   SwissEntry entry{.id = entry_id(3), .number = 4, .rounds = {{.kind = RoundKind::bye}}};
//   SwissPlayer player = swiss_player(entry, everybody);
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "server/tournament/entry.hpp"

namespace poolhall::tournament {

enum class BreakSide : std::uint8_t { first, second };  // first breaks, like White
[[nodiscard]] constexpr BreakSide other(BreakSide side) {
  return side == BreakSide::first ? BreakSide::second : BreakSide::first;
}

// How an entry spent a round. Letters are those of FIDE's TRF16.
enum class RoundKind : std::uint8_t {
  absent,        // Z: not paired, no points
  played,        // 1, =, 0
  forfeit_win,   // +: paired, the opponent did not come
  forfeit_loss,  // -: paired, did not come
  bye,           // U: the bye that the pairing gives
  half_bye,      // H: half a point without an opponent
  full_bye,      // F: a whole point without an opponent
};

struct SwissRound {
  RoundKind kind = RoundKind::absent;
  std::optional<EntryId> opponent{};  // when paired
  std::optional<BreakSide> side{};    // when paired
  int half_points = 0;                // 2 won, 1 drawn, 0 lost
};

struct SwissEntry {
  EntryId id{};
  std::uint32_t number = 1;        // FIDE's pairing number, 1-based: the order of seeding
  std::vector<SwissRound> rounds;  // all so far
};

enum class Strength : std::uint8_t { none, mild, strong, absolute };  // C.04.3 1.7
enum class FloatKind : std::uint8_t { none, down, up };               // C.04.3 1.4

struct SwissPlayer {
  SwissEntry entry;
  int score = 0;                          // half points
  int break_difference = 0;               // matches broken first less the others
  std::optional<BreakSide> preference{};  // unset: none yet
  Strength strength = Strength::none;
  std::vector<BreakSide> sides;              // of the matches played, in order
  FloatKind last_float = FloatKind::none;    // of the round before
  FloatKind float_before = FloatKind::none;  // of two rounds before
  int unplayed = 0;                          // rounds without a match played
  bool had_bye = false;                      // the pairing's own
  bool had_free_win = false;                 // another win's points without playing
};

[[nodiscard]] int score_before(const SwissEntry& entry, std::size_t round);

// `everybody`: all entries that the rounds name, for their scores at the time.
[[nodiscard]] SwissPlayer swiss_player(const SwissEntry& entry,
                                       const std::vector<SwissEntry>& everybody);

// By score, then by number (C.04.3 1.2).
[[nodiscard]] bool ranks_before(const SwissPlayer& a, const SwissPlayer& b);

// Who breaks first when these two meet: the side of `a` (C.04.3 5.2). `initial` is the side that
// odd numbers get when nobody has a preference.
[[nodiscard]] BreakSide allocated_side(const SwissPlayer& a, const SwissPlayer& b,
                                       BreakSide initial);

}  // namespace poolhall::tournament
