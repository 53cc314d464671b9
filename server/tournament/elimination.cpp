#include "server/tournament/elimination.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "server/tournament/formats.hpp"
#include "server/tournament/seeds.hpp"

namespace poolhall::tournament {
namespace {

using Kind = BracketSource::Kind;
using Sources = std::vector<BracketSource>;

// A level match is played again, one with a drawn game in it once, others so often in all, one to
// which neither came never; then a lot decides.
constexpr std::uint32_t attempts = 8;
constexpr std::uint32_t drawn_attempts = 2;
constexpr std::uint64_t lots = 0x6c6f7473;  // a sequence of its own, not that of the racks

class Tree {
 public:
  std::size_t add(const BracketSource& one, const BracketSource& two) {
    matches_.push_back(
        {.one = one, .two = two, .round = std::max(round_after(one), round_after(two))});
    return matches_.size() - 1;
  }

  // Winners of neighbours' matches; the matches' numbers are appended to `played`.
  Sources pair_up(const Sources& players, std::vector<std::size_t>& played) {
    Sources winners;
    for (std::size_t i = 0; i + 1 < players.size(); i += 2) {
      played.push_back(add(players[i], players[i + 1]));
      winners.push_back({Kind::winner, played.back()});
    }
    return winners;
  }

  std::vector<BracketMatch> take() { return std::move(matches_); }
  [[nodiscard]] BracketMatch& match(std::size_t number) { return matches_[number]; }

 private:
  [[nodiscard]] std::uint32_t round_after(const BracketSource& source) const {
    return source.kind == Kind::seed ? 0 : matches_[source.of].round + 1;
  }

  std::vector<BracketMatch> matches_;
};

// Seeds in the order of their lines: 1 against the last, and so that 1 and 2 meet in the final.
Sources seed_lines(std::size_t entries) {
  const std::size_t size = std::bit_ceil(entries);
  std::vector<std::size_t> lines{0};
  while (lines.size() < size) {
    std::vector<std::size_t> wider;
    for (const std::size_t seed : lines) {
      wider.push_back(seed);
      wider.push_back(2 * lines.size() - 1 - seed);
    }
    lines = std::move(wider);
  }
  Sources sources;
  for (const std::size_t seed : lines) {
    sources.push_back({Kind::seed, seed});
  }
  return sources;
}

// Losers of these matches, in turned order in every second round, so that those who have met come
// together late.
Sources losers_of(const std::vector<std::size_t>& played, std::size_t round) {
  Sources losers;
  for (const std::size_t match : played) {
    losers.push_back({Kind::loser, match});
  }
  if (round % 2 == 1) {
    std::reverse(losers.begin(), losers.end());
  }
  return losers;
}

}  // namespace

std::vector<BracketMatch> single_elimination_tree(std::size_t entries) {
  Tree tree;
  std::vector<std::size_t> played;
  for (Sources players = seed_lines(entries); players.size() > 1;) {
    players = tree.pair_up(players, played);
  }
  return tree.take();
}

std::vector<BracketMatch> double_elimination_tree(std::size_t entries) {
  Tree tree;
  Sources winners = seed_lines(entries);
  std::vector<std::vector<std::size_t>> rounds;
  while (winners.size() > 1) {
    winners = tree.pair_up(winners, rounds.emplace_back());
  }
  std::vector<std::size_t> played;
  Sources losers = losers_of(rounds.front(), 0);
  for (std::size_t round = 1; round < rounds.size(); ++round) {
    losers = tree.pair_up(losers, played);
    const Sources fallen = losers_of(rounds[round], round);
    Sources both;
    for (std::size_t i = 0; i < fallen.size(); ++i) {
      both.push_back(losers[i]);
      both.push_back(fallen[i]);
    }
    losers = tree.pair_up(both, played);
  }
  for (const std::size_t match : played) {
    tree.match(match).side = BracketSide::losers;
  }
  const std::size_t final_match = tree.add(winners.front(), losers.front());
  const std::size_t reset = tree.add({Kind::winner, final_match}, {Kind::loser, final_match});
  tree.match(final_match).side = BracketSide::final;
  tree.match(reset).side = BracketSide::final;
  tree.match(reset).is_reset = true;
  return tree.take();
}

namespace {

// Who stands at a place of the tree: not known yet, nobody, or an entry.
struct Stand {
  bool is_known = false;
  std::optional<EntryId> entry{};
};

class Elimination {
 public:
  Elimination(std::vector<BracketMatch> tree, const std::vector<EntrySpan>& field,
              const Happened& happened, std::uint64_t seed)
      : tree_(std::move(tree)),
        seed_(seed),
        field_(field),
        happened_(happened),
        outcomes_(tree_.size()),
        first_breaks_(field.size(), 0) {}

  [[nodiscard]] Schedule run() {
    for (std::size_t match = 0; match < tree_.size(); ++match) {
      decide(match);
    }
    now_.is_complete = outcomes_.empty() || outcomes_.back().winner.is_known;
    for (const Pairing& pairing : now_.pairings) {
      now_.rounds_drawn = std::max(now_.rounds_drawn, pairing.round + 1);
    }
    set_places();
    set_bracket();
    return std::move(now_);
  }

 private:
  struct Outcome {
    Stand winner{};
    Stand loser{};
  };

  [[nodiscard]] Stand stand(const BracketSource& source) const {
    if (source.kind == Kind::seed) {
      return {true, source.of < field_.size() ? std::optional(entry_id(source.of)) : std::nullopt};
    }
    const Outcome& outcome = outcomes_[source.of];
    return source.kind == Kind::winner ? outcome.winner : outcome.loser;
  }

  void decide(std::size_t match) {
    const Stand one = stand(tree_[match].one);
    const Stand two = stand(tree_[match].two);
    if (!one.is_known || !two.is_known) {
      return;
    }
    Outcome& outcome = outcomes_[match];
    const bool reset_not_needed = tree_[match].is_reset && match > 0 && one.entry &&
                                  stand(tree_[match - 1].one).entry == one.entry;
    if (!one.entry || !two.entry || reset_not_needed) {
      const bool takes_one = one.entry.has_value();
      outcome = {{true, takes_one ? one.entry : two.entry}, {true, std::nullopt}};
      return;
    }
    const auto winner = play(match, *one.entry, *two.entry);
    if (winner) {
      const EntryId loser = *winner == *one.entry ? *two.entry : *one.entry;
      outcome = {{true, winner}, {true, loser}};
    }
  }

  // Who won, as soon as that is known.
  [[nodiscard]] std::optional<EntryId> play(std::size_t match, EntryId one, EntryId two) {
    const std::uint32_t round = tree_[match].round;
    const EntryId better = std::min(one, two);  // seed
    const EntryId worse = std::max(one, two);
    const bool better_first = first_breaks_[index(better)] <= first_breaks_[index(worse)];
    EntryId first = better_first ? better : worse;
    EntryId second = better_first ? worse : better;
    std::uint32_t drawn = 0;
    for (std::uint32_t attempt = 0; attempt < attempts && drawn < drawn_attempts; ++attempt) {
      const auto number = static_cast<std::uint32_t>(match) * attempts + attempt;
      if (const auto left = walkover(number, one, two)) {
        return left;
      }
      now_.pairings.push_back({number, round, first, second});
      ++first_breaks_[index(first)];
      const auto found = happened_.results.find(number);
      if (found == happened_.results.end()) {
        return std::nullopt;
      }
      const double difference = found->second.first_points() - found->second.second_points();
      if (difference != 0) {
        return difference > 0 ? first : second;
      }
      if (!found->second.was_played()) {
        break;  // neither came
      }
      drawn += found->second.has_drawn_game() ? 1 : 0;
      std::swap(first, second);
    }
    const bool better_goes_on =
        pairing_seed(seed_ ^ lots, static_cast<std::uint32_t>(match)) % 2 == 0;
    now_.lots.push_back({round, better_goes_on ? better : worse, better_goes_on ? worse : better});
    return now_.lots.back().winner;
  }

  // Who goes on because the other one has withdrawn before the match began.
  [[nodiscard]] std::optional<EntryId> walkover(std::uint32_t number, EntryId one,
                                                EntryId two) const {
    if (happened_.begun.contains(number)) {
      return std::nullopt;
    }
    if (field_[index(two)].until) {
      return one;
    }
    return field_[index(one)].until ? std::optional(two) : std::nullopt;
  }

  // Later out is better; who is still in comes first.
  void set_places() {
    const std::size_t entries = field_.size();
    const std::uint32_t in = tree_.empty() ? 0 : tree_.back().round + 2;
    std::vector<std::uint32_t> reached(entries, in);
    for (std::size_t match = 0; match < tree_.size(); ++match) {
      const auto loser = outcomes_[match].loser.entry;
      const bool plays_on = std::any_of(tree_.begin(), tree_.end(), [&](const BracketMatch& later) {
        return (later.one.kind == Kind::loser && later.one.of == match) ||
               (later.two.kind == Kind::loser && later.two.of == match);
      });
      const bool final_decides = loser && plays_on && match + 2 == tree_.size() &&
                                 tree_.back().is_reset && outcomes_.back().loser.is_known &&
                                 !outcomes_.back().loser.entry;
      if (loser && (!plays_on || final_decides)) {
        reached[index(*loser)] = tree_[match].round;
      }
    }
    now_.places.resize(entries);
    for (std::size_t i = 0; i < entries; ++i) {
      now_.places[i] = static_cast<std::uint32_t>(std::count_if(
          reached.begin(), reached.end(), [&](std::uint32_t other) { return other > reached[i]; }));
    }
  }

  // The second final only when it is known to be needed.
  void set_bracket() {
    for (std::size_t match = 0; match < tree_.size(); ++match) {
      const Stand one = stand(tree_[match].one);
      const Stand two = stand(tree_[match].two);
      const Outcome& outcome = outcomes_[match];
      const bool nobody = (one.is_known && !one.entry) || (two.is_known && !two.entry);
      const bool is_needed =
          one.is_known && two.is_known && !(outcome.loser.is_known && !outcome.loser.entry);
      if (tree_[match].is_reset && !is_needed) {
        continue;
      }
      now_.bracket.push_back({.round = tree_[match].round,
                              .side = tree_[match].side,
                              .one = one.entry,
                              .two = two.entry,
                              .winner = outcome.winner.entry,
                              .is_played = !nobody,
                              .pairings = {}});
      for (const Pairing& pairing : now_.pairings) {
        if (pairing.number / attempts == match) {
          now_.bracket.back().pairings.push_back(pairing.number);
        }
      }
    }
  }

  std::vector<BracketMatch> tree_;
  std::uint64_t seed_;
  const std::vector<EntrySpan>& field_;
  const Happened& happened_;
  std::vector<Outcome> outcomes_;
  std::vector<std::uint32_t> first_breaks_;
  Schedule now_;
};

}  // namespace

Schedule elimination_schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                              const Happened& happened) {
  return Elimination(format.kind == FormatKind::single_elimination
                         ? single_elimination_tree(field.size())
                         : double_elimination_tree(field.size()),
                     field, happened, format.seed)
      .run();
}

}  // namespace poolhall::tournament
