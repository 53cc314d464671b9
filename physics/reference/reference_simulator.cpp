#include "physics/reference/reference_simulator.hpp"

#include <algorithm>

#include "physics/reference/polynomial_roots.hpp"
#include "physics/reference/reference_contacts.hpp"
#include "physics/reference/reference_motion.hpp"
#include "physics/reference/reference_table.hpp"

namespace poolhall::physics::reference {

namespace {

// The classes of physics.md 7, in the order in which they come at one instant.
enum class Kind { transition, pocketed, rail, ball };

struct Prediction {
  Number t;  // s, absolute
  Kind kind = Kind::transition;
  Vec2<Number> into{};  // rail: unit normal from the table into the cushion
  RailId rail{};
  PocketId pocket{};
};

// Two instants closer than this are one: rounding of the reference, far below any real gap.
const Number& same_instant() {
  static const Number epsilon("1e-70");
  return epsilon;
}

bool earlier(const Prediction& p, const Prediction& q) {
  if (abs(p.t - q.t) > same_instant()) {
    return p.t < q.t;
  }
  return p.kind < q.kind;
}

void keep_earlier(std::optional<Prediction>& best, const Prediction& candidate) {
  if (!best || earlier(candidate, *best)) {
    best = candidate;
  }
}

// Position of a ball as polynomials of the time since its segment began.
struct Path {
  Polynomial x, y;
};

Polynomial sum(Polynomial p, const Polynomial& q, const Number& factor) {
  p.resize(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < q.size(); ++i) {
    p[i] += factor * q[i];
  }
  return p;
}

Polynomial product(const Polynomial& p, const Polynomial& q) {
  Polynomial out(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t k = 0; k < q.size(); ++k) {
      out[i + k] += p[i] * q[k];
    }
  }
  return out;
}

// |(x, y)|^2 - reach^2.
Polynomial gap_to_circle(const Polynomial& x, const Polynomial& y, const Number& reach) {
  return sum(sum(product(x, x), product(y, y), 1), {Number(reach * reach)}, -1);
}

class Run {
 public:
  Run(const ReferenceScene& scene, const ReferenceOptions& options)
      : scene_(scene),
        options_(options),
        constants_(motion_constants(scene.materials)),
        table_(reference_table(scene.table, constants_.radius)) {
    for (const Ball<double>& given : scene.balls) {
      Ball<Number> ball{
          given.id,
          given.state,
          {given.position.x, given.position.y},
          {given.velocity.x, given.velocity.y},
          {given.angular_velocity.x, given.angular_velocity.y, given.angular_velocity.z},
          given.pocket};
      if (ball.id == cue_ball) {
        ball.position.x += Number(options.cue_ball_shift);
      }
      balls_.push_back(ball.state == MotionState::pocketed ? ball : classified(ball, constants_));
    }
    since_.resize(balls_.size());
    own_.resize(balls_.size());
    pairs_.resize(balls_.size() * balls_.size());
  }

  ReferenceSimulation simulate() {
    if (scene_.shot) {
      strike();
    }
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      predict(i);
    }
    while (step()) {
      if (out_.events.size() >= options_.event_limit) {
        out_.complete = false;
        break;
      }
    }
    finish();
    return std::move(out_);
  }

 private:
  void strike() {
    for (Ball<Number>& ball : balls_) {
      if (ball.id == cue_ball) {
        ball = struck(ball, *scene_.shot, scene_.materials, constants_);
        log(0, EventType::cue_strike, ball);
      }
    }
  }

  // Carries out the earliest event; false when there is none.
  bool step() {
    std::optional<Prediction> best;
    std::pair<std::size_t, std::size_t> who;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (own_[i] && (!best || earlier(*own_[i], *best))) {
        best = own_[i];
        who = {i, i};
      }
      for (std::size_t k = i + 1; k < balls_.size(); ++k) {
        const auto& pair = pairs_[i * balls_.size() + k];
        if (pair && (!best || earlier(*pair, *best))) {
          best = pair;
          who = {i, k};
        }
      }
    }
    if (!best || (options_.t_max && best->t > *options_.t_max)) {
      return false;
    }
    now_ = best->t;
    if (best->kind == Kind::ball) {
      collide(who.first, who.second);
    } else {
      carry_out(who.first, *best);
    }
    return true;
  }

  void carry_out(std::size_t i, const Prediction& event) {
    Ball<Number>& ball = balls_[i];
    switch (event.kind) {
      case Kind::transition:
        ball = after_transition(ball, constants_);
        log(now_, EventType::transition, ball);
        break;
      case Kind::pocketed:
        ball = advanced(ball, now_ - since_[i], constants_);
        ball.velocity = {};
        ball.angular_velocity = {};
        ball.state = MotionState::pocketed;
        ball.pocket = event.pocket;
        log(now_, EventType::pocketed, ball);
        out_.events.back().pocket = event.pocket;
        break;
      case Kind::rail:
        ball = after_cushion_contact(advanced(ball, now_ - since_[i], constants_), event.into,
                                     scene_.materials, scene_.table.nose_height, constants_);
        log(now_, EventType::rail_collision, ball);
        out_.events.back().rail = event.rail;
        break;
      case Kind::ball:
        break;
    }
    since_[i] = now_;
    predict(i);
  }

  void collide(std::size_t i, std::size_t k) {
    const auto [first, second] = after_ball_contact(
        advanced(balls_[i], now_ - since_[i], constants_),
        advanced(balls_[k], now_ - since_[k], constants_), scene_.materials, constants_);
    balls_[i] = first;
    balls_[k] = second;
    since_[i] = since_[k] = now_;
    log(now_, EventType::ball_collision, balls_[std::min(i, k)]);
    out_.events.back().ball_count = 2;
    out_.events.back().after[1] = balls_[std::max(i, k)];
    predict(i);
    predict(k);
  }

  void log(const Number& t, EventType type, const Ball<Number>& ball) {
    Event<Number> event;
    event.t = t;
    event.type = type;
    event.after[0] = ball;
    out_.events.push_back(event);
  }

  [[nodiscard]] bool moving(std::size_t i) const {
    return balls_[i].state == MotionState::sliding || balls_[i].state == MotionState::rolling;
  }

  // Time from `now_` to the end of the ball's segment.
  [[nodiscard]] std::optional<Number> left(std::size_t i) const {
    std::optional<Number> duration = time_to_transition(balls_[i], constants_);
    if (duration) {
      *duration = std::max<Number>(0, *duration - (now_ - since_[i]));
    }
    return duration;
  }

  // Path of a ball from `now_` on.
  [[nodiscard]] Path path(std::size_t i) const {
    const Ball<Number> ball = advanced(balls_[i], now_ - since_[i], constants_);
    // The acceleration is the segment's own: recomputing it from the later state would only
    // round it again.
    const Vec2<Number> a = acceleration(balls_[i], constants_);
    return {{ball.position.x, ball.velocity.x, a.x / 2},
            {ball.position.y, ball.velocity.y, a.y / 2}};
  }

  // All that one ball meets by itself, and its contacts with all others.
  void predict(std::size_t i) {
    own_[i].reset();
    if (balls_[i].state != MotionState::pocketed) {
      const std::optional<Number> duration = left(i);
      if (duration) {
        keep_earlier(own_[i], {now_ + *duration, Kind::transition, {}, {}, {}});
      }
      if (moving(i)) {
        predict_table(i, path(i), duration.value_or(longest()));
      }
    }
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      if (k != i) {
        predict_pair(std::min(i, k), std::max(i, k));
      }
    }
  }

  // Without friction a segment never ends: what takes longer than this does not happen.
  [[nodiscard]] Number longest() const {
    return options_.t_max ? Number(*options_.t_max) : Number(1e6);
  }

  void predict_pair(std::size_t i, std::size_t k) {
    auto& slot = pairs_[i * balls_.size() + k];
    slot.reset();
    const auto down = MotionState::pocketed;
    if ((!moving(i) && !moving(k)) || balls_[i].state == down || balls_[k].state == down) {
      return;
    }
    Number end = longest();
    for (const std::size_t ball : {i, k}) {
      const std::optional<Number> duration = moving(ball) ? left(ball) : std::nullopt;
      if (duration) {
        end = std::min(end, *duration);
      }
    }
    const Path p = path(i);
    const Path q = path(k);
    const Polynomial gap =
        gap_to_circle(sum(p.x, q.x, -1), sum(p.y, q.y, -1), 2 * constants_.radius);
    const std::vector<Fall> contacts = falls(gap, end);
    if (!contacts.empty()) {
      slot = Prediction{now_ + contacts.front().t, Kind::ball, {}, {}, {}};
    }
  }

  void predict_table(std::size_t i, const Path& p, const Number& end) {
    for (const Nose& nose : table_.noses) {
      predict_nose(i, p, end, nose);
    }
    for (const Arc& arc : table_.arcs) {
      const Polynomial dx = sum(p.x, {arc.centre.x}, -1);
      const Polynomial dy = sum(p.y, {arc.centre.y}, -1);
      const Number reach = arc.radius + constants_.radius;
      for (const auto& [t, from, until] : falls(gap_to_circle(dx, dy, reach), end)) {
        const Vec2<Number> into{-value(dx, t) / reach, -value(dy, t) / reach};
        keep_earlier(own_[i], {now_ + t, Kind::rail, into, arc.rail, {}});
      }
    }
    for (const MouthLine& mouth : table_.mouths) {
      Polynomial gap = sum(sum({-mouth.offset}, p.x, mouth.inward.x), p.y, mouth.inward.y);
      for (const auto& [t, from, until] : falls(gap, end)) {
        keep_earlier(own_[i], {now_ + t, Kind::pocketed, {}, {}, mouth.pocket});
      }
    }
    for (const Hole& hole : table_.holes) {
      const Polynomial gap =
          gap_to_circle(sum(p.x, {hole.centre.x}, -1), sum(p.y, {hole.centre.y}, -1), hole.radius);
      for (const auto& [t, from, until] : falls(gap, end)) {
        keep_earlier(own_[i], {now_ + t, Kind::pocketed, {}, {}, hole.pocket});
      }
    }
  }

  void predict_nose(std::size_t i, const Path& p, const Number& end, const Nose& nose) {
    const Polynomial gap =
        sum(sum({-dot(nose.inward, nose.from) - constants_.radius}, p.x, nose.inward.x), p.y,
            nose.inward.y);
    const Vec2<Number> along = nose.to - nose.from;
    for (const auto& [t, from, until] : falls(gap, end)) {
      const Vec2<Number> at{value(p.x, t), value(p.y, t)};
      const Number foot = dot(at - nose.from, along);
      if (foot < 0 || foot > dot(along, along)) {
        continue;
      }
      const Prediction rail{now_ + t, Kind::rail, {-nose.inward.x, -nose.inward.y}, nose.rail, {}};
      keep_earlier(own_[i], in_side_mouth(nose, at) ? pocketed_at_side(rail) : rail);
    }
    if (!table_.side_mouths.empty() && nose.inward.y == 0 && gap[0] == 0 && gap[1] == 0 &&
        gap[2] == 0) {
      predict_slide_into_side(i, p, end, nose);
    }
  }

  [[nodiscard]] bool in_side_mouth(const Nose& nose, const Vec2<Number>& at) const {
    return nose.inward.y == 0 && !table_.side_mouths.empty() &&
           at.y >= table_.side_mouths.front().low && at.y <= table_.side_mouths.front().high;
  }

  [[nodiscard]] static Prediction pocketed_at_side(Prediction rail) {
    const bool left = rail.into.x < 0;
    rail.kind = Kind::pocketed;
    rail.pocket = left ? PocketId::side_left : PocketId::side_right;
    return rail;
  }

  // A ball that runs along the nose line in contact is pocketed where the mouth begins.
  void predict_slide_into_side(std::size_t i, const Path& p, const Number& end, const Nose& nose) {
    const SideMouth& mouth = table_.side_mouths.front();
    const Vec2<Number> into{-nose.inward.x, 0};
    const Prediction at_side = pocketed_at_side({now_, Kind::rail, into, nose.rail, {}});
    for (const Polynomial& gap : {sum({mouth.low}, p.y, -1), sum(p.y, {mouth.high}, -1)}) {
      for (const auto& [t, from, until] : falls(gap, end)) {
        Prediction entry = at_side;
        entry.t = now_ + t;
        const Number y = value(p.y, t);
        if (y >= mouth.low - same_instant() && y <= mouth.high + same_instant()) {
          keep_earlier(own_[i], entry);
        }
      }
    }
  }

  void finish() {
    out_.duration = out_.events.empty() ? Number(0) : out_.events.back().t;
    const Number end = options_.t_max && out_.complete ? Number(*options_.t_max) : out_.duration;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      out_.balls.push_back(balls_[i].state == MotionState::pocketed
                               ? balls_[i]
                               : advanced(balls_[i], end - since_[i], constants_));
    }
  }

  const ReferenceScene& scene_;
  ReferenceOptions options_;
  MotionConstants constants_;
  ReferenceTable table_;
  std::vector<Ball<Number>> balls_;
  std::vector<Number> since_;  // when each ball's segment began
  std::vector<std::optional<Prediction>> own_;
  std::vector<std::optional<Prediction>> pairs_;  // row i, column k > i
  Number now_ = 0;
  ReferenceSimulation out_;
};

}  // namespace

ReferenceSimulation reference_simulate(const ReferenceScene& scene,
                                       const ReferenceOptions& options) {
  return Run(scene, options).simulate();
}

}  // namespace poolhall::physics::reference
