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
#include "server/tournament/played_game.hpp"

namespace poolhall::tournament {

// How entries with the same points are ordered.
enum class TieBreak : std::uint8_t {
  direct_encounter,  // points in the games among those still tied
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

  [[nodiscard]] std::uint32_t games() const { return wins + losses + draws; }
};

struct Standings {
  std::vector<StandingsRow> rows;  // best first; those who share a rank in the order of entry
  std::vector<TieBreak> tie_breaks;
  std::optional<ratings::Estimate> break_advantage;
  std::map<rules::EndReason, std::uint32_t> endings;
};

[[nodiscard]] Standings standings(std::size_t entries, const std::vector<PlayedGame>& games,
                                  const std::vector<TieBreak>& tie_breaks);

}  // namespace poolhall::tournament
