// The table of a tournament: a pure function of the games played so far.
//
//   Standings table = standings(3, games, {TieBreak::direct_encounter, TieBreak::wins});
//   table.rows.front().entry;   // who leads
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "server/ratings/bradley_terry.hpp"
#include "server/ratings/glicko2.hpp"
#include "server/tournament/played_game.hpp"

namespace poolhall::tournament {

// How entries with the same points are ordered.
enum class TieBreak : std::uint8_t {
  direct_encounter,  // points in the games among those still tied
  buchholz_cut1,     // Buchholz without the lowest opponent
  buchholz,          // sum of the opponents' points, one for each match
  sonneborn_berger,  // for each game, the opponent's points times what was scored
  wins,              // games won
};
[[nodiscard]] std::string_view name(TieBreak tie_break);
[[nodiscard]] std::optional<TieBreak> tie_break(std::string_view name);

struct StandingsRow {
  EntryId entry{};
  std::uint32_t rank = 0;  // 1-based; entries that no tie-break parts share one
  double points = 0;       // 1 a win, 0.5 a draw
  std::uint32_t wins = 0;
  std::uint32_t losses = 0;
  std::uint32_t draws = 0;
  std::vector<double> tie_breaks;  // in the declared order
  ratings::PlayerRating rating;
  std::optional<ratings::Glicko2Rating> ladder{};  // what decides on a ladder
  // Likelihood of superiority over the next row's entry, where ratings can be compared.
  std::optional<double> superiority{};

  [[nodiscard]] std::uint32_t games() const { return wins + losses + draws; }
};

// What a format changes in the table.
struct TableRules {
  std::vector<TieBreak> tie_breaks;
  std::vector<std::uint32_t> places{};    // by entry: its own order, before points; empty: none
  std::vector<double> points{};           // by entry, instead of those of the games; empty: those
  std::vector<std::uint32_t> unplayed{};  // by entry: rounds that count as an opponent with the
                                          // entry's own points for Buchholz; empty: none
  std::vector<ratings::Glicko2Rating> ladder{};  // by entry, for the rows; empty: none
};

struct Standings {
  std::vector<StandingsRow> rows;  // best first; those who share a rank in the order of entry
  std::vector<TieBreak> tie_breaks;
  bool has_ladder = false;  // each row has its rating there
  std::optional<ratings::Estimate> break_advantage;
  std::map<rules::EndReason, std::uint32_t> endings;
};

[[nodiscard]] Standings standings(std::size_t entries, const std::vector<PlayedGame>& games,
                                  const TableRules& rules);
[[nodiscard]] Standings standings(std::size_t entries, const std::vector<PlayedGame>& games,
                                  const std::vector<TieBreak>& tie_breaks);

}  // namespace poolhall::tournament
