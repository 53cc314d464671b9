#include "server/tournament/swiss_history.hpp"

#include <algorithm>
#include <cstdlib>

namespace poolhall::tournament {
namespace {

constexpr int win = 2;

const SwissEntry* find(const std::vector<SwissEntry>& everybody, EntryId id) {
  const auto found = std::find_if(everybody.begin(), everybody.end(),
                                  [id](const SwissEntry& entry) { return entry.id == id; });
  return found == everybody.end() ? nullptr : &*found;
}

// 1.4.2: scores before the round differ; 1.4.3: points without playing.
FloatKind float_of(const SwissEntry& entry, std::size_t rounds_back,
                   const std::vector<SwissEntry>& everybody) {
  if (entry.rounds.size() < rounds_back) {
    return FloatKind::none;
  }
  const std::size_t round = entry.rounds.size() - rounds_back;
  const SwissRound& spent = entry.rounds[round];
  if (spent.kind != RoundKind::played && spent.half_points > 0) {
    return FloatKind::down;
  }
  const SwissEntry* opponent = spent.opponent ? find(everybody, *spent.opponent) : nullptr;
  if (opponent == nullptr) {
    return FloatKind::none;
  }
  const int own = score_before(entry, round);
  const int others = score_before(*opponent, round);
  return own > others ? FloatKind::down : own < others ? FloatKind::up : FloatKind::none;
}

// 1.7.
void set_preference(SwissPlayer& player) {
  const std::size_t matches = player.sides.size();
  if (matches == 0) {
    return;
  }
  const BreakSide last = player.sides.back();
  const bool repeated = matches > 1 && player.sides[matches - 2] == last;
  const BreakSide balancing = player.break_difference > 0 ? BreakSide::second : BreakSide::first;
  if (std::abs(player.break_difference) > 1) {
    player.strength = Strength::absolute;
    player.preference = balancing;
  } else if (repeated) {
    player.strength = Strength::absolute;
    player.preference = other(last);
  } else if (player.break_difference != 0) {
    player.strength = Strength::strong;
    player.preference = balancing;
  } else {
    player.strength = Strength::mild;
    player.preference = other(last);
  }
}

// 5.2.3: the latest match in which one broke and the other did not; unplayed rounds do not count
// (C.04.2 3.4). The side that `a` gets then.
std::optional<BreakSide> by_alternation(const SwissPlayer& a, const SwissPlayer& b) {
  const std::size_t common = std::min(a.sides.size(), b.sides.size());
  for (std::size_t back = 1; back <= common; ++back) {
    const BreakSide of_a = a.sides[a.sides.size() - back];
    if (of_a != b.sides[b.sides.size() - back]) {
      return other(of_a);
    }
  }
  return std::nullopt;
}

// 5.2.2: who has the stronger claim to the side that both want, if anyone.
const SwissPlayer* stronger(const SwissPlayer& a, const SwissPlayer& b) {
  if (a.strength != b.strength) {
    return a.strength > b.strength ? &a : &b;
  }
  const int of_a = std::abs(a.break_difference);
  const int of_b = std::abs(b.break_difference);
  if (a.strength == Strength::absolute && of_a != of_b) {
    return of_a > of_b ? &a : &b;
  }
  return nullptr;
}

}  // namespace

int score_before(const SwissEntry& entry, std::size_t round) {
  int score = 0;
  for (std::size_t i = 0; i < round && i < entry.rounds.size(); ++i) {
    score += entry.rounds[i].half_points;
  }
  return score;
}

SwissPlayer swiss_player(const SwissEntry& entry, const std::vector<SwissEntry>& everybody) {
  SwissPlayer player;
  player.entry = entry;
  player.score = score_before(entry, entry.rounds.size());
  for (const SwissRound& round : entry.rounds) {
    if (round.kind == RoundKind::played) {
      player.sides.push_back(*round.side);
      player.break_difference += round.side == BreakSide::first ? 1 : -1;
      continue;
    }
    ++player.unplayed;
    player.had_bye = player.had_bye || round.kind == RoundKind::bye;
    player.had_free_win = player.had_free_win || round.half_points >= win;
  }
  set_preference(player);
  player.last_float = float_of(entry, 1, everybody);
  player.float_before = float_of(entry, 2, everybody);
  return player;
}

bool ranks_before(const SwissPlayer& a, const SwissPlayer& b) {
  return a.score != b.score ? a.score > b.score : a.entry.number < b.entry.number;
}

BreakSide allocated_side(const SwissPlayer& a, const SwissPlayer& b, BreakSide initial) {
  if (a.preference && b.preference != a.preference) {
    return *a.preference;
  }
  if (!a.preference && b.preference) {
    return other(*b.preference);
  }
  if (a.preference) {
    if (const SwissPlayer* claims = stronger(a, b)) {
      return claims == &a ? *a.preference : other(*b.preference);
    }
    if (const auto side = by_alternation(a, b)) {
      return *side;
    }
    return ranks_before(a, b) ? *a.preference : other(*b.preference);
  }
  const bool a_is_higher = ranks_before(a, b);
  const std::uint32_t number = a_is_higher ? a.entry.number : b.entry.number;
  const BreakSide of_higher = number % 2 == 1 ? initial : other(initial);
  return a_is_higher ? of_higher : other(of_higher);
}

}  // namespace poolhall::tournament
