#include "server/match/fairness.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "server/match/fair_noise.hpp"

namespace poolhall::match {
namespace {

using storage::Expected;
using storage::Micros;

using ShotKey = std::pair<std::size_t, std::uint32_t>;  // seat, index
using GameShots = std::map<ShotKey, physics::ShotDeviates>;

struct Series {
  std::vector<double> x;
  std::vector<double> y;
};

// Points of the match's first agent; nothing of a game that does not count.
std::optional<double> points_of_first(const storage::MatchRecord& match,
                                      const storage::GameRecord& game) {
  if (!game.result || game.result->reason == rules::EndReason::void_game)
    return std::nullopt;
  if (!game.result->winner)
    return 0.5;
  return game.agents[index(*game.result->winner)] == match.agents[0] ? 1.0 : 0.0;
}

class Gathering {
 public:
  explicit Gathering(storage::Reader& reader) : reader_(reader) {}

  Expected<void> add(const storage::MatchRecord& match) {
    const auto games = reader_.games_of(match.id);
    if (!games)
      return tl::unexpected(games.error());
    ++report_.matches;
    report_.unrevealed += match.over ? 0 : 1;
    std::map<std::uint32_t, double> points;
    std::map<std::uint32_t, GameShots> shots;
    for (const storage::GameRecord& game : *games) {
      ++report_.games;
      auto read = read_game(match, game);
      if (!read)
        return tl::unexpected(read.error());
      const auto scored = points_of_first(match, game);
      if (!scored)
        continue;
      points[game.number] = *scored;
      shots[game.number] = std::move(*read);
    }
    if (match.mirrored != storage::Mirror::none) {
      add_points(points);
      add_deviates(shots);
    }
    return {};
  }

  FairnessReport finish() {
    for (auto& [id, times] : times_) {
      times.thought.sort();
      times.forgiven.sort();
      times.charged = times.thought.total() - times.forgiven.total();
      report_.agents.push_back(std::move(times));
    }
    report_.noise = test_deviates(deviates_);
    report_.points = correlation_of(points_.x, points_.y);
    report_.deviates = correlation_of(pairs_.x, pairs_.y);
    return std::move(report_);
  }

 private:
  // The deviates of its shots, once they are revealed.
  Expected<GameShots> read_game(const storage::MatchRecord& match,
                                const storage::GameRecord& game) {
    auto first = storage::Expected<std::optional<storage::GameRecord>>{};
    if (game.shared_from)
      first = reader_.game(*game.shared_from);
    if (!first)
      return tl::unexpected(first.error());
    GameShots shots;
    const auto read = reader_.each_turn(game.id, [&](const storage::TurnRecord& turn) {
      add_time(game.agents[index(turn.seat)], turn.clock);
      if (turn.shot && match.over)
        add_shot(game, *first, turn, shots);
      return true;
    });
    if (!read)
      return tl::unexpected(read.error());
    return shots;
  }

  void add_time(storage::AgentId agent, const storage::ClockPart& clock) {
    AgentTimes& times = times_[agent];
    times.agent = agent;
    times.thought.add(clock.used);
    times.forgiven.add(clock.forgiven);
  }

  void add_shot(const storage::GameRecord& game, const std::optional<storage::GameRecord>& first,
                const storage::TurnRecord& turn, GameShots& shots) {
    const bool is_shared = turn.shot->shared && first;
    const storage::GameRecord& source = is_shared ? *first : game;
    const ShotIndex which{source.id, turn.seat, turn.shot->index,
                          is_shared ? Stream::shared : Stream::own};
    const auto deviates = shot_deviates(mixed_key(source.key, source.agent_secrets), which);
    ++report_.shots;
    report_.moved_shots += turn.shot->moved ? 1 : 0;
    report_.shared_shots += is_shared ? 1 : 0;
    shots[{index(turn.seat), turn.shot->index}] = deviates;
    // What a pair shares counts once.
    if (!is_shared || game.id == source.id)
      deviates_.push_back(deviates);
  }

  void add_points(const std::map<std::uint32_t, double>& points) {
    Series pairs;
    for (const auto& [number, first] : points) {
      const auto second = points.find(number + 1);
      if (number % 2 == 0 && second != points.end()) {
        pairs.x.push_back(first);
        pairs.y.push_back(second->second);
      }
    }
    if (pairs.x.empty())
      return;
    const double n = static_cast<double>(pairs.x.size());
    const double mean_x = std::accumulate(pairs.x.begin(), pairs.x.end(), 0.0) / n;
    const double mean_y = std::accumulate(pairs.y.begin(), pairs.y.end(), 0.0) / n;
    for (std::size_t i = 0; i < pairs.x.size(); ++i) {
      points_.x.push_back(pairs.x[i] - mean_x);
      points_.y.push_back(pairs.y[i] - mean_y);
    }
  }

  void add_deviates(const std::map<std::uint32_t, GameShots>& games) {
    for (const auto& [number, shots] : games) {
      const auto other = games.find(number + 1);
      if (number % 2 != 0 || other == games.end())
        continue;
      for (const auto& [key, deviates] : shots) {
        const auto same = other->second.find(key);
        if (same == other->second.end())
          continue;
        pairs_.x.insert(pairs_.x.end(), deviates.begin(), deviates.end());
        pairs_.y.insert(pairs_.y.end(), same->second.begin(), same->second.end());
      }
    }
  }

  storage::Reader& reader_;
  FairnessReport report_;
  std::map<storage::AgentId, AgentTimes> times_;
  std::vector<physics::ShotDeviates> deviates_;
  Series points_;
  Series pairs_;
};

}  // namespace

void Durations::sort() {
  std::sort(values_.begin(), values_.end());
}

Micros Durations::total() const {
  return std::accumulate(values_.begin(), values_.end(), Micros{0});
}

Micros Durations::percentile(double share) const {
  if (values_.empty())
    return Micros{0};
  const double rank = std::ceil(share * static_cast<double>(values_.size()));
  const auto at = static_cast<std::size_t>(std::max(1.0, rank)) - 1;
  return values_[std::min(at, values_.size() - 1)];
}

// Fisher's transformation: artanh r is normal with deviation 1 / sqrt(n - 3).
Correlation correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
  Correlation found{.pairs = x.size()};
  constexpr std::size_t least = 4;
  if (x.size() < least)
    return found;
  const bool is_constant = std::all_of(x.begin(), x.end(), [&](double v) { return v == x[0]; }) ||
                           std::all_of(y.begin(), y.end(), [&](double v) { return v == y[0]; });
  if (is_constant)
    return found;
  const double r = std::clamp(correlation(x, y), -1.0, 1.0);
  const double z = std::atanh(std::clamp(r, -1 + 1e-15, 1 - 1e-15));
  const double half = 1.959963984540054 / std::sqrt(static_cast<double>(x.size()) - 3);
  found.value = r;
  found.low = std::tanh(z - half);
  found.high = std::tanh(z + half);
  return found;
}

Expected<FairnessReport> fairness(storage::Reader& reader,
                                  const std::vector<storage::MatchRecord>& matches) {
  Gathering gathering(reader);
  for (const storage::MatchRecord& match : matches) {
    Expected<void> added;
    const auto read = reader.consistently([&] { added = gathering.add(match); });
    if (!read || !added)
      return tl::unexpected(read ? added.error() : read.error());
  }
  return gathering.finish();
}

}  // namespace poolhall::match
