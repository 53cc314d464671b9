#include "server/tournament/swiss_bracket.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

namespace poolhall::tournament {
namespace {

// What a player gets out of a pair's breaks: 1 for each of C10 to C13 that is violated.
std::array<unsigned, 4> violations(const SwissPlayer& player, BreakSide side) {
  const int difference = player.break_difference + (side == BreakSide::first ? 1 : -1);
  const std::size_t played = player.sides.size();
  const bool third =
      played > 1 && player.sides[played - 1] == side && player.sides[played - 2] == side;
  const bool denied = player.preference && *player.preference != side;
  return {std::abs(difference) > 2 ? 1U : 0U, third ? 1U : 0U, denied ? 1U : 0U,
          denied && player.strength == Strength::strong ? 1U : 0U};
}

}  // namespace

unsigned width_for(std::uint64_t sum) {
  return static_cast<unsigned>(std::bit_width(sum));
}

BracketWeights::BracketWeights(const SwissBracket& bracket, const std::vector<SwissPlayer>& players,
                               const SwissTerms& terms, ByeBracket bye)
    : players_(players),
      initial_(terms.initial),
      bye_(bye),
      place_(players.size(), Place::rest),
      count_(width_for(players.size())) {
  std::uint64_t unplayed = 0;
  for (const std::size_t i : bracket.next) {
    place_[i] = Place::next;
  }
  for (const std::size_t i : bracket.residents) {
    place_[i] = Place::resident;
    unplayed += static_cast<std::uint64_t>(players[i].unplayed);
  }
  for (const std::size_t i : bracket.moved_down) {
    place_[i] = Place::moved_down;
    unplayed += static_cast<std::uint64_t>(players[i].unplayed);
  }
  unplayed_ = width_for(unplayed);
  moved_down_ = groups_of(bracket.moved_down);
  std::vector<std::size_t> here = bracket.moved_down;
  here.insert(here.end(), bracket.residents.begin(), bracket.residents.end());
  here_ = groups_of(here);
}

std::vector<BracketWeights::ScoreGroup> BracketWeights::groups_of(
    const std::vector<std::size_t>& members) const {
  std::vector<ScoreGroup> groups;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const int score = players_[members[i]].score;
    if (groups.empty() || groups.back().score != score) {
      const auto size = std::count_if(members.begin(), members.end(), [&](std::size_t member) {
        return players_[member].score == score;
      });
      groups.push_back({score, width_for(static_cast<std::uint64_t>(size))});
    }
  }
  return groups;
}

// A count for each group, the highest score first.
void BracketWeights::append_by_score(FieldWriter& fields, const std::vector<ScoreGroup>& groups,
                                     int score, bool counts) const {
  for (const ScoreGroup& group : groups) {
    fields.append(counts && group.score == score ? 1U : 0U, group.width);
  }
}

// C6 and C7 here, and in the following bracket (C8): as many pairs as possible, and the highest
// scores in them.
void BracketWeights::append_downfloaters(FieldWriter& fields, std::size_t a, std::size_t b) const {
  const bool here = is_pair_here(b);
  const bool next = place_[b] == Place::next && place_[a] != Place::rest;
  fields.append(here ? 1U : 0U, count_);
  append_by_score(fields, moved_down_, players_[a].score, here);
  fields.append(next ? 1U : 0U, count_);
  append_by_score(fields, here_, players_[a].score, next);
}

// C9: who is paired has as many unplayed rounds as possible, so that the one with the bye has few.
void BracketWeights::append_bye(FieldWriter& fields, std::size_t a, std::size_t b) const {
  if (bye_ == ByeBracket::no) {
    return;
  }
  int unplayed = 0;
  for (const std::size_t i : {a, b}) {
    const bool in_bracket = place_[i] == Place::resident || place_[i] == Place::moved_down;
    unplayed += in_bracket ? players_[i].unplayed : 0;
  }
  fields.append(static_cast<std::uint64_t>(unplayed), unplayed_);
}

// C10 to C13: a pair has at most two violations of each, and the number of pairs is C6's.
void BracketWeights::append_breaks(FieldWriter& fields, std::size_t a, std::size_t b) const {
  std::array<unsigned, 4> kept{};
  if (is_pair_here(b)) {
    const BreakSide side = allocated_side(players_[a], players_[b], initial_);
    const auto of_a = violations(players_[a], side);
    const auto of_b = violations(players_[b], other(side));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      kept[i] = 2 - of_a[i] - of_b[i];
    }
  }
  for (const unsigned value : kept) {
    fields.append(value, count_);
  }
}

// C14 to C21. Paired residents with a downfloat do not float again; of pairs of a moved down
// player and a resident, those whose resident has no upfloat are kept.
void BracketWeights::append_floats(FieldWriter& fields, std::size_t a, std::size_t b) const {
  const bool here = is_pair_here(b);
  const bool mixed = here && place_[a] == Place::moved_down;
  for (const auto of : {&SwissPlayer::last_float, &SwissPlayer::float_before}) {
    unsigned down = 0;
    for (const std::size_t i : {a, b}) {
      down += here && place_[i] == Place::resident && players_[i].*of == FloatKind::down ? 1U : 0U;
    }
    fields.append(down, count_);
    fields.append(here && !(mixed && players_[b].*of == FloatKind::up) ? 1U : 0U, count_);
  }
  for (const auto of : {&SwissPlayer::last_float, &SwissPlayer::float_before}) {
    append_by_score(fields, moved_down_, players_[a].score,
                    mixed && players_[a].*of == FloatKind::down);
    append_by_score(fields, moved_down_, players_[a].score,
                    mixed && players_[b].*of != FloatKind::up);
  }
}

void BracketWeights::append_quality(FieldWriter& fields, std::size_t a, std::size_t b) const {
  append_downfloaters(fields, a, b);
  append_bye(fields, a, b);
  append_breaks(fields, a, b);
  append_floats(fields, a, b);
}

}  // namespace poolhall::tournament
