#include "server/tournament/swiss_pairing.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace poolhall::tournament {
namespace {

using Index = std::size_t;  // of a player, in the order of rank
using Indices = std::vector<Index>;

// Bits of the low fields of a weight that are filled by one matching.
constexpr unsigned chunk_bits = 512;

bool is_topscorer(const SwissPlayer& player, const SwissTerms& terms) {
  const std::size_t played = player.entry.rounds.size();
  return played + 1 >= terms.rounds && player.score > static_cast<int>(played);  // half points
}

// C2: who had a bye gets none; who won without playing gets one only before those.
std::uint64_t bye_grade(const SwissPlayer& player) {
  return player.had_bye ? 2 : player.had_free_win ? 1 : 0;
}

class RoundPairing {
 public:
  RoundPairing(std::vector<SwissPlayer> players, const SwissTerms& terms)
      : players_(std::move(players)), terms_(terms) {
    std::sort(players_.begin(), players_.end(), ranks_before);
    partner_.resize(players_.size());
    bye_candidate_.assign(players_.size(), false);
  }

  [[nodiscard]] SwissPairings pair() {
    if (players_.empty()) {
      return {};
    }
    settle_completion();
    Indices moved_down;
    for (Index begin = 0; begin < players_.size();) {
      SwissBracket bracket = bracket_from(begin, std::move(moved_down));
      begin += bracket.residents.size();
      pair_bracket(bracket);
      moved_down = unpaired(bracket);
    }
    return result();
  }

 private:
  using Partners = std::vector<std::optional<Index>>;

  // What C6 and C7 make of a bracket, whatever the criteria below say.
  struct Shape {
    std::size_t paired = 0;  // players
    std::size_t floaters = 0;
  };
  // Of a remainder: all, S1 and those of S1 whose opponents are sought.
  struct Halves {
    const Indices& remainder;
    const Indices& upper;
    const Indices& first;
  };

  // Whether the absolute criteria can be met by all.
  enum class Legality : std::uint8_t { strict, relaxed };

  // Edges of a matching: a weight for two players, the first of whom ranks before the other; 0
  // for none.
  template <class WeightOf>
  [[nodiscard]] Partners match(const Indices& open, WeightOf weight_of) const {
    WeightedGraph graph(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (std::size_t j = i + 1; j < open.size(); ++j) {
        const Index a = std::min(open[i], open[j]);
        const Index b = std::max(open[i], open[j]);
        if (may_meet(a, b)) {
          graph.set(i, j, weight_of(a, b));
        }
      }
    }
    const auto matched = maximum_weight_matching(graph);
    Partners partners(players_.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (matched[i]) {
        partners[open[i]] = open[*matched[i]];
      }
    }
    return partners;
  }

  [[nodiscard]] bool may_meet(Index a, Index b) const {
    return legality_ == Legality::relaxed ||
           !(have_met(players_[a], players_[b]) || breaks_clash(players_[a], players_[b], terms_));
  }

  [[nodiscard]] Indices everybody() const {
    Indices all(players_.size());
    for (Index i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    return all;
  }

  void settle_completion();
  [[nodiscard]] Partners match_for_completion() const;
  [[nodiscard]] FieldWriter completion(Index a, Index b) const;
  [[nodiscard]] SwissBracket bracket_from(Index begin, Indices moved_down) const;
  [[nodiscard]] static Indices open_in(const SwissBracket& bracket);
  [[nodiscard]] Indices unpaired(const SwissBracket& bracket) const;
  [[nodiscard]] Shape shape_of(const SwissBracket& bracket) const;
  void pair_bracket(const SwissBracket& bracket);
  // How many it has paired.
  std::size_t pair_moved_down(const SwissBracket& bracket, const BracketWeights& weights);
  void pair_remainder(const SwissBracket& bracket, const BracketWeights& weights,
                      std::size_t pairs);
  [[nodiscard]] Indices open_with(const SwissBracket& bracket, const Indices& remainder) const;
  [[nodiscard]] Indices upper_half(const SwissBracket& bracket, const BracketWeights& weights,
                                   const Indices& remainder, std::size_t pairs) const;
  void pair_first(const SwissBracket& bracket, const BracketWeights& weights, const Halves& halves);
  void fix(Index a, Index b) {
    partner_[a] = b;
    partner_[b] = a;
  }
  [[nodiscard]] SwissPairings result() const;

  std::vector<SwissPlayer> players_;
  SwissTerms terms_;
  Legality legality_ = Legality::strict;
  std::vector<bool> bye_candidate_;
  Partners partner_;
};

// C4, C2 and C5 for the whole round: whether there is a legal pairing, and who may have the bye.
void RoundPairing::settle_completion() {
  const auto free_of = [](const Partners& partners) {
    return std::count(partners.begin(), partners.end(), std::nullopt);
  };
  Partners partners = match_for_completion();
  if (free_of(partners) > static_cast<std::ptrdiff_t>(players_.size() % 2)) {
    legality_ = Legality::relaxed;
    partners = match_for_completion();
  }
  const auto free = std::find(partners.begin(), partners.end(), std::nullopt);
  if (free == partners.end()) {
    return;
  }
  const SwissPlayer& assignee = players_[static_cast<Index>(free - partners.begin())];
  for (Index i = 0; i < players_.size(); ++i) {
    bye_candidate_[i] =
        players_[i].score == assignee.score && bye_grade(players_[i]) <= bye_grade(assignee);
  }
}

RoundPairing::Partners RoundPairing::match_for_completion() const {
  const std::uint64_t size = players_.size();
  const std::uint64_t scores =
      static_cast<std::uint64_t>(players_.front().score - players_.back().score);
  return match(everybody(), [&](Index a, Index b) {
    FieldWriter fields;
    fields.append(1, width_for(size));
    fields.append(bye_grade(players_[a]) + bye_grade(players_[b]), width_for(2 * size));
    if (legality_ == Legality::relaxed) {
      fields.append(have_met(players_[a], players_[b]) ? 0U : 1U, width_for(size));
      fields.append(breaks_clash(players_[a], players_[b], terms_) ? 0U : 1U, width_for(size));
    }
    const int above = players_[a].score + players_[b].score - 2 * players_.back().score;
    fields.append(static_cast<std::uint64_t>(above), width_for(size * scores));
    return fields.weight();
  });
}

// The top fields of every weight: everybody is paired but one who may have the bye.
FieldWriter RoundPairing::completion(Index a, Index b) const {
  const unsigned width = width_for(players_.size());
  FieldWriter fields;
  fields.append(1, width);
  fields.append((bye_candidate_[a] ? 0U : 1U) + (bye_candidate_[b] ? 0U : 1U), width);
  if (legality_ == Legality::relaxed) {
    fields.append(have_met(players_[a], players_[b]) ? 0U : 1U, width);
    fields.append(breaks_clash(players_[a], players_[b], terms_) ? 0U : 1U, width);
  }
  return fields;
}

SwissBracket RoundPairing::bracket_from(Index begin, Indices moved_down) const {
  SwissBracket bracket{.moved_down = std::move(moved_down)};
  const int score = players_[begin].score;
  std::optional<int> next_score;
  for (Index i = begin; i < players_.size(); ++i) {
    if (players_[i].score == score) {
      bracket.residents.push_back(i);
      continue;
    }
    next_score = next_score.value_or(players_[i].score);
    (players_[i].score == *next_score ? bracket.next : bracket.rest).push_back(i);
  }
  return bracket;
}

Indices RoundPairing::open_in(const SwissBracket& bracket) {
  Indices open = bracket.moved_down;
  for (const Indices* part : {&bracket.residents, &bracket.next, &bracket.rest}) {
    open.insert(open.end(), part->begin(), part->end());
  }
  return open;
}

Indices RoundPairing::unpaired(const SwissBracket& bracket) const {
  Indices free;
  for (const Indices* part : {&bracket.moved_down, &bracket.residents}) {
    std::copy_if(part->begin(), part->end(), std::back_inserter(free),
                 [this](Index i) { return !partner_[i]; });
  }
  return free;
}

RoundPairing::Shape RoundPairing::shape_of(const SwissBracket& bracket) const {
  const BracketWeights weights(bracket, players_, terms_, ByeBracket::no);
  const Partners partners = match(open_in(bracket), [&](Index a, Index b) {
    FieldWriter fields = completion(a, b);
    weights.append_downfloaters(fields, a, b);
    return fields.weight();
  });
  const Index end = bracket.residents.back() + 1;
  Shape shape;
  for (const Indices* part : {&bracket.moved_down, &bracket.residents}) {
    for (const Index i : *part) {
      (partners[i] && *partners[i] < end ? shape.paired : shape.floaters) += 1;
    }
  }
  return shape;
}

void RoundPairing::pair_bracket(const SwissBracket& bracket) {
  const Shape shape = shape_of(bracket);
  // The note to C9: all who may have the bye have one score, so that if one of them is here, the
  // only one who floats down gets it.
  const auto is_candidate = [this](Index i) { return bye_candidate_[i]; };
  const bool may_have_bye =
      std::any_of(bracket.residents.begin(), bracket.residents.end(), is_candidate) ||
      std::any_of(bracket.moved_down.begin(), bracket.moved_down.end(), is_candidate);
  const BracketWeights weights(
      bracket, players_, terms_,
      may_have_bye && shape.floaters == 1 ? ByeBracket::yes : ByeBracket::no);
  std::size_t pairs = shape.paired / 2;
  if (!bracket.moved_down.empty()) {
    pairs -= pair_moved_down(bracket, weights);
  }
  if (pairs > 0) {
    pair_remainder(bracket, weights, pairs);
  }
}

// Articles 4.4 and 4.2: of equally good candidates, the first set of moved down players, then the
// first opponents for them in turn.
std::size_t RoundPairing::pair_moved_down(const SwissBracket& bracket,
                                          const BracketWeights& weights) {
  const std::size_t movers = bracket.moved_down.size();
  const unsigned opponent_bits = width_for(bracket.residents.size());
  const Index first_resident = bracket.residents.front();
  const Index end = bracket.residents.back() + 1;
  const Partners partners = match(open_in(bracket), [&](Index a, Index b) {
    FieldWriter fields = completion(a, b);
    weights.append_quality(fields, a, b);
    const auto mover = std::find(bracket.moved_down.begin(), bracket.moved_down.end(), a);
    const bool here = b >= first_resident && b < end;
    const auto number = static_cast<std::size_t>(mover - bracket.moved_down.begin());
    for (std::size_t i = 0; i < movers; ++i) {
      fields.append(here && i == number ? 1U : 0U, 1);
    }
    for (std::size_t i = 0; i < movers; ++i) {
      fields.append(here && i == number ? end - b : 0U, opponent_bits);
    }
    return fields.weight();
  });
  std::size_t paired = 0;
  for (const Index mover : bracket.moved_down) {
    const auto& opponent = partners[mover];
    if (opponent && *opponent >= first_resident && *opponent < end) {
      fix(mover, *opponent);
      ++paired;
    }
  }
  return paired;
}

// Articles 3.6 and 4.3 for the residents that the moved down players leave.
void RoundPairing::pair_remainder(const SwissBracket& bracket, const BracketWeights& weights,
                                  std::size_t pairs) {
  Indices remainder;
  std::copy_if(bracket.residents.begin(), bracket.residents.end(), std::back_inserter(remainder),
               [this](Index i) { return !partner_[i]; });
  Indices upper = upper_half(bracket, weights, remainder, pairs);
  // A few of S1 at a time, the highest first: the others' opponents weigh less than all of theirs.
  const unsigned bits = width_for(remainder.size());
  const std::size_t at_once = std::max<std::size_t>(1, chunk_bits / bits);
  while (!upper.empty()) {
    const std::size_t size = std::min(at_once, upper.size());
    const Indices first(upper.begin(), upper.begin() + static_cast<std::ptrdiff_t>(size));
    pair_first(bracket, weights, {remainder, upper, first});
    upper.erase(upper.begin(), upper.begin() + static_cast<std::ptrdiff_t>(size));
    std::erase_if(remainder, [this](Index i) { return partner_[i].has_value(); });
  }
}

Indices RoundPairing::open_with(const SwissBracket& bracket, const Indices& remainder) const {
  Indices open = unpaired({.moved_down = bracket.moved_down});
  for (const Indices* part : {&remainder, &bracket.next, &bracket.rest}) {
    open.insert(open.end(), part->begin(), part->end());
  }
  return open;
}

// The exchange of article 4.3 that comes first among those that lead to the best quality: who is
// in S1 after it. A pair's higher player is the one in S1, since the other way round it is
// generated later.
Indices RoundPairing::upper_half(const SwissBracket& bracket, const BracketWeights& weights,
                                 const Indices& remainder, std::size_t pairs) const {
  const std::size_t size = remainder.size();
  const Index end = bracket.residents.back() + 1;
  std::vector<std::size_t> number(players_.size(), 0);  // in the remainder, from 0
  for (std::size_t i = 0; i < size; ++i) {
    number[remainder[i]] = i;
  }
  const auto lower_bits = static_cast<unsigned>(size - pairs);
  const Partners partners = match(open_with(bracket, remainder), [&](Index a, Index b) {
    const bool here = b < end;
    if (here && a < remainder.front()) {
      return Weight(0);  // a moved down player who moves on
    }
    FieldWriter fields = completion(a, b);
    weights.append_quality(fields, a, b);
    const std::size_t own = number[a];
    const bool from_upper = here && own < pairs;
    // Few exchanges; a small difference of the sums; the lowest from S1; the highest from S2.
    fields.append(from_upper ? 1U : 0U, width_for(pairs));
    fields.append(here ? size - own : 0U, width_for(size * pairs));
    fields.append_cost(from_upper ? Weight(1) << static_cast<unsigned>(own) : Weight(0),
                       static_cast<unsigned>(pairs));
    fields.append(0, lower_bits);
    return here && !from_upper
               ? Weight(fields.weight() + (Weight(1) << static_cast<unsigned>(size - 1 - own)))
               : fields.weight();
  });
  Indices upper;
  std::copy_if(remainder.begin(), remainder.end(), std::back_inserter(upper),
               [&](Index i) { return partners[i] && *partners[i] > i && *partners[i] < end; });
  return upper;
}

// Article 4.2: the first transposition of S2, for the first of S1.
void RoundPairing::pair_first(const SwissBracket& bracket, const BracketWeights& weights,
                              const Halves& halves) {
  const Index end = bracket.residents.back() + 1;
  const unsigned bits = width_for(halves.remainder.size());
  const auto is_upper = [&](Index i) {
    return std::binary_search(halves.upper.begin(), halves.upper.end(), i);
  };
  const Partners partners = match(open_with(bracket, halves.remainder), [&](Index a, Index b) {
    const bool here = b < end;
    const bool in_remainder = a >= halves.remainder.front();
    const bool fits = here ? in_remainder && is_upper(a) && !is_upper(b) : !is_upper(a);
    if (!fits) {
      return Weight(0);
    }
    FieldWriter fields = completion(a, b);
    weights.append_quality(fields, a, b);
    const auto after = std::upper_bound(halves.remainder.begin(), halves.remainder.end(), b);
    const auto choice = static_cast<std::uint64_t>(halves.remainder.end() - after) + 1;
    for (const Index first : halves.first) {
      fields.append(here && a == first ? choice : 0U, bits);
    }
    return fields.weight();
  });
  for (const Index first : halves.first) {
    if (partners[first]) {
      fix(first, *partners[first]);
    }
  }
}

SwissPairings RoundPairing::result() const {
  SwissPairings round;
  for (Index i = 0; i < players_.size(); ++i) {
    if (!partner_[i]) {
      round.bye = players_[i].entry.id;
    } else if (*partner_[i] > i) {
      const EntryId high = players_[i].entry.id;
      const EntryId low = players_[*partner_[i]].entry.id;
      const BreakSide side = allocated_side(players_[i], players_[*partner_[i]], terms_.initial);
      round.pairs.push_back(side == BreakSide::first ? SwissPair{high, low} : SwissPair{low, high});
    }
  }
  return round;
}

}  // namespace

SwissPairings pair_swiss_round(std::vector<SwissPlayer> players, const SwissTerms& terms) {
  return RoundPairing(std::move(players), terms).pair();
}

bool have_met(const SwissPlayer& a, const SwissPlayer& b) {
  return std::any_of(a.entry.rounds.begin(), a.entry.rounds.end(), [&](const SwissRound& round) {
    return round.kind == RoundKind::played && round.opponent == b.entry.id;
  });
}

bool breaks_clash(const SwissPlayer& a, const SwissPlayer& b, const SwissTerms& terms) {
  return a.strength == Strength::absolute && b.strength == Strength::absolute &&
         a.preference == b.preference && !is_topscorer(a, terms) && !is_topscorer(b, terms);
}

}  // namespace poolhall::tournament
