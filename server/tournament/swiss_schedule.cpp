#include <algorithm>
#include <iterator>

#include "server/tournament/formats.hpp"
#include "server/tournament/swiss_pairing.hpp"

namespace poolhall::tournament {
namespace {

// A match counts as one game of FIDE's rules: won, drawn or lost.
SwissRound spent(const MatchResult& result, BreakSide side, EntryId opponent) {
  const bool is_first = side == BreakSide::first;
  const double own = is_first ? result.first_points() : result.second_points();
  const double others = is_first ? result.second_points() : result.first_points();
  const int half_points = own > others ? 2 : own < others ? 0 : 1;
  if (result.was_played()) {
    return {RoundKind::played, opponent, side, half_points};
  }
  if (half_points == 1) {
    return {RoundKind::half_bye, {}, {}, 1};  // neither came, or nothing could be played
  }
  return {half_points == 2 ? RoundKind::forfeit_win : RoundKind::forfeit_loss, opponent, side,
          half_points};
}

class SwissTournament {
 public:
  SwissTournament(const FormatSettings& format, const std::vector<EntrySpan>& field,
                  const Happened& happened, const Schedule& drawn)
      : field_(field), happened_(happened), before_(drawn) {
    // Late entries do not make it longer.
    const auto from_the_start = static_cast<std::size_t>(std::count_if(
        field.begin(), field.end(), [](const EntrySpan& span) { return span.from == 0; }));
    terms_.rounds = format.rounds > 0 ? format.rounds : swiss_rounds_of(from_the_start);
    now_.rounds = terms_.rounds;
    for (std::size_t i = 0; i < field.size(); ++i) {
      now_.swiss.push_back({entry_id(i), static_cast<std::uint32_t>(i + 1), {}});
    }
    paired_before_.assign(field.size(), false);
  }

  [[nodiscard]] Schedule run() {
    for (std::uint32_t round = 0; round < terms_.rounds; ++round) {
      if (!draw(round)) {
        now_.is_complete = true;  // fewer than two are left
        return std::move(now_);
      }
      if (!finish_round()) {
        return std::move(now_);
      }
    }
    now_.is_complete = true;
    return std::move(now_);
  }

 private:
  // Pairing numbers count those who play or have played (C.04.2 2): who never came has none.
  void number_entries(std::uint32_t round) {
    std::uint32_t number = 1;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      now_.swiss[i].number = number;
      number += paired_before_[i] || field_[i].covers(round) ? 1 : 0;
    }
  }

  [[nodiscard]] bool draw(std::uint32_t round) {
    number_entries(round);
    std::vector<SwissPlayer> present;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      if (field_[i].covers(round)) {
        present.push_back(swiss_player(now_.swiss[i], now_.swiss));
      }
    }
    if (present.size() < 2) {
      return false;
    }
    pair(round, present);
    now_.pairings.insert(now_.pairings.end(), drawn_.begin(), drawn_.end());
    for (std::size_t i = 0; i < field_.size(); ++i) {
      paired_before_[i] = paired_before_[i] || field_[i].covers(round);
    }
    now_.off.insert(now_.off.end(), off_.begin(), off_.end());
    now_.rounds_drawn = round + 1;
    return true;
  }

  void pair(std::uint32_t round, const std::vector<SwissPlayer>& present) {
    drawn_.clear();
    off_.clear();
    for (std::size_t i = 0; i < field_.size(); ++i) {
      if (!field_[i].covers(round)) {
        off_.push_back({round, entry_id(i), RoundKind::absent});
      }
    }
    if (round < before_.rounds_drawn) {
      std::copy_if(before_.pairings.begin(), before_.pairings.end(), std::back_inserter(drawn_),
                   [round](const Pairing& pairing) { return pairing.round == round; });
      std::copy_if(before_.off.begin(), before_.off.end(), std::back_inserter(off_),
                   [round](const RoundOff& off) {
                     return off.round == round && off.kind == RoundKind::bye;
                   });
      return;
    }
    const SwissPairings pairings = pair_swiss_round(present, terms_);
    auto number = static_cast<std::uint32_t>(now_.pairings.size());
    for (const SwissPair& pair : pairings.pairs) {
      drawn_.push_back({number++, round, pair.first, pair.second});
    }
    if (pairings.bye) {
      off_.push_back({round, *pairings.bye, RoundKind::bye});
    }
  }

  // Whether all of its matches are over; then everybody's history has the round.
  [[nodiscard]] bool finish_round() {
    std::vector<SwissRound> rounds(field_.size());
    for (const Pairing& pairing : drawn_) {
      const auto found = happened_.results.find(pairing.number);
      if (found == happened_.results.end()) {
        return false;
      }
      rounds[index(pairing.first)] = spent(found->second, BreakSide::first, pairing.second);
      rounds[index(pairing.second)] = spent(found->second, BreakSide::second, pairing.first);
    }
    for (const RoundOff& off : off_) {
      rounds[index(off.entry)] = {off.kind, {}, {}, off.kind == RoundKind::bye ? 2 : 0};
    }
    for (std::size_t i = 0; i < field_.size(); ++i) {
      now_.swiss[i].rounds.push_back(rounds[i]);
    }
    return true;
  }

  const std::vector<EntrySpan>& field_;
  const Happened& happened_;
  const Schedule& before_;
  SwissTerms terms_;
  Schedule now_;
  std::vector<bool> paired_before_;
  std::vector<Pairing> drawn_;  // in the last round
  std::vector<RoundOff> off_;
};

}  // namespace

Schedule swiss_schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                        const Happened& happened, const Schedule& drawn) {
  return SwissTournament(format, field, happened, drawn).run();
}

}  // namespace poolhall::tournament
