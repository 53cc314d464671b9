#include "random_swiss.hpp"

#include <bit>

namespace poolhall::tournament {
namespace {

constexpr double withdrawals = 0.02;
constexpr double absences = 0.03;
constexpr double half_byes = 0.02;
constexpr double late_entries = 0.05;
constexpr double forfeits = 0.03;
constexpr double draws = 0.15;

}  // namespace

std::uint32_t swiss_rounds(std::size_t entries) {
  return static_cast<std::uint32_t>(std::bit_width(entries - 1)) + 1;
}

RandomSwiss::RandomSwiss(std::size_t entries, std::uint64_t seed)
    : random_(seed),
      rounds_(swiss_rounds(entries)),
      withdrawn_(entries, false),
      from_round_(entries, 0),
      away_(entries, RoundKind::absent) {
  for (std::size_t i = 0; i < entries; ++i) {
    entries_.push_back({entry_id(i), static_cast<std::uint32_t>(i + 1), {}});
    from_round_[i] = i + 3 > entries && happens(late_entries * 3) ? 1 + random_() % 2 : 0;
  }
}

bool RandomSwiss::happens(double chance) {
  return static_cast<double>(random_() >> 11U) * 0x1p-53 < chance;
}

bool RandomSwiss::next_round() {
  if (paired_) {
    play();
  }
  const std::size_t round = entries_.front().rounds.size();
  if (round >= rounds_) {
    return false;
  }
  present_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    away_[i] = RoundKind::absent;
    withdrawn_[i] = withdrawn_[i] || (round > 0 && happens(withdrawals));
    if (withdrawn_[i] || from_round_[i] > round) {
      continue;
    }
    if (happens(half_byes)) {
      away_[i] = RoundKind::half_bye;
    } else if (!happens(absences)) {
      present_.push_back(entries_[i].id);
    }
  }
  if (present_.size() < 2) {
    return false;
  }
  pairings_ = pair_swiss_round(players(), terms());
  paired_ = true;
  return true;
}

std::vector<SwissPlayer> RandomSwiss::players() const {
  std::vector<SwissPlayer> players;
  for (const EntryId id : present_) {
    players.push_back(swiss_player(entries_[index(id)], entries_));
  }
  return players;
}

void RandomSwiss::play() {
  std::vector<SwissRound> spent(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    spent[i].kind = away_[i];
    spent[i].half_points = away_[i] == RoundKind::half_bye ? 1 : 0;
  }
  if (pairings_.bye) {
    spent[index(*pairings_.bye)] = {RoundKind::bye, {}, {}, 2};
  }
  for (const SwissPair& pair : pairings_.pairs) {
    const bool forfeited = happens(forfeits);
    const bool drawn = !forfeited && happens(draws);
    const bool first_wins = happens(0.5);
    const int points = drawn ? 1 : first_wins ? 2 : 0;
    const auto kind = [&](int own) {
      return !forfeited ? RoundKind::played
             : own == 2 ? RoundKind::forfeit_win
                        : RoundKind::forfeit_loss;
    };
    spent[index(pair.first)] = {kind(points), pair.second, BreakSide::first, points};
    spent[index(pair.second)] = {kind(2 - points), pair.first, BreakSide::second, 2 - points};
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entries_[i].rounds.push_back(spent[i]);
  }
}

}  // namespace poolhall::tournament
