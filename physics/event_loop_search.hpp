// Bodies of EventLoop's members that find the next event; include event_loop.hpp.
#pragma once

namespace poolhall::physics {

template <class Real, class Policy>
EventLoop<Real, Policy>::EventLoop(const Table& table, const Materials& materials)
    : materials_(materials),
      c_(coefficients<Exact>(materials)),
      reach_(static_cast<Real>(c_.diameter)),
      reach_squared_(reach_ * reach_),
      boundary_(boundary<Real>(table, Real(materials.ball_radius))),
      exact_boundary_(boundary<Exact>(table, c_.radius)),
      has_jaws_(std::holds_alternative<Jaws>(table.pockets)),
      nose_(nose_angle<Exact>(table, materials)),
      cluster_(c_),
      extent_(static_cast<Real>(table.width > table.length ? table.width : table.length)),
      // Mathavan's equations are integrated to about 1e-13.
      cushion_roughness_(std::holds_alternative<Mathavan2010Cushion>(materials.cushion) ? 2e5 : 1) {
  if (has_jaws_) {
    jaws_ = JawTable<Real>(table, materials.ball_radius);
    exact_jaws_ = JawTable<Exact>(table, materials.ball_radius);
  }
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::place(const BallSet<Real>& balls) {
  count_ = balls.count;
  balls_.count = count_;
  now_ = last_ = {};
  events_ = 0;
  added_ = Exact(0);
  drift_ = {};
  doubtful_ = false;
  present_ = moving_ = busy_ = meeting_ = touched_ = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    balls_[i] = balls[i];
    bodies_[i].id = balls[i].id;
    bodies_[i].next = {};
    if (balls[i].state != MotionState::pocketed) {
      present_ |= only(i);
      begin_motion(i, converted<Exact>(balls[i]));
    }
  }
}

// From now on ball i moves as `ball`; who it meets is found by `refresh`.
template <class Real, class Policy>
void EventLoop<Real, Policy>::begin_motion(std::size_t i, const Ball<Exact>& ball) {
  moving_ &= ~only(i);
  if (ball.state == MotionState::stationary) {
    begin_rest(i, ball);
    return;
  }
  touched_ |= only(i);
  Body& body = bodies_[i];
  begin_segment(body.exact, ball, {}, c_);
  const Segment<Exact>& s = body.exact;
  body.motion.start = now_;
  body.motion.position = converted<Real>(s.position);
  body.motion.velocity = converted<Real>(s.velocity);
  body.motion.acceleration = converted<Real>(s.acceleration);
  body.motion.duration = static_cast<Real>(s.duration);
  body.motion.state = s.state;
  if (ball.state != MotionState::spinning) {
    moving_ |= only(i);
  }
  find_own_event(i);
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::begin_rest(std::size_t i, const Ball<Exact>& ball) {
  Body& body = bodies_[i];
  if (body.exact.state != MotionState::stationary) {
    body.exact = {};
    body.motion = {};
  }
  body.exact.position = ball.position;
  body.motion.position = converted<Real>(ball.position);
  body.own = {};
  set_box(i, {body.motion.position.x, body.motion.position.x},
          {body.motion.position.y, body.motion.position.y});
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::set_box(std::size_t i, const Span<Real>& across,
                                      const Span<Real>& along) {
  boxes_.left[i] = across.low;
  boxes_.right[i] = across.high;
  boxes_.head[i] = along.low;
  boxes_.foot[i] = along.high;
}

// Transition, rail or pocket, whichever ends the segment that begins now.
template <class Real, class Policy>
void EventLoop<Real, Policy>::find_own_event(std::size_t i) {
  Body& body = bodies_[i];
  const Segment<Real>& s = body.motion;
  BoundaryHit<Real> hit;
  hit.t = s.duration;
  Span<Real> across = span(s.position.x, s.velocity.x, s.acceleration.x, s.duration);
  Span<Real> along = span(s.position.y, s.velocity.y, s.acceleration.y, s.duration);
  if ((moving_ & only(i)) != 0) {
    const Span<Real> all{-forever<Real>(), forever<Real>()};
    const bool near_only = Policy::omits(Omission::far_rails);
    const Span<Real>& x = near_only ? across : all;
    const Span<Real>& y = near_only ? along : all;
    hit = has_jaws_ ? jaws_.first_hit(s, x, y, s.duration, solver_)
                    : first_hit(boundary_, s, x, y, s.duration);
    if (hit.kind != HitKind::none) {
      across = span(s.position.x, s.velocity.x, s.acceleration.x, hit.t);
      along = span(s.position.y, s.velocity.y, s.acceleration.y, hit.t);
    }
  }
  set_box(i, across, along);
  if (hit.kind == HitKind::none) {
    body.hit.t = body.exact.duration;
    body.hit.kind = HitKind::none;
  } else if constexpr (std::is_same_v<Exact, Real>) {
    body.hit = hit;
  } else {
    body.hit = hit.surface == Surface::line ? refined_hit(exact_boundary_, hit, body.exact)
                                            : exact_jaws_.refined_hit(hit, body.exact);
  }
  body.own = {};
  if (hit.t < forever<Real>()) {
    body.own.at = later(now_, body.hit.t);
    body.own.what = hit.kind == HitKind::none
                        ? Next::transition
                        : (hit.kind == HitKind::pocket ? Next::pocket : Next::rail);
  }
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::set_next(std::size_t i, const Candidate& next) {
  bodies_[i].next = next;
  busy_ = next.what == Next::nothing ? busy_ & ~only(i) : busy_ | only(i);
  meeting_ = next.what == Next::contact ? meeting_ | only(i) : meeting_ & ~only(i);
}

// Balls of `changed` have new motions. Whoever expected to meet one of them looks again as well:
// it had not looked beyond that meeting. Then for each pair the first contact is not before the
// earlier of both balls' next events, so that the earliest `next` of all is the next event.
template <class Real, class Policy>
void EventLoop<Real, Policy>::refresh(Indices changed) {
  Indices stale = changed;
  for (Indices left = meeting_ & ~changed; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    if ((changed & only(bodies_[k].next.partner)) != 0) {
      stale |= only(k);
    }
  }
  for (Indices left = stale; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    set_next(k, (present_ & only(k)) != 0 ? bodies_[k].own : Candidate{});
  }
  Indices others = present_;
  for (Indices left = stale & present_; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    others &= ~only(k);
    const bool needs_all = (moving_ & only(k)) != 0 || !Policy::omits(Omission::pairs_at_rest);
    sweep(k, needs_all ? others : others & moving_);
  }
}

// Balls of `among` whose paths' boxes come within `reach` of a box.
template <class Real, class Policy>
typename EventLoop<Real, Policy>::Indices EventLoop<Real, Policy>::near(const Span<Real>& across,
                                                                        const Span<Real>& along,
                                                                        const Real& reach,
                                                                        Indices among) const {
  const Real left = across.low - reach, right = across.high + reach;
  const Real head = along.low - reach, foot = along.high + reach;
  Indices found = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const bool inside = (boxes_.right[k] >= left) & (boxes_.left[k] <= right) &
                        (boxes_.foot[k] >= head) & (boxes_.head[k] <= foot);
    found |= static_cast<Indices>(inside) << k;
  }
  return found & among;
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::sweep(std::size_t i, Indices others) {
  if (others == 0) {
    return;
  }
  Indices left = others;
  if (Policy::omits(Omission::far_pairs)) {
    left =
        near({boxes_.left[i], boxes_.right[i]}, {boxes_.head[i], boxes_.foot[i]}, reach_, others);
  }
  for (; left != 0; left &= left - 1) {
    look_for_contact(i, static_cast<std::size_t>(std::countr_zero(left)));
  }
}

template <class Real, class Policy>
void EventLoop<Real, Policy>::look_for_contact(std::size_t i, std::size_t k) {
  const Body& one = bodies_[i];
  const Body& other = bodies_[k];
  // What happens first to either ball ends its motion: beyond it there is nothing to look for.
  const Instant<Real>& until = one.next.at < other.next.at ? one.next.at : other.next.at;
  const PairMotion<Real> pair = pair_motion(one.motion, other.motion, now_, reach_squared_);
  const std::optional<Real> t = first_contact<Policy>(pair, Real(until - now_), solver_);
  if (!t) {
    return;
  }
  const Instant<Real> at = later(now_, refined(i, k, *t));
  if (at < one.next.at) {
    set_next(i, {at, Next::contact, static_cast<std::uint8_t>(k)});
  }
  if (at < other.next.at) {
    set_next(k, {at, Next::contact, static_cast<std::uint8_t>(i)});
  }
}

// One step of Newton's on the exact motions; not where a graze makes it long.
template <class Real, class Policy>
typename EventLoop<Real, Policy>::Exact EventLoop<Real, Policy>::refined(std::size_t i,
                                                                         std::size_t k,
                                                                         const Real& t) const {
  using std::abs;
  const Exact found(t);
  if constexpr (std::is_same_v<Exact, Real>) {
    return found;
  }
  if (t == Real(0)) {
    return found;
  }
  const Segment<Exact>& one = bodies_[i].exact;
  const Segment<Exact>& other = bodies_[k].exact;
  const Exact t_one = elapsed(i) + found;
  const Exact t_other = elapsed(k) + found;
  const Vec2<Exact> d = position_at(other, t_other) - position_at(one, t_one);
  const Vec2<Exact> v = velocity_at(other, t_other) - velocity_at(one, t_one);
  const Exact slope = dot(d, v);
  if (!(slope < Exact(0))) {
    return found;
  }
  const Exact step = (c_.reach_squared - dot(d, d)) / (slope + slope);
  const Exact at = found + step;
  return abs(step) <= Exact(1e-9) && at > Exact(0) ? at : found;
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

// Of balls that are busy.
template <class Real, class Policy>
std::size_t EventLoop<Real, Policy>::earliest() const {
  Indices left = busy_;
  auto best = static_cast<std::size_t>(std::countr_zero(left));
  for (left &= left - 1; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    if (precedes(k, best)) {
      best = k;
    }
  }
  return best;
}

}  // namespace poolhall::physics
