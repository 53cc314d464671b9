// The bodies of EventLoop's members; include event_loop.hpp.
#pragma once

namespace poolhall::physics {

template <class Real, class Policy>
void EventLoop<Real, Policy>::place(const BallSet<Real>& balls) {
  count_ = balls.count;
  now_ = last_ = {};
  events_ = 0;
  energy_ = {};
  balls_ = balls;
  for (std::size_t i = 0; i < count_; ++i) {
    bodies_[i].id = balls[i].id;
    bodies_[i].down = balls[i].state == MotionState::pocketed;
    begin_motion(i, balls[i]);
  }
}

// From now on ball i moves as `ball`; who it meets is found by `refresh`.
template <class Real, class Policy>
void EventLoop<Real, Policy>::begin_motion(std::size_t i, const Ball<Real>& ball) {
  Body& body = bodies_[i];
  body.motion = segment(ball, now_, c_);
  body.moves = ball.state == MotionState::rolling || ball.state == MotionState::sliding;
  const bool turns = body.moves || ball.state == MotionState::spinning;
  body.own = {};
  if (!turns) {
    body.across = {ball.position.x, ball.position.x};
    body.along = {ball.position.y, ball.position.y};
    return;
  }
  const Segment<Real>& s = body.motion;
  body.hit = {};
  body.hit.t = s.duration;
  if (body.moves) {
    body.across = span(s.position.x, s.velocity.x, s.acceleration.x, s.duration);
    body.along = span(s.position.y, s.velocity.y, s.acceleration.y, s.duration);
    const Span<Real> all{-forever<Real>(), forever<Real>()};
    const bool near_only = Policy::omits(Omission::far_rails);
    const Span<Real>& across = near_only ? body.across : all;
    const Span<Real>& along = near_only ? body.along : all;
    body.hit = has_jaws_ ? jaws_.first_hit(s, across, along, s.duration, solver_)
                         : first_hit(boundary_, s, across, along, s.duration);
    if (body.hit.kind != HitKind::none) {
      body.across = span(s.position.x, s.velocity.x, s.acceleration.x, body.hit.t);
      body.along = span(s.position.y, s.velocity.y, s.acceleration.y, body.hit.t);
    }
  }
  if (body.hit.t < forever<Real>()) {
    body.own.at = later(now_, body.hit.t);
    body.own.what = body.hit.kind == HitKind::none
                        ? Next::transition
                        : (body.hit.kind == HitKind::pocket ? Next::pocket : Next::rail);
  }
}

// Balls of `changed` have new motions. Whoever expected to meet one of them looks again as well:
// it had not looked beyond that meeting. Then for each pair the first contact is not before the
// earlier of both balls' next events, so that the earliest `next` of all is the next event.
template <class Real, class Policy>
void EventLoop<Real, Policy>::refresh(Indices changed) {
  Indices stale = changed;
  for (std::size_t k = 0; k < count_; ++k) {
    const Candidate& next = bodies_[k].next;
    if (next.what == Next::contact && ((changed >> next.partner) & 1U) != 0) {
      stale |= Indices{1} << k;
    }
  }
  for (std::size_t k = 0; k < count_; ++k) {
    if (((stale >> k) & 1U) != 0) {
      bodies_[k].next = bodies_[k].own;
    }
  }
  Indices done = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    if (((stale >> k) & 1U) != 0 && !bodies_[k].down) {
      sweep(k, done);
      done |= Indices{1} << k;
    }
  }
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::sweep(std::size_t i, Indices done) {
  const Body& body = bodies_[i];
  for (std::size_t k = 0; k < count_; ++k) {
    const Body& other = bodies_[k];
    if (k == i || ((done >> k) & 1U) != 0 || other.down) {
      continue;
    }
    if (Policy::omits(Omission::pairs_at_rest) && !(body.moves || other.moves)) {
      continue;
    }
    if (!Policy::omits(Omission::far_pairs)) {
      look_for_contact(i, k);
      continue;
    }
    if (body.across.low > other.across.high + c_.diameter ||
        other.across.low > body.across.high + c_.diameter ||
        body.along.low > other.along.high + c_.diameter ||
        other.along.low > body.along.high + c_.diameter) {
      continue;
    }
    look_for_contact(i, k);
  }
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::look_for_contact(std::size_t i, std::size_t k) {
  Body& one = bodies_[i];
  Body& other = bodies_[k];
  const bool clip = Policy::omits(Omission::late_contacts);
  const Instant<Real>& one_until = clip ? one.next.at : one.own.at;
  const Instant<Real>& other_until = clip ? other.next.at : other.own.at;
  const Instant<Real>& until = one_until < other_until ? one_until : other_until;
  const PairMotion<Real> pair = pair_motion(one.motion, other.motion, now_, c_);
  const std::optional<Real> t = first_contact<Policy>(pair, Real(until - now_), solver_);
  if (!t) {
    return;
  }
  const Instant<Real> at = later(now_, *t);
  if (at < one.next.at) {
    one.next = {at, Next::contact, static_cast<std::uint8_t>(k)};
  }
  if (at < other.next.at) {
    other.next = {at, Next::contact, static_cast<std::uint8_t>(i)};
  }
}

template <class Real, class Policy>
bool EventLoop<Real, Policy>::precedes(std::size_t i, std::size_t k) const {
  const Candidate& p = bodies_[i].next;
  const Candidate& q = bodies_[k].next;
  if (!(p.at == q.at)) {
    return p.at < q.at;
  }
  return p.what != q.what ? p.what < q.what : bodies_[i].id < bodies_[k].id;
}

template <class Real, class Policy>
std::size_t EventLoop<Real, Policy>::earliest() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < count_; ++i) {
    if (precedes(i, best)) {
      best = i;
    }
  }
  return best;
}

template <class Real, class Policy>
Ball<Real> EventLoop<Real, Policy>::ball_now(std::size_t i) const {
  const Body& body = bodies_[i];
  if (body.down) {
    return balls_[i];
  }
  return ball_at(body.motion, body.id, Real(now_ - body.motion.start), c_);
}

template <class Real, class Policy>
Hop EventLoop<Real, Policy>::hop(const Real& closing) const {
  // A ball that left at the separation speed comes back with it, but for rounding.
  return closing <= c_.separation_speed * (Real(1) + Real(1e-6)) ? Hop::yes : Hop::no;
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::account(const Real& before, const Real& after) {
  if (after > before) {
    energy_.added_by_separation += after - before;
  }
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::tell(Watch& watch, const Event<Real>& event, Hop hop_kind) {
  if constexpr (Watch::records) {
    watch.record(event, hop_kind);
  }
  return watch.see(
      {event.type, event.after[0].id, event.after[event.ball_count - 1U].id, event.pocket});
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::transition(std::size_t i, Watch& watch) {
  const Ball<Real> after = after_transition(bodies_[i].motion, bodies_[i].id, c_);
  begin_motion(i, after);
  refresh(Indices{1} << i);
  Event<Real> event;
  event.t = now_.high;
  event.type = EventType::transition;
  event.after[0] = after;
  return tell(watch, event, Hop::no);
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::pocket(std::size_t i, Watch& watch) {
  Body& body = bodies_[i];
  Ball<Real> after;
  after.id = body.id;
  after.state = MotionState::pocketed;
  after.position = position_at(body.motion, body.hit.t);
  after.pocket = body.hit.pocket;
  body.down = true;
  balls_[i] = after;
  begin_motion(i, after);
  refresh(Indices{1} << i);
  Event<Real> event;
  event.t = now_.high;
  event.type = EventType::pocketed;
  event.after[0] = after;
  event.pocket = after.pocket;
  return tell(watch, event, Hop::no);
}

// The model runs unraised; then only the normal speed is raised to the separation speed.
template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::bounce(std::size_t i, Watch& watch) {
  const Body& body = bodies_[i];
  const RailId rail = body.hit.rail;
  const Vec2<Real> inward = Real(-1) * body.hit.into;
  Ball<Real> before = ball_at(body.motion, body.id, body.hit.t, c_);
  if (body.hit.surface == Surface::straight) {
    before = on_rail(boundary_, rail, before);
  }
  const Real closing = -dot(before.velocity, inward);
  Ball<Real> after = after_cushion(before, body.hit.into, materials_, nose_);
  const Real leaving = dot(after.velocity, inward);
  if (leaving < c_.separation_speed) {
    after.velocity = after.velocity + (c_.separation_speed - leaving) * inward;
    account(kinetic_energy(before, c_), kinetic_energy(after, c_));
  }
  after = settled(after, c_.radius);
  begin_motion(i, after);
  refresh(Indices{1} << i);
  Event<Real> event;
  event.t = now_.high;
  event.type = EventType::rail_collision;
  event.after[0] = after;
  event.rail = rail;
  return tell(watch, event, hop(closing));
}

// Whether a third ball may be close enough to i or k to be hit together with them.
template <class Real, class Policy>
bool EventLoop<Real, Policy>::is_crowded(std::size_t i, std::size_t k) const {
  const Real t_i = now_ - bodies_[i].motion.start;
  const Real t_k = now_ - bodies_[k].motion.start;
  const Vec2<Real> at_i = position_at(bodies_[i].motion, t_i);
  const Vec2<Real> at_k = position_at(bodies_[k].motion, t_k);
  const Vec2<Real> v = velocity_at(bodies_[i].motion, t_i) - velocity_at(bodies_[k].motion, t_k);
  const Real reach = c_.diameter + cluster_.widest_gap(length(v), contact_);
  for (std::size_t j = 0; j < count_; ++j) {
    if (j == i || j == k || bodies_[j].down) {
      continue;
    }
    const Vec2<Real> at = position_at(bodies_[j].motion, Real(now_ - bodies_[j].motion.start));
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
  typename ContactCluster<Real>::Balls balls{};
  Indices present = 0;
  for (std::size_t j = 0; j < count_; ++j) {
    if (!bodies_[j].down) {
      balls[j] = ball_now(j);
      present |= Indices{1} << j;
    }
  }
  cluster_.gather(balls, present, i, k, contact_);
  Real before(0), after(0);
  for (const Ball<Real>& ball : balls) {
    before += kinetic_energy(ball, c_);
  }
  cluster_.resolve(balls, materials_.ball_friction, contact_);
  for (std::size_t j = 0; j < count_; ++j) {
    after += kinetic_energy(balls[j], c_);
    if (((cluster_.changed() >> j) & 1U) != 0) {
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
    const ClusterHit<Real>& hit_now = cluster_.hit(n);
    Event<Real> event;
    event.t = now_.high;
    event.type = EventType::ball_collision;
    event.ball_count = 2;
    event.after = {balls[hit_now.first], balls[hit_now.second]};
    if (tell(watch, event, hop(hit_now.impulse)) == Go::stop) {
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
  const Ball<Real> first = ball_now(i);
  const Ball<Real> second = ball_now(k);
  const PairAfter<Real> after = collide<Policy>(first, second, c_, materials_.ball_friction);
  if (after.raised) {
    account(kinetic_energy(first, c_) + kinetic_energy(second, c_),
            kinetic_energy(after.first, c_) + kinetic_energy(after.second, c_));
  }
  begin_motion(i, after.first);
  begin_motion(k, after.second);
  refresh((Indices{1} << i) | (Indices{1} << k));
  Event<Real> event;
  event.t = now_.high;
  event.type = EventType::ball_collision;
  event.ball_count = 2;
  event.after = {after.first, after.second};
  return tell(watch, event, hop(after.closing));
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
  Real sum(0);
  for (std::size_t i = 0; i < count_; ++i) {
    if (!bodies_[i].down) {
      sum += kinetic_energy(ball_now(i), c_);
    }
  }
  return sum;
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::finish(const Instant<Real>& at) {
  now_ = at;
  energy_.end = energy_now();
  for (std::size_t i = 0; i < count_; ++i) {
    balls_[i] = ball_now(i);
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
  refresh((Indices{1} << count_) - 1);
  const Instant<Real> end =
      options.t_max ? Instant<Real>{Real(*options.t_max), Real(0)} : never<Real>();
  Ending ending = Ending::at_rest;
  while (go == Go::on && count_ > 0) {
    const std::size_t i = earliest();
    if (bodies_[i].next.what == Next::nothing) {
      break;
    }
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
  return go == Go::on ? ending : Ending::stopped;
}

template <class Real, class Policy>
template <class Watch>
Go EventLoop<Real, Policy>::strike_cue_ball(const CueShot<Real>& shot, Watch& watch) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (bodies_[i].id != cue_ball || bodies_[i].down) {
      continue;
    }
    Ball<Real> ball = balls_[i];
    ball = settled(strike(ball, shot, materials_), c_.radius);
    begin_motion(i, ball);
    ++events_;
    Event<Real> event;
    event.type = EventType::cue_strike;
    event.after[0] = ball;
    return tell(watch, event, Hop::no);
  }
  return Go::stop;
}

}  // namespace poolhall::physics
