#include "server/net/shared_noise.hpp"

#include <utility>

namespace poolhall::net {

namespace {

std::size_t index(PairSide side) {
  return static_cast<std::size_t>(side);
}

PairSide other(PairSide side) {
  return side == PairSide::first ? PairSide::second : PairSide::first;
}

}  // namespace

bool SharedNoise::was_run(ShotKey shot) const {
  const std::size_t seat = rules::index(shot.seat);
  return run_.contains(shot) || shot.index <= played_[0][seat] || shot.index <= played_[1][seat];
}

void SharedNoise::submit(PairSide side, ShotKey shot, std::function<void(Run)> run) {
  std::optional<Waiting>& partner = waiting_[index(other(side))];
  if (was_run(shot) || left_[0] || left_[1]) {
    run_.insert(shot);
    run(Run::alone);
    return;
  }
  if (partner && partner->shot == shot) {
    run_.insert(shot);
    const std::function<void(Run)> run_first = std::move(partner->run);
    partner.reset();
    run_first(Run::shared);
    run(Run::shared);
    return;
  }
  waiting_[index(side)] = Waiting{shot, std::move(run),
                                  deadlines_.at(std::chrono::steady_clock::now() + patience_,
                                                [this, side] { run_alone(side); })};
  // Each waiting for another shot of the other's, neither would ever come: the older goes on.
  run_alone(other(side));
}

void SharedNoise::run_alone(PairSide side) {
  std::optional<Waiting>& waiting = waiting_[index(side)];
  if (!waiting) {
    return;
  }
  const std::function<void(Run)> run = std::move(waiting->run);
  run_.insert(waiting->shot);
  waiting.reset();
  run(Run::alone);
}

void SharedNoise::leave(PairSide side) {
  left_[index(side)] = true;
  run_alone(PairSide::first);
  run_alone(PairSide::second);
}

}  // namespace poolhall::net
