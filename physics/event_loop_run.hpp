// Bodies of EventLoop's members that let events happen; include event_loop.hpp.
#pragma once

namespace poolhall::physics {

template <class Real, class Policy>
typename EventLoop<Real, Policy>::Exact EventLoop<Real, Policy>::elapsed(std::size_t i) const {
  const Instant<Real>& start = bodies_[i].motion.start;
  return (Exact(now_.high) - Exact(start.high)) + (Exact(now_.low) - Exact(start.low));
}

template <class Real, class Policy>
Ball<typename EventLoop<Real, Policy>::Exact> EventLoop<Real, Policy>::ball_now(
    std::size_t i) const {
  if (bodies_[i].exact.state == MotionState::stationary) {
    return resting(bodies_[i].id, bodies_[i].exact.position);
  }
  return ball_at(bodies_[i].exact, bodies_[i].id, elapsed(i), c_);
}

template <class Real, class Policy>
Hop EventLoop<Real, Policy>::hop(const Exact& closing) const {
  // A ball that left at the separation speed comes back with it, but for rounding.
  return closing <= c_.separation_speed * (Exact(1) + Exact(1e-6)) ? Hop::yes : Hop::no;
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::account(const Exact& before, const Exact& after) {
  if (after > before) {
    added_ += after - before;
  }
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::tell(Watch& watch, EventType type, const Ball<Exact>& after,
                                 const BoundaryHit<Exact>* hit, Hop hop_kind) const {
  if constexpr (Watch::records) {
    Event<Real> event;
    event.t = now_.high;
    event.type = type;
    event.after[0] = converted<Real>(after);
    if (type == EventType::rail_collision) {
      event.rail = hit->rail;
    }
    event.pocket = after.pocket;
    watch.record(event, hop_kind);
  }
  return watch.see({type, after.id, after.id, after.pocket});
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::tell_contact(Watch& watch, const Ball<Exact>& first,
                                         const Ball<Exact>& second, Hop hop_kind) const {
  if constexpr (Watch::records) {
    Event<Real> event;
    event.t = now_.high;
    event.type = EventType::ball_collision;
    event.ball_count = 2;
    event.after = {converted<Real>(first), converted<Real>(second)};
    watch.record(event, hop_kind);
  }
  return watch.see({EventType::ball_collision, first.id, second.id, std::nullopt});
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::strike_cue_ball(const CueShot<Real>& shot, Watch& watch) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (bodies_[i].id != cue_ball || (present_ & only(i)) == 0) {
      continue;
    }
    const auto& given = shot.given;
    const CueShot<Exact> stroke = cue_shot_from_degrees(
        Exact(given.a), Exact(given.b), Exact(given.theta), Exact(given.phi), Exact(given.v));
    const Ball<Exact> after =
        settled(strike(converted<Exact>(balls_[i]), stroke, materials_), c_.radius);
    begin_motion(i, after);
    if constexpr (Policy::stops_in_doubt) {
      drift_[i] = drift_[i].disturbed(dot(after.velocity, after.velocity));
    }
    ++events_;
    return tell(watch, EventType::cue_strike, after);
  }
  return Go::stop;
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::transition(std::size_t i, Watch& watch) {
  const Ball<Exact> after = after_transition(bodies_[i].exact, bodies_[i].id, c_);
  if constexpr (Policy::stops_in_doubt) {
    carry_drift(i);
    drift_[i] = drift_[i].disturbed(dot(after.velocity, after.velocity));
  }
  begin_motion(i, after);
  refresh(only(i));
  return tell(watch, EventType::transition, after);
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::pocket(std::size_t i, Watch& watch) {
  const Body& body = bodies_[i];
  Ball<Exact> after;
  after.id = body.id;
  after.state = MotionState::pocketed;
  after.position = position_at(body.exact, body.hit.t);
  after.pocket = body.hit.pocket;
  present_ &= ~only(i);
  moving_ &= ~only(i);
  balls_[i] = converted<Real>(after);
  refresh(only(i));
  return tell(watch, EventType::pocketed, after);
}

// The model runs unraised; then only the normal speed is raised to the separation speed.
template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::bounce(std::size_t i, Watch& watch) {
  const BoundaryHit<Exact> hit = bodies_[i].hit;
  const Vec2<Exact> inward = Exact(-1) * hit.into;
  Ball<Exact> before = ball_at(bodies_[i].exact, bodies_[i].id, hit.t, c_);
  if (hit.surface == Surface::line) {
    put_on_rail(before, exact_boundary_, hit.rail);
  }
  Exact closing = -dot(before.velocity, inward);
  if (closing < Exact(0)) {
    // Pressed there by its own acceleration, but for rounding.
    before.velocity = before.velocity + closing * inward;
    closing = Exact(0);
  }
  Ball<Exact> after = after_cushion(before, hit.into, materials_, nose_);
  const Exact leaving = dot(after.velocity, inward);
  if (leaving < c_.separation_speed) {
    after.velocity = after.velocity + (c_.separation_speed - leaving) * inward;
    account(kinetic_energy(before, c_), kinetic_energy(after, c_));
  }
  settle(after, c_.radius);
  if constexpr (Policy::stops_in_doubt) {
    drift_off(i, hit.surface, before, after, closing);
  }
  begin_motion(i, after);
  refresh(only(i));
  return tell(watch, EventType::rail_collision, after, &hit, hop(closing));
}

// Whether a third ball may be close enough to i or k to be hit together with them.
template <class Real, class Policy>
bool EventLoop<Real, Policy>::is_crowded(std::size_t i, std::size_t k) const {
  const auto now = [this](std::size_t j) {
    return position_at(bodies_[j].motion, Real(now_ - bodies_[j].motion.start));
  };
  const Vec2<Real> at_i = now(i), at_k = now(k);
  const Vec2<Real> v = velocity_at(bodies_[i].motion, Real(now_ - bodies_[i].motion.start)) -
                       velocity_at(bodies_[k].motion, Real(now_ - bodies_[k].motion.start));
  const Real reach = reach_ + static_cast<Real>(cluster_.widest_gap(Exact(length(v)), contact_));
  const Indices third = present_ & ~only(i) & ~only(k);
  Indices left = near({at_i.x, at_i.x}, {at_i.y, at_i.y}, reach, third) |
                 near({at_k.x, at_k.x}, {at_k.y, at_k.y}, reach, third);
  for (; left != 0; left &= left - 1) {
    const Vec2<Real> at = now(static_cast<std::size_t>(std::countr_zero(left)));
    const Vec2<Real> from_i = at - at_i, from_k = at - at_k;
    if (dot(from_i, from_i) <= reach * reach || dot(from_k, from_k) <= reach * reach) {
      return true;
    }
  }
  return false;
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::meet_together(std::size_t i, std::size_t k, Watch& watch) {
  typename ContactCluster<Exact>::Balls balls{};
  Exact before(0), after(0);
  for (std::size_t j = 0; j < count_; ++j) {
    if ((present_ & only(j)) != 0) {
      balls[j] = ball_now(j);
      before += kinetic_energy(balls[j], c_);
    }
  }
  cluster_.gather(balls, present_, i, k, contact_);
  if (cluster_.contacts() == 1) {
    return meet_alone(i, k, watch);
  }
  if constexpr (Policy::stops_in_doubt) {
    doubtful_ = true;
    return Go::stop;
  }
  cluster_.resolve(balls, materials_.ball_friction, contact_);
  for (std::size_t j = 0; j < count_; ++j) {
    after += kinetic_energy(balls[j], c_);
    if ((cluster_.changed() & only(j)) != 0) {
      begin_motion(j, balls[j]);
    }
  }
  if (cluster_.raised()) {
    account(before, after);
  }
  refresh(cluster_.changed());
  events_ += static_cast<std::uint32_t>(cluster_.hits()) - 1;
  Go go = Go::on;
  for (std::size_t n = 0; n < cluster_.hits(); ++n) {
    const ClusterHit<Exact>& one = cluster_.hit(n);
    if (tell_contact(watch, balls[one.first], balls[one.second], hop(one.impulse)) == Go::stop) {
      go = Go::stop;
    }
  }
  return go;
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::meet(std::size_t i, std::size_t k, Watch& watch) {
  if (bodies_[k].id < bodies_[i].id) {
    return meet(k, i, watch);
  }
  if (contact_ != ContactModel::sequential &&
      (!Policy::omits(Omission::far_neighbours) || is_crowded(i, k))) {
    return meet_together(i, k, watch);
  }
  return meet_alone(i, k, watch);
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::meet_alone(std::size_t i, std::size_t k, Watch& watch) {
  Ball<Exact> first = ball_now(i);
  Ball<Exact> second = ball_now(k);
  if constexpr (Policy::stops_in_doubt) {
    drift_together(i, k, first, second);
  }
  const Impact<Exact> impact = strike_together<Policy>(first, second, c_, materials_.ball_friction);
  if (impact.raised) {
    account(kinetic_energy(ball_now(i), c_) + kinetic_energy(ball_now(k), c_),
            kinetic_energy(first, c_) + kinetic_energy(second, c_));
  }
  begin_motion(i, first);
  begin_motion(k, second);
  refresh(only(i) | only(k));
  return tell_contact(watch, first, second, hop(impact.closing));
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::happen(std::size_t i, Watch& watch) {
  const Candidate next = bodies_[i].next;
  now_ = last_ = next.at;
  ++events_;
  switch (next.what) {
    case Next::transition:
      return transition(i, watch);
    case Next::pocket:
      return pocket(i, watch);
    case Next::rail:
      return bounce(i, watch);
    case Next::contact:
      return meet(i, next.partner, watch);
    case Next::nothing:
      break;
  }
  return Go::stop;
}

template <class Real, class Policy>
Real EventLoop<Real, Policy>::energy_now() const {
  Exact sum(0);
  for (Indices left = present_; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    if (bodies_[i].exact.state != MotionState::stationary) {
      sum += kinetic_energy(ball_now(i), c_);
    }
  }
  return static_cast<Real>(sum);
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::finish(const Instant<Real>& at) {
  now_ = at;
  energy_.end = energy_now();
  energy_.added_by_separation = static_cast<Real>(added_);
  for (Indices left = present_; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    if constexpr (Policy::stops_in_doubt) {
      carry_drift(i);
    }
    if (bodies_[i].exact.state != MotionState::stationary) {
      balls_[i] = converted<Real>(ball_now(i));
    } else if ((touched_ & only(i)) != 0) {
      balls_[i].state = MotionState::stationary;
      balls_[i].position = bodies_[i].motion.position;
      balls_[i].velocity = {};
      balls_[i].angular_velocity = {};
    }
  }
}

template <class Real, class Policy>
template <class Watch>
Ending EventLoop<Real, Policy>::run(const BallSet<Real>& balls,
                                    const std::optional<CueShot<Real>>& shot,
                                    const SimulationOptions& options, Watch& watch) {
  contact_ = options.contact;
  solver_ = options.solver;
  place(balls);
  Go go = Go::on;
  if (shot) {
    go = strike_cue_ball(*shot, watch);
  }
  energy_.start = energy_now();
  refresh(present_);
  const Instant<Real> end =
      options.t_max ? Instant<Real>{Real(*options.t_max), Real(0)} : never<Real>();
  Ending ending = Ending::at_rest;
  while (go == Go::on && busy_ != 0 && !doubtful_) {
    const std::size_t i = earliest();
    if (end < bodies_[i].next.at) {
      ending = Ending::t_max;
      break;
    }
    if (events_ >= options.event_limit) {
      ending = Ending::event_limit;
      break;
    }
    go = happen(i, watch);
  }
  finish(ending == Ending::t_max ? end : now_);
  return go == Go::on && !doubtful_ ? ending : Ending::stopped;
}

}  // namespace poolhall::physics
