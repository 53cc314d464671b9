#include "rules/log_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "rules/ball_path.hpp"

namespace poolhall::rules {
namespace {

using physics::Ball;
using physics::Event;
using physics::EventLog;
using physics::EventType;
using physics::MotionState;
using physics::Vec2;

// m; a ball that has not moved is met where it lies. Generous against a log with few digits.
constexpr double at_rest_tolerance = 1e-6;
// m; a ball that moves is where the motion laws take it. Generous against contact models that
// take time.
constexpr double moving_tolerance = 5e-3;
// s; by which simultaneous events may stand in another order.
constexpr double time_tolerance = 1e-9;

tl::unexpected<Refusal> misfit(std::size_t event, const std::string& field, std::string reason) {
  return tl::unexpected(Refusal{RefusalCode::bad_event_log,
                                "/events/" + std::to_string(event) + field, std::move(reason)});
}

std::string in_mm(double metres) {
  return std::to_string(metres * 1000);
}

std::string ball_name(BallId id) {
  return "ball " + std::to_string(physics::number(id));
}

bool is_finite(const Ball<double>& ball) {
  return std::isfinite(ball.position.x) && std::isfinite(ball.position.y) &&
         std::isfinite(ball.velocity.x) && std::isfinite(ball.velocity.y) &&
         std::isfinite(ball.angular_velocity.x) && std::isfinite(ball.angular_velocity.y) &&
         std::isfinite(ball.angular_velocity.z);
}

// Form of one event, apart from the others.
Expected<void> check_form(const Event<double>& event, std::size_t i) {
  if (event.type > EventType::off_table) {
    return misfit(i, "/type", "not a type of event");
  }
  if (!(std::isfinite(event.t) && event.t >= 0)) {
    return misfit(i, "/t", "expected a time from the cue strike on, finite and not negative");
  }
  const std::size_t balls = event.type == EventType::ball_collision ? 2 : 1;
  if (event.ball_count != balls) {
    return misfit(i, "/balls",
                  std::to_string(event.ball_count) + " balls, but " +
                      std::string(physics::name(event.type)) + " has " + std::to_string(balls));
  }
  if (balls == 2 && event.after[0].id == event.after[1].id) {
    return misfit(i, "/balls", ball_name(event.after[0].id) + " cannot collide with itself");
  }
  if (event.rail.has_value() != (event.type == EventType::rail_collision) ||
      (event.rail && static_cast<std::size_t>(*event.rail) >= physics::rail_count)) {
    return misfit(i, "/rail", "a rail is for a rail_collision, and that needs one of the table's");
  }
  if (event.pocket.has_value() != (event.type == EventType::pocketed) ||
      (event.pocket && static_cast<std::size_t>(*event.pocket) >= physics::pocket_count)) {
    return misfit(i, "/pocket", "a pocket is for a pocketed, and that needs one of the table's");
  }
  if (event.until && !(std::isfinite(*event.until) && *event.until >= event.t)) {
    return misfit(i, "/until", "expected a finite time not before t");
  }
  return {};
}

// The balls as the log has brought them so far.
class Follower {
 public:
  Follower(const GameState& ready, const physics::Materials& materials) : materials_(materials) {
    for (const BallPlace& place : ready.balls) {
      Track& track = tracks_[physics::number(place.id)];
      track.in_play = place.where == Whereabouts::on_table;
      track.last.position = place.position;
    }
  }

  Expected<void> take(const Event<double>& event, std::size_t i) {
    for (std::size_t k = 0; k < event.ball_count; ++k) {
      if (auto fits = check_ball(event, i, k); !fits) {
        return fits;
      }
    }
    for (std::size_t k = 0; k < event.ball_count; ++k) {
      Track& track = tracks_[physics::number(event.after[k].id)];
      if (has_place(event.after[k])) {
        track.last = event.after[k];
      }
      track.since = event.until.value_or(event.t);
      track.touched = true;
      track.in_play = event.type != EventType::pocketed && event.type != EventType::off_table;
    }
    return {};
  }

  // A ball that the log leaves in motion.
  [[nodiscard]] std::optional<BallId> moving() const {
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      if (tracks_[n].in_play && tracks_[n].last.state != MotionState::stationary) {
        return BallId(static_cast<std::uint8_t>(n));
      }
    }
    return std::nullopt;
  }

 private:
  struct Track {
    bool in_play = false;
    bool touched = false;  // by an event before this one
    Ball<double> last{};
    double since = 0;  // s
  };

  Expected<void> check_ball(const Event<double>& event, std::size_t i, std::size_t k) const {
    const Ball<double>& after = event.after[k];
    const unsigned n = physics::number(after.id);
    if (n >= tracks_.size() || !tracks_[n].in_play) {
      return misfit(i, "/balls/" + std::to_string(k), ball_name(after.id) + " is not on the table");
    }
    const std::string field = "/after/" + std::to_string(k);
    if (!is_finite(after) || after.state > MotionState::pocketed) {
      return misfit(i, field, "the state of " + ball_name(after.id) + " is not a ball's");
    }
    const bool down = event.type == EventType::pocketed;
    if (has_place(after) && (after.state == MotionState::pocketed) != down &&
        event.type != EventType::off_table) {
      return misfit(i, field + "/state",
                    down ? "a ball that is pocketed has the state pocketed"
                         : "only a pocketed event pockets a ball");
    }
    return has_place(after) && event.type != EventType::off_table ? check_place(event, i, k)
                                                                  : Expected<void>{};
  }

  // Whether the ball can be where the event says.
  Expected<void> check_place(const Event<double>& event, std::size_t i, std::size_t k) const {
    const Ball<double>& after = event.after[k];
    const Track& track = tracks_[physics::number(after.id)];
    const std::string field = "/after/" + std::to_string(k);
    const bool struck =
        event.type == EventType::cue_strike || event.type == EventType::ball_collision;
    if (!track.touched && struck &&
        !(length(after.position - track.last.position) <= at_rest_tolerance)) {
      return misfit(i, field,
                    ball_name(after.id) + " is " +
                        in_mm(length(after.position - track.last.position)) +
                        " mm from where the state has it");
    }
    const MotionState before = track.last.state;
    if (before != MotionState::rolling && before != MotionState::sliding) {
      return {};
    }
    const double time = std::max(0.0, event.t - track.since);
    const double off =
        length(position_at(piece_from(track.last, materials_, time), time) - after.position);
    if (!(off <= moving_tolerance + run_during_hops(event, track))) {
      return misfit(
          i, field,
          ball_name(after.id) + " is " + in_mm(off) + " mm from where its motion takes it");
    }
    return {};
  }

  // How far the ball may have come during hops that are one entry: `after` is its state at their
  // end, and what else is logged meanwhile stands behind that entry.
  [[nodiscard]] double run_during_hops(const Event<double>& event, const Track& track) const {
    const Ball<double>& after = event.after[event.after[0].id == track.last.id ? 0 : 1];
    const double end = std::max(event.until.value_or(event.t), track.since);
    const double time = std::max(0.0, end - event.t);
    const double speeds = std::sqrt(dot(track.last.velocity, track.last.velocity)) +
                          std::sqrt(dot(after.velocity, after.velocity));
    return time * (speeds + 2 * materials_.mu_slide * materials_.gravity * time);
  }

  const physics::Materials& materials_;
  std::array<Track, physics::max_balls> tracks_{};
};

Expected<void> check_order(const EventLog<double>& events, std::size_t i) {
  const bool strike = events[i].type == EventType::cue_strike;
  if (strike != (i == 0)) {
    return misfit(i, "/type",
                  i == 0 ? "a shot begins with the cue_strike"
                         : "a shot has one cue_strike, its first event");
  }
  if (strike && (events[i].after[0].id != physics::cue_ball || events[i].t != 0)) {
    return misfit(i, "", "the cue strikes the cue ball at t = 0");
  }
  if (i > 0 && events[i].t < events[i - 1].t - time_tolerance) {
    return misfit(i, "/t", "events are in the order of their times");
  }
  return {};
}

}  // namespace

Expected<void> check_log(const GameState& ready, const EventLog<double>& events,
                         const physics::Materials& materials) {
  if (events.empty()) {
    return tl::unexpected(Refusal{RefusalCode::bad_event_log, "/events",
                                  "no events, but a shot begins with the cue_strike"});
  }
  Follower follower(ready, materials);
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (auto form = check_form(events[i], i); !form) {
      return form;
    }
    if (auto order = check_order(events, i); !order) {
      return order;
    }
    if (auto fits = follower.take(events[i], i); !fits) {
      return fits;
    }
  }
  if (const std::optional<BallId> ball = follower.moving()) {
    return tl::unexpected(Refusal{RefusalCode::bad_event_log, "/events",
                                  ball_name(*ball) + " still moves where the log ends"});
  }
  return {};
}

}  // namespace poolhall::rules
