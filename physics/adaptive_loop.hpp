// Plays shots as `simulate` does: in double, which is enough for most, and again with balls kept
// in wider numbers (wide.hpp) where rounding may have carried a ball further than
// EventLoop::drift_bound. The time of double, and the accuracy that ill-conditioned shots need.
//
//   AdaptiveLoop<double> loop(table, materials);
//   Recorder<double> log;
//   Ending ending = loop.run(balls, shot, options, log);
//   loop.balls();  // where they lie
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "physics/event_loop.hpp"

namespace poolhall::physics {

template <class Real>
class AdaptiveLoop {
 public:
  AdaptiveLoop(const Table& table, const Materials& materials)
      : table_(table), materials_(materials), quick_(table, materials) {}

  // A watch that was told of a run in doubt is put back to what it was.
  template <class Watch>
  Ending run(const BallSet<Real>& balls, const std::optional<CueShot<Real>>& shot,
             const SimulationOptions& options, Watch& watch) {
    Watch fresh = watch;
    const Ending ending = quick_.run(balls, shot, options, watch);
    if (!quick_.is_doubtful()) {
      return ending;
    }
    watch = std::move(fresh);
    if (!careful_) {
      careful_.emplace(table_, materials_);
    }
    return careful_->run(balls, shot, options, watch);
  }

  // Whether the last run took wider numbers.
  [[nodiscard]] bool was_careful() const { return quick_.is_doubtful(); }
  [[nodiscard]] const BallSet<Real>& balls() const {
    return was_careful() ? careful_->balls() : quick_.balls();
  }
  [[nodiscard]] const EnergyAccount<Real>& energy() const {
    return was_careful() ? careful_->energy() : quick_.energy();
  }
  [[nodiscard]] Real duration() const {
    return was_careful() ? careful_->duration() : quick_.duration();
  }
  [[nodiscard]] std::uint32_t events() const {
    return was_careful() ? careful_->events() : quick_.events();
  }

 private:
  // Where there is no wider number there is nothing to be careful with.
  using Quick = std::conditional_t<std::is_same_v<Wide<Real>, Real>, Lean, Guarded>;

  Table table_;
  Materials materials_;
  EventLoop<Real, Quick> quick_;
  std::optional<EventLoop<Real, Precise>> careful_;
};

}  // namespace poolhall::physics
