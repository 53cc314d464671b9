// Bodies of EventLoop's members that estimate what rounding has done; include event_loop.hpp.
#pragma once

namespace poolhall::physics {

// To now. What is not a number is in doubt too.
template <class Real, class Policy>
void EventLoop<Real, Policy>::carry_drift(std::size_t i) {
  if (bodies_[i].exact.state != MotionState::stationary) {
    drift_[i] = drift_[i].after(static_cast<Real>(elapsed(i)), extent_);
    doubtful_ = doubtful_ || !(drift_[i].place <= Real(drift_bound * drift_bound));
  }
}

// Off a rail, a facing or an arc, which is met like a ball of a smaller radius.
template <class Real, class Policy>
void EventLoop<Real, Policy>::drift_off(std::size_t i, Surface surface, const Ball<Exact>& before,
                                        const Ball<Exact>& after, const Exact& closing) {
  carry_drift(i);
  const Vec2<Exact> change = after.velocity - before.velocity;
  const Real closing_squared = static_cast<Real>(closing * closing);
  const Real speed_squared = static_cast<Real>(dot(before.velocity, before.velocity));
  if (surface == Surface::arc) {
    drift_[i] = drift_[i].slanted(closing_squared, speed_squared, reach_squared_ / Real(4));
  }
  drift_[i] = drift_[i]
                  .turned(closing_squared, static_cast<Real>(dot(change, change)))
                  .disturbed(cushion_roughness_ * speed_squared);
}

// Of two balls as they come together.
template <class Real, class Policy>
void EventLoop<Real, Policy>::drift_together(std::size_t i, std::size_t k, const Ball<Exact>& first,
                                             const Ball<Exact>& second) {
  carry_drift(i);
  carry_drift(k);
  const Vec2<Exact> relative = first.velocity - second.velocity;
  const Vec2<Exact> apart = second.position - first.position;
  const Real speed_squared = static_cast<Real>(dot(relative, relative));
  const Real closing = static_cast<Real>(dot(relative, apart)) / reach_;
  const Drift<Real> both{drift_[i].place + drift_[k].place,
                         drift_[i].velocity + drift_[k].velocity};
  drift_[i] = drift_[k] = both.slanted(closing * closing, speed_squared, reach_squared_)
                              .turned(closing * closing, closing * closing)
                              .disturbed(speed_squared);
}

}  // namespace poolhall::physics
