// The formats of tournaments: who meets whom, as a pure function of the results so far.
//
//   FormatSettings format{.kind = FormatKind::swiss, .rounds = 5};
//   Schedule now = schedule(format, std::vector<EntrySpan>(16), happened);
//   // now.pairings: all that are known; the same results always give the same ones, and more
//   // results only ever add some (or take away what a withdrawal leaves without a game)
//
// Knows nothing of clocks, sockets or storage. README.md says how each format works.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "server/ratings/glicko2.hpp"
#include "server/ratings/sprt.hpp"
#include "server/tournament/played_game.hpp"
#include "server/tournament/round_robin.hpp"
#include "server/tournament/standings.hpp"
#include "server/tournament/swiss_history.hpp"

namespace poolhall::tournament {

enum class FormatKind : std::uint8_t {
  round_robin,
  swiss,  // FIDE's Dutch system
  single_elimination,
  double_elimination,
  gauntlet,  // the first entries meet all others, who do not meet each other
  ladder,    // neighbours by Glicko-2 rating meet
  sprt,      // two entries, until a sequential test decides
};
[[nodiscard]] std::string_view name(FormatKind kind);
[[nodiscard]] std::optional<FormatKind> format_kind(std::string_view name);

struct FormatSettings {
  FormatKind kind = FormatKind::round_robin;
  std::uint32_t rounds = 0;   // Swiss, ladder, and the most matches of an SPRT; 0: by the format
  std::uint32_t runners = 1;  // of a gauntlet: the first so many entries
  ratings::SprtSettings sprt{};
  std::uint64_t seed = 0;  // of the lots that an elimination may need
};

// The rounds that an entry takes part in.
struct EntrySpan {
  std::uint32_t from = 0;                // later for late entries
  std::optional<std::uint32_t> until{};  // the first round without it: it has withdrawn

  [[nodiscard]] bool covers(std::uint32_t round) const {
    return round >= from && (!until || round < *until);
  }
};

struct GameScore {
  std::uint32_t number = 0;  // in its match
  double first = 0;          // of Pairing::first: 1 won, 0.5 drawn, 0 lost
  bool was_played = true;    // not: it was forfeited before its first shot
};

// A match that is over.
struct MatchResult {
  std::vector<GameScore> games;  // by number; one that could not be played is not there

  [[nodiscard]] double first_points() const;
  [[nodiscard]] double second_points() const;
  [[nodiscard]] bool was_played() const;  // some game of it
  [[nodiscard]] bool has_drawn_game() const;
};

struct Happened {
  std::map<std::uint32_t, MatchResult> results;  // by Pairing::number
  std::set<std::uint32_t> begun;                 // those over among them
};

// An entry that does not play in a round that was drawn.
struct RoundOff {
  std::uint32_t round = 0;
  EntryId entry{};
  RoundKind kind = RoundKind::absent;

  friend bool operator==(const RoundOff&, const RoundOff&) = default;
};

// Who went on in an elimination by the drawing of a lot.
struct Lot {
  std::uint32_t round = 0;
  EntryId winner{};
  EntryId loser{};

  friend bool operator==(const Lot&, const Lot&) = default;
};

enum class BracketSide : std::uint8_t { winners, losers, final };
[[nodiscard]] std::string_view name(BracketSide side);

// A match of an elimination's tree, as far as it is known who plays it.
struct BracketPlace {
  std::uint32_t round = 0;
  BracketSide side = BracketSide::winners;
  std::optional<EntryId> one{};
  std::optional<EntryId> two{};
  std::optional<EntryId> winner{};
  bool is_played = true;                // not: somebody has no opponent here
  std::vector<std::uint32_t> pairings;  // several if it was level
};

struct Schedule {
  std::vector<Pairing> pairings;  // by number
  std::vector<RoundOff> off;      // of formats by rounds
  std::uint32_t rounds_drawn = 0;
  std::uint32_t rounds = 0;  // of the whole tournament: Swiss and ladder; 0: others
  bool is_complete = false;  // nothing more will come
  // The format's own order of the entries, less is better; empty: by points alone.
  std::vector<std::uint32_t> places;
  std::vector<Lot> lots;
  std::vector<BracketPlace> bracket;           // of eliminations, in the order of the tree
  std::vector<ratings::Glicko2Rating> ladder;  // by entry
  std::optional<ratings::SprtState> sprt{};
  std::uint32_t sprt_matches = 0;  // the first so many are over and counted
  std::vector<SwissEntry> swiss;   // the rounds that are over, by entry

  friend bool same_pairings(const Schedule& a, const Schedule& b) {
    return a.pairings == b.pairings && a.off == b.off;
  }
};

// `drawn`: the schedule of fewer results, whose Swiss rounds need not be paired again and whose
// SPRT goes on from there. It changes the time that this takes and nothing else.
[[nodiscard]] Schedule schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                                const Happened& happened, const Schedule& drawn = {});

// What the format makes of the table: points of Swiss matches and byes, places on a ladder or in
// an elimination.
[[nodiscard]] TableRules table_rules(const FormatSettings& format, const Schedule& schedule,
                                     const Happened& happened, std::vector<TieBreak> tie_breaks);

// ceil(log2 n): rounds after which one of n has won all. FIDE's rules pair one more.
[[nodiscard]] std::uint32_t swiss_rounds_of(std::size_t entries);

// The first round that a newcomer can play while the tournament goes on; none: it takes nobody
// any more. Only Swiss and ladder take late entries.
[[nodiscard]] std::optional<std::uint32_t> late_round(FormatKind kind, const Schedule& schedule);

}  // namespace poolhall::tournament
