// The quality criteria of FIDE's Dutch system (Handbook C.04.3 as in force since 1 February 2026,
// article 2) as weights of pairs: one field of bits a criterion, the more important ones higher,
// wide enough that sums over all pairs stay inside. The heaviest matching is then the best pairing
// of a bracket, ties of the quality criteria left apart.
//
//   BracketWeights weights(bracket, players, terms, ByeBracket::no);
//   FieldWriter fields;
//   weights.append_quality(fields, a, b);   // a ranks before b
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/tournament/matching.hpp"
#include "server/tournament/swiss_history.hpp"

namespace poolhall::tournament {

struct SwissTerms {
  std::uint32_t rounds = 1;              // of the whole tournament
  BreakSide initial = BreakSide::first;  // what odd numbers get in the first round
};

// Fields of a weight, from the most important one down.
class FieldWriter {
 public:
  FieldWriter& append(std::uint64_t value, unsigned width) {
    weight_ <<= width;
    weight_ += value;
    return *this;
  }
  // For what is worth less the greater it is.
  FieldWriter& append_cost(const Weight& cost, unsigned width) {
    weight_ <<= width;
    weight_ -= cost;
    return *this;
  }
  [[nodiscard]] const Weight& weight() const { return weight_; }

 private:
  Weight weight_ = 0;
};

// Bits for sums up to `sum`.
[[nodiscard]] unsigned width_for(std::uint64_t sum);

// Indices of players; all four parts in the order of rank.
struct SwissBracket {
  std::vector<std::size_t> moved_down{};  // MDPs, 1.4.1
  std::vector<std::size_t> residents{};
  std::vector<std::size_t> next{};  // residents of the following bracket
  std::vector<std::size_t> rest{};
};

// Whether this bracket downfloats nobody but the one who gets the bye (the note to C9).
enum class ByeBracket : std::uint8_t { no, yes };

class BracketWeights {
 public:
  BracketWeights(const SwissBracket& bracket, const std::vector<SwissPlayer>& players,
                 const SwissTerms& terms, ByeBracket bye);

  // C6 to C21 of the pair; `a` ranks before `b`, both are in the bracket or below.
  void append_quality(FieldWriter& fields, std::size_t a, std::size_t b) const;
  // C6 to C8 alone.
  void append_downfloaters(FieldWriter& fields, std::size_t a, std::size_t b) const;

 private:
  enum class Place : std::uint8_t { rest, next, resident, moved_down };

  struct ScoreGroup {
    int score = 0;
    unsigned width = 0;
  };

  void append_by_score(FieldWriter& fields, const std::vector<ScoreGroup>& groups, int score,
                       bool counts) const;
  void append_bye(FieldWriter& fields, std::size_t a, std::size_t b) const;
  void append_breaks(FieldWriter& fields, std::size_t a, std::size_t b) const;
  void append_floats(FieldWriter& fields, std::size_t a, std::size_t b) const;
  [[nodiscard]] std::vector<ScoreGroup> groups_of(const std::vector<std::size_t>& members) const;
  [[nodiscard]] bool is_pair_here(std::size_t b) const {
    return place_[b] == Place::resident;  // the lower of two in the bracket is a resident
  }

  const std::vector<SwissPlayer>& players_;
  BreakSide initial_;
  ByeBracket bye_;
  std::vector<Place> place_;            // by player
  unsigned count_ = 0;                  // width of a count of players
  unsigned unplayed_ = 0;               // width of a sum of unplayed rounds
  std::vector<ScoreGroup> moved_down_;  // highest first
  std::vector<ScoreGroup> here_;        // the same with the residents
};

}  // namespace poolhall::tournament
