#include "server/tournament/trf.hpp"

#include <cstdint>
#include <vector>

#include <fmt/format.h>

namespace poolhall::tournament {
namespace {

char result_letter(const SwissRound& round) {
  switch (round.kind) {
    case RoundKind::played:
      return round.half_points == 2 ? '1' : round.half_points == 1 ? '=' : '0';
    case RoundKind::forfeit_win:
      return '+';
    case RoundKind::forfeit_loss:
      return '-';
    case RoundKind::bye:
      return 'U';
    case RoundKind::half_bye:
      return 'H';
    case RoundKind::full_bye:
      return 'F';
    case RoundKind::absent:
      break;
  }
  return 'Z';
}

// Ten columns: the opponent, the colour and the result, each after blanks.
std::string round_text(const SwissRound& round) {
  const std::string opponent =
      round.opponent ? fmt::format("{:4}", index(*round.opponent) + 1) : "0000";
  const char colour = !round.side ? '-' : *round.side == BreakSide::first ? 'w' : 'b';
  return fmt::format("  {} {} {}", opponent, colour, result_letter(round));
}

double points(const SwissEntry& entry) {
  return score_before(entry, entry.rounds.size()) / 2.0;
}

// By entry.
std::vector<std::uint32_t> ranks(const Standings& standings) {
  std::vector<std::uint32_t> ranks(standings.rows.size());
  for (const StandingsRow& row : standings.rows) {
    ranks[index(row.entry)] = row.rank;
  }
  return ranks;
}

}  // namespace

std::string trf16(const TrfHead& head, const Names& names, const Schedule& schedule,
                  const Standings& standings) {
  std::string text = fmt::format("012 {}\n062 {}\n092 Individual: Swiss-System\n", head.name,
                                 schedule.swiss.size());
  const std::vector<std::uint32_t> rank = ranks(standings);
  for (std::size_t i = 0; i < schedule.swiss.size(); ++i) {
    const SwissEntry& entry = schedule.swiss[i];
    // Columns 5-8 number, 10 sex, 11-13 title, 15-47 name, 49-52 rating, 54-56 federation, 58-68
    // number of FIDE, 70-79 birth, 81-84 points, 86-89 rank.
    text += fmt::format("001 {:4} {:4} {:<33.33} {:4} {:3} {:11} {:10} {:4.1f} {:4}", i + 1, "",
                        names[i], "", "", "", "", points(entry), rank[i]);
    for (const SwissRound& round : entry.rounds) {
      text += round_text(round);
    }
    text += '\n';
  }
  return text + fmt::format("XXR {}\nXXC white1\n", head.rounds);
}

}  // namespace poolhall::tournament
