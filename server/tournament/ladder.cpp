// The ladder: in each round neighbours by rating meet, in one round the first and the second, the
// third and the fourth, in the next the second and the third. A round is a rating period of
// Glicko-2.
#include <algorithm>
#include <numeric>

#include "server/tournament/formats.hpp"

namespace poolhall::tournament {
namespace {

constexpr double tau = 0.5;  // of Glicko-2, as in its author's example

class Ladder {
 public:
  Ladder(const std::vector<EntrySpan>& field, const Happened& happened)
      : field_(field), happened_(happened), first_breaks_(field.size(), 0) {
    now_.ladder.resize(field.size());
  }

  [[nodiscard]] Schedule run(std::uint32_t rounds) {
    now_.rounds = rounds;
    bool is_over = true;
    for (std::uint32_t round = 0; round < rounds && is_over; ++round) {
      draw(round);
      is_over = finish_round();
    }
    now_.is_complete = is_over;
    now_.places.resize(field_.size());
    const std::vector<std::size_t> order = by_rating();
    for (std::size_t place = 0; place < order.size(); ++place) {
      now_.places[order[place]] = static_cast<std::uint32_t>(place);
    }
    return std::move(now_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> by_rating() const {
    std::vector<std::size_t> order(field_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return now_.ladder[a].rating > now_.ladder[b].rating;
    });
    return order;
  }

  void draw(std::uint32_t round) {
    drawn_.clear();
    std::vector<std::size_t> order = by_rating();
    for (std::size_t i = 0; i < field_.size(); ++i) {
      if (!field_[i].covers(round)) {
        now_.off.push_back({round, entry_id(i), RoundKind::absent});
      }
    }
    std::erase_if(order, [&](std::size_t i) { return !field_[i].covers(round); });
    // Of two nobody would be left to meet in every second round.
    const std::size_t begin = order.size() > 2 ? round % 2 : 0;
    for (std::size_t at = begin; at + 1 < order.size(); at += 2) {
      const bool lower_first = first_breaks_[order[at + 1]] <= first_breaks_[order[at]];
      const std::size_t first = lower_first ? order[at + 1] : order[at];
      const std::size_t second = lower_first ? order[at] : order[at + 1];
      ++first_breaks_[first];
      drawn_.push_back({static_cast<std::uint32_t>(now_.pairings.size()), round, entry_id(first),
                        entry_id(second)});
      now_.pairings.push_back(drawn_.back());
    }
    now_.rounds_drawn = round + 1;
  }

  [[nodiscard]] bool finish_round() {
    std::vector<std::vector<ratings::Glicko2Game>> games(field_.size());
    for (const Pairing& pairing : drawn_) {
      const auto found = happened_.results.find(pairing.number);
      if (found == happened_.results.end()) {
        return false;
      }
      const std::size_t first = index(pairing.first);
      const std::size_t second = index(pairing.second);
      for (const GameScore& game : found->second.games) {
        if (game.was_played) {
          games[first].push_back({now_.ladder[second], game.first});
          games[second].push_back({now_.ladder[first], 1 - game.first});
        }
      }
    }
    for (std::size_t i = 0; i < field_.size(); ++i) {
      now_.ladder[i] = ratings::glicko2(now_.ladder[i], games[i], tau);
    }
    return true;
  }

  const std::vector<EntrySpan>& field_;
  const Happened& happened_;
  std::vector<std::uint32_t> first_breaks_;
  std::vector<Pairing> drawn_;
  Schedule now_;
};

}  // namespace

Schedule ladder_schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                         const Happened& happened) {
  return Ladder(field, happened).run(format.rounds > 0 ? format.rounds : 10);
}

}  // namespace poolhall::tournament
