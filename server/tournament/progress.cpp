#include "server/tournament/progress.hpp"

#include <algorithm>
#include <map>

namespace poolhall::tournament {
namespace {

// Average length of a game, by who plays.
class Averages {
 public:
  explicit Averages(const std::vector<TimedGame>& games) {
    for (const TimedGame& game : games) {
      all_.add(game.time);
      by_players_[key(game)].add(game.time);
    }
  }

  // There must be at least one game.
  [[nodiscard]] Seconds of(const TimedGame& game) const {
    const auto found = by_players_.find(key(game));
    return found == by_players_.end() ? all_.average() : found->second.average();
  }

 private:
  struct Sum {
    Seconds time{0};
    std::size_t games = 0;

    void add(Seconds more) {
      time += more;
      ++games;
    }
    [[nodiscard]] Seconds average() const { return time / static_cast<double>(games); }
  };

  static std::pair<EntryId, EntryId> key(const TimedGame& game) {
    return std::minmax(game.one, game.two);
  }

  Sum all_;
  std::map<std::pair<EntryId, EntryId>, Sum> by_players_;
};

Seconds remaining(const ProgressInput& input) {
  const Averages averages(input.finished);
  Seconds played{0};
  Seconds to_play{0};
  for (const TimedGame& game : input.finished) {
    played += game.time;
  }
  for (const TimedGame& game : input.running) {
    played += game.time;
    to_play += std::max(Seconds{0}, averages.of(game) - game.time);
  }
  for (const TimedGame& game : input.waiting) {
    to_play += averages.of(game);
  }
  const double at_once = played > Seconds{0} ? played / input.elapsed : 1;
  return to_play / std::max(at_once, 1e-6);
}

}  // namespace

Progress progress(const ProgressInput& input) {
  Progress now;
  now.finished = input.finished_before + input.finished.size();
  now.running = input.running.size();
  now.total = now.finished + now.running + input.waiting.size();
  now.elapsed = input.elapsed;
  if (now.finished == now.total) {
    now.remaining = Seconds{0};
  } else if (!input.finished.empty() && input.elapsed > Seconds{0}) {
    now.remaining = remaining(input);
  }
  return now;
}

}  // namespace poolhall::tournament
