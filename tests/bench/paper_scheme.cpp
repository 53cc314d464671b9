#include "tests/bench/paper_scheme.hpp"

#include "physics/ball_collision.hpp"
#include "physics/quartic_closed_form.hpp"
#include "physics/roots.hpp"
#include "tests/bench/counted.hpp"

namespace poolhall::bench {

namespace {

using physics::Ball;
using physics::MotionState;
using physics::Segment;

constexpr std::size_t most_events = 1'000'000;

bool moves(MotionState state) {
  return state == MotionState::sliding || state == MotionState::rolling;
}

}  // namespace

template <class Real>
PaperScheme<Real>::PaperScheme(const physics::Table& table, const physics::Materials& materials)
    : materials_(materials),
      c_(physics::coefficients<Real>(materials)),
      geometry_(physics::table_geometry<Real>(table, materials.ball_radius)),
      nose_(physics::nose_angle<Real>(table, materials)) {}

template <class Real>
std::size_t PaperScheme<Real>::run(const physics::BallSet<Real>& balls,
                                   const std::optional<physics::CueShot<Real>>& shot,
                                   const Real& longest) {
  balls_ = balls;
  if (shot) {
    strike(*shot);
  }
  Real left = longest;
  std::size_t events = shot ? 1 : 0;
  for (; events < most_events; ++events) {
    const Next next = next_event();
    if (next.what == What::nothing) {
      break;
    }
    if (left < next.t) {
      advance_all({left, What::nothing, 0, 0});
      break;
    }
    left = left - next.t;
    advance_all(next);
    carry_out(next);
  }
  return events;
}

template <class Real>
void PaperScheme<Real>::strike(const physics::CueShot<Real>& shot) {
  for (Ball<Real>& ball : balls_) {
    if (ball.id == physics::cue_ball) {
      ball = physics::settled(physics::strike(ball, shot, materials_), c_.radius);
    }
  }
}

template <class Real>
typename PaperScheme<Real>::Next PaperScheme<Real>::next_event() {
  for (std::size_t i = 0; i < balls_.count; ++i) {
    if (balls_[i].state != MotionState::pocketed) {
      segments_[i] = physics::segment(balls_[i], physics::Instant<Real>{}, c_);
    }
  }
  Next best;
  best.t = physics::forever<Real>();
  for (std::size_t i = 0; i < balls_.count; ++i) {
    next_of_ball(i, best);
    for (std::size_t k = i + 1; k < balls_.count; ++k) {
      next_of_pair(i, k, best);
    }
  }
  return best;
}

template <class Real>
void PaperScheme<Real>::next_of_ball(std::size_t i, Next& best) const {
  const MotionState state = balls_[i].state;
  if (state == MotionState::stationary || state == MotionState::pocketed) {
    return;
  }
  const Segment<Real>& s = segments_[i];
  if (s.duration < best.t) {
    best = {s.duration, What::transition, i, 0};
  }
  if (!moves(state)) {
    return;
  }
  for (std::size_t m = 0; m < geometry_.mouths.size; ++m) {
    const auto& mouth = geometry_.mouths[m];
    const Real t = physics::first_closing(
        mouth.offset - dot(s.position, mouth.outward), -dot(s.velocity, mouth.outward),
        -dot(s.acceleration, mouth.outward), physics::forever<Real>());
    const auto along = mouth.to - mouth.from;
    const Real foot = dot(physics::position_at(s, t) - mouth.from, along);
    if (t < best.t && foot >= Real(0) && foot <= dot(along, along)) {
      best = {t, What::pocket, i, m};
    }
  }
  for (std::size_t r = 0; r < geometry_.rails.size; ++r) {
    const auto& rail = geometry_.rails[r];
    const bool across = rail.axis == physics::Axis::x;
    const Real at = across ? s.position.x : s.position.y;
    const Real t =
        physics::first_closing(rail.side * (rail.centre_line - at), -dot(s.velocity, rail.into),
                               -dot(s.acceleration, rail.into), physics::forever<Real>());
    const auto place = physics::position_at(s, t);
    const Real foot = across ? place.y : place.x;
    if (t < best.t && foot >= rail.begin && foot <= rail.end) {
      best = {t, What::rail, i, r};
    }
  }
}

template <class Real>
void PaperScheme<Real>::next_of_pair(std::size_t i, std::size_t k, Next& best) const {
  const MotionState one = balls_[i].state;
  const MotionState two = balls_[k].state;
  if (one == MotionState::pocketed || two == MotionState::pocketed ||
      (!moves(one) && !moves(two))) {
    return;
  }
  const auto pair = physics::pair_motion(segments_[i], segments_[k], {}, c_);
  const auto t = physics::closed_form_contact(pair, best.t, physics::Polish::no);
  if (t && *t < best.t) {
    best = {*t, What::contact, i, k};
  }
}

template <class Real>
void PaperScheme<Real>::advance_all(const Next& next) {
  for (std::size_t i = 0; i < balls_.count; ++i) {
    if (balls_[i].state == MotionState::pocketed || balls_[i].state == MotionState::stationary) {
      continue;
    }
    balls_[i] = next.what == What::transition && next.ball == i
                    ? physics::after_transition(segments_[i], balls_[i].id, c_)
                    : physics::ball_at(segments_[i], balls_[i].id, next.t, c_);
  }
}

template <class Real>
void PaperScheme<Real>::carry_out(const Next& next) {
  Ball<Real>& ball = balls_[next.ball];
  switch (next.what) {
    case What::rail: {
      const auto& rail = geometry_.rails[next.other];
      ball = physics::after_cushion(ball, rail.into, materials_, nose_);
      const Real leaving = -dot(ball.velocity, rail.into);
      if (leaving < c_.separation_speed) {
        ball.velocity = ball.velocity - (c_.separation_speed - leaving) * rail.into;
      }
      ball = physics::settled(ball, c_.radius);
      break;
    }
    case What::pocket:
      ball.state = MotionState::pocketed;
      ball.pocket = geometry_.mouths[next.other].pocket;
      break;
    case What::contact: {
      const auto after = physics::collide(ball, balls_[next.other], c_, materials_.ball_friction);
      ball = after.first;
      balls_[next.other] = after.second;
      break;
    }
    case What::transition:
    case What::nothing:
      break;
  }
}

template class PaperScheme<double>;
template class PaperScheme<Counted>;

}  // namespace poolhall::bench
