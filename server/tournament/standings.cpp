#include "server/tournament/standings.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

#include "physics/words.hpp"

namespace poolhall::tournament {
namespace {

constexpr physics::Words<TieBreak, 5> tie_break_names{{
    {TieBreak::direct_encounter, "direct_encounter"},
    {TieBreak::buchholz_cut1, "buchholz_cut1"},
    {TieBreak::buchholz, "buchholz"},
    {TieBreak::sonneborn_berger, "sonneborn_berger"},
    {TieBreak::wins, "wins"},
}};

using Rows = std::vector<StandingsRow>;

void count(const PlayedGame& game, EntryId entry, StandingsRow& row) {
  row.points += score_of(game, entry);
  row.wins += game.winner == entry ? 1 : 0;
  row.draws += game.winner ? 0 : 1;
  row.losses += game.winner && game.winner != entry ? 1 : 0;
}

Rows counted(std::size_t entries, const std::vector<PlayedGame>& games) {
  Rows rows(entries);
  for (std::size_t i = 0; i < entries; ++i) {
    rows[i].entry = entry_id(i);
  }
  for (const PlayedGame& game : games) {
    count(game, game.breaker, rows[index(game.breaker)]);
    count(game, game.other, rows[index(game.other)]);
  }
  return rows;
}

// Sonneborn-Berger of each entry.
std::vector<double> sonneborn_berger(const Rows& rows, const std::vector<PlayedGame>& games) {
  std::vector<double> sums(rows.size(), 0);
  for (const PlayedGame& game : games) {
    const std::size_t breaker = index(game.breaker);
    const std::size_t other = index(game.other);
    sums[breaker] += score_of(game, game.breaker) * rows[other].points;
    sums[other] += score_of(game, game.other) * rows[breaker].points;
  }
  return sums;
}

// Points of each entry's opponents, ascending: one for each match and each unplayed round.
std::vector<std::vector<double>> opponents_points(const Rows& rows,
                                                  const std::vector<PlayedGame>& games,
                                                  const std::vector<std::uint32_t>& unplayed) {
  std::vector<std::vector<double>> points(rows.size());
  std::set<std::uint32_t> counted;
  for (const PlayedGame& game : games) {
    if (counted.insert(game.pairing).second) {
      points[index(game.breaker)].push_back(rows[index(game.other)].points);
      points[index(game.other)].push_back(rows[index(game.breaker)].points);
    }
  }
  for (std::size_t i = 0; i < unplayed.size(); ++i) {
    points[i].insert(points[i].end(), unplayed[i], rows[i].points);
  }
  for (auto& list : points) {
    std::sort(list.begin(), list.end());
  }
  return points;
}

double sum(const std::vector<double>& values, std::size_t from) {
  return from >= values.size() ? 0
                               : std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(from),
                                                 values.end(), 0.0);
}

// Orders entries by splitting groups of tied ones by one criterion after the other.
class Ranking {
 public:
  Ranking(Rows rows, const std::vector<PlayedGame>& games, const TableRules& rules)
      : rows_(std::move(rows)),
        games_(games),
        tie_breaks_(rules.tie_breaks),
        places_(rules.places),
        sonneborn_berger_(sonneborn_berger(rows_, games)),
        opponents_(opponents_points(rows_, games, rules.unplayed)) {
    for (StandingsRow& row : rows_) {
      row.tie_breaks.assign(tie_breaks_.size(), 0);
    }
  }

  [[nodiscard]] Rows ranked() {
    std::vector<std::size_t> all(rows_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    const auto by_points = [&](const std::vector<std::size_t>& tied) {
      split(
          tied, [&](std::size_t i) { return rows_[i].points; },
          [&](const std::vector<std::size_t>& still_tied) { part(still_tied, 0); });
    };
    split(
        all, [&](std::size_t i) { return places_.empty() ? 0.0 : -1.0 * places_[i]; }, by_points);
    return std::move(ordered_);
  }

 private:
  // Hands on the members of `group` in parts of equal value, the highest first.
  template <class Value, class Next>
  static void split(std::vector<std::size_t> group, Value value, Next next) {
    std::stable_sort(group.begin(), group.end(),
                     [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
    for (auto first = group.begin(); first != group.end();) {
      const auto last = std::find_if(first, group.end(),
                                     [&](std::size_t i) { return value(i) != value(*first); });
      next(std::vector<std::size_t>(first, last));
      first = last;
    }
  }

  void part(const std::vector<std::size_t>& tied, std::size_t criterion) {
    if (criterion == tie_breaks_.size()) {
      place(tied);
      return;
    }
    const std::vector<double> values = values_of(tied, tie_breaks_[criterion]);
    for (const std::size_t i : tied) {
      rows_[i].tie_breaks[criterion] = values[i];
    }
    split(
        tied, [&](std::size_t i) { return values[i]; },
        [&](const std::vector<std::size_t>& still_tied) { part(still_tied, criterion + 1); });
  }

  [[nodiscard]] std::vector<double> values_of(const std::vector<std::size_t>& tied,
                                              TieBreak criterion) const {
    std::vector<double> values(rows_.size(), 0);
    switch (criterion) {
      case TieBreak::direct_encounter:
        return direct_encounter(tied);
      case TieBreak::sonneborn_berger:
        return sonneborn_berger_;
      case TieBreak::buchholz:
      case TieBreak::buchholz_cut1:
        for (const std::size_t i : tied) {
          values[i] = sum(opponents_[i], criterion == TieBreak::buchholz ? 0 : 1);
        }
        break;
      case TieBreak::wins:
        for (const std::size_t i : tied) {
          values[i] = rows_[i].wins;
        }
        break;
    }
    return values;
  }

  [[nodiscard]] std::vector<double> direct_encounter(const std::vector<std::size_t>& tied) const {
    std::vector<bool> inside(rows_.size(), false);
    for (const std::size_t i : tied) {
      inside[i] = true;
    }
    std::vector<double> values(rows_.size(), 0);
    for (const PlayedGame& game : games_) {
      if (inside[index(game.breaker)] && inside[index(game.other)]) {
        values[index(game.breaker)] += score_of(game, game.breaker);
        values[index(game.other)] += score_of(game, game.other);
      }
    }
    return values;
  }

  void place(const std::vector<std::size_t>& tied) {
    const auto rank = static_cast<std::uint32_t>(ordered_.size() + 1);
    for (const std::size_t i : tied) {
      rows_[i].rank = rank;
      ordered_.push_back(rows_[i]);
    }
  }

  Rows rows_;
  const std::vector<PlayedGame>& games_;
  const std::vector<TieBreak>& tie_breaks_;
  const std::vector<std::uint32_t>& places_;
  std::vector<double> sonneborn_berger_;
  std::vector<std::vector<double>> opponents_;
  Rows ordered_;
};

std::vector<ratings::RatedGame> rated(const std::vector<PlayedGame>& games) {
  std::vector<ratings::RatedGame> rated;
  for (const PlayedGame& game : games) {
    if (was_played(game.reason, game.turns)) {
      // Games of a pair share their rack.
      const std::uint64_t pair = (std::uint64_t{game.pairing} << 32U) | (game.number / 2);
      rated.push_back(
          {index(game.breaker), index(game.other), score_of(game, game.breaker), 1, pair});
    }
  }
  return rated;
}

}  // namespace

std::string_view name(TieBreak tie_break) {
  return physics::word_of(tie_break_names, tie_break);
}

std::optional<TieBreak> tie_break(std::string_view name) {
  return physics::value_of(tie_break_names, name);
}

Standings standings(std::size_t entries, const std::vector<PlayedGame>& games,
                    const std::vector<TieBreak>& tie_breaks) {
  return standings(entries, games, TableRules{.tie_breaks = tie_breaks});
}

Standings standings(std::size_t entries, const std::vector<PlayedGame>& games,
                    const TableRules& rules) {
  Standings table;
  Rows rows = counted(entries, games);
  for (std::size_t i = 0; i < rules.points.size(); ++i) {
    rows[i].points = rules.points[i];
  }
  table.rows = Ranking(std::move(rows), games, rules).ranked();
  table.tie_breaks = rules.tie_breaks;
  table.has_ladder = !rules.ladder.empty();
  const ratings::RatingTable ratings = ratings::bradley_terry(entries, rated(games));
  for (StandingsRow& row : table.rows) {
    row.rating = ratings.players[index(row.entry)];
    if (!rules.ladder.empty()) {
      row.ladder = rules.ladder[index(row.entry)];
    }
  }
  for (std::size_t i = 0; i + 1 < table.rows.size(); ++i) {
    table.rows[i].superiority = ratings::likelihood_of_superiority(
        ratings, index(table.rows[i].entry), index(table.rows[i + 1].entry));
  }
  table.break_advantage = ratings.break_advantage;
  for (const PlayedGame& game : games) {
    ++table.endings[game.reason];
  }
  return table;
}

}  // namespace poolhall::tournament
