// What a match or a tournament was like for its players: time charged and forgiven, how long turns
// took, whether the revealed noise is what it should be, and what mirrored pairs had in common.
//
//   FairnessReport report = fairness(*reader, matches).value();
//   report.agents[0].thought.percentile(0.95)
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "server/match/goodness.hpp"
#include "server/storage/database.hpp"

namespace poolhall::match {

// Durations in the order of their length.
class Durations {
 public:
  void add(storage::Micros duration) { values_.push_back(duration); }
  void sort();

  [[nodiscard]] std::size_t count() const { return values_.size(); }
  [[nodiscard]] storage::Micros total() const;
  // The least that at least this share of all does not exceed; zero of none. Sorted only.
  [[nodiscard]] storage::Micros percentile(double share) const;

 private:
  std::vector<storage::Micros> values_;
};

struct AgentTimes {
  storage::AgentId agent{};
  Durations thought;           // of each turn, lag and all
  Durations forgiven;          // of each turn, of that
  storage::Micros charged{0};  // in all
};

// A correlation with Fisher's 95 % interval; nothing of fewer than four pairs or of a constant.
struct Correlation {
  std::size_t pairs = 0;
  std::optional<double> value{};
  double low = 0;
  double high = 0;
};

struct FairnessReport {
  std::uint64_t matches = 0;
  std::uint64_t games = 0;
  std::uint64_t unrevealed = 0;  // matches that go on: their noise is secret
  std::vector<AgentTimes> agents;
  std::uint64_t shots = 0;         // with revealed noise
  std::uint64_t moved_shots = 0;   // of them
  std::uint64_t shared_shots = 0;  // of them
  std::vector<NoiseTest> noise;
  // Of mirrored pairs, over all pairs: one agent's points in both games, less its mean in the
  // match; the deviates of both games' shots with the same seat and index.
  Correlation points;
  Correlation deviates;
};

[[nodiscard]] storage::Expected<FairnessReport> fairness(
    storage::Reader& reader, const std::vector<storage::MatchRecord>& matches);

[[nodiscard]] Correlation correlation_of(const std::vector<double>& x,
                                         const std::vector<double>& y);

}  // namespace poolhall::match
