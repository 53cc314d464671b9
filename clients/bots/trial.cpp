#include "clients/bots/trial.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clients/bots/quick_referee.hpp"
#include "physics/event_loop.hpp"

namespace poolhall::bots {
namespace {

// How the object ball leaves after its first contact with the cue ball.
struct CourseWatch {
  static constexpr bool records = true;

  [[nodiscard]] physics::Go see(const physics::Sighting& seen) {
    return seen.type == physics::EventType::transition ||
                   seen.type == physics::EventType::cue_strike
               ? physics::Go::on
               : physics::Go::stop;
  }

  void record(const physics::Event<double>& event, physics::Hop /*hop*/) {
    if (event.type == physics::EventType::ball_collision) {
      velocity = event.after[event.after[0].id == physics::cue_ball ? 1 : 0].velocity;
    }
  }

  std::optional<Point> velocity{};
};

}  // namespace

struct Trial::Loop {
  explicit Loop(const Hall& hall) : loop(hall.table, hall.materials) {}
  physics::EventLoop<double> loop;
};

Trial::Trial(const Hall& hall) : hall_(hall), loop_(std::make_unique<Loop>(hall)) {}
Trial::~Trial() = default;

Position Trial::play(const Position& before, const physics::CueShot<double>& stroke,
                     const rules::Call& call) {
  // What goes on for longer is no plan: a bound on the time of a trial, not on the shot.
  constexpr std::uint32_t most_events = 20'000;
  ShotWatch watch(frozen_balls(before, hall_.table, hall_.radius()));
  loop_->loop.run(ball_set(before), stroke, {.event_limit = most_events}, watch);
  events_ += loop_->loop.events();
  down_.clear();
  for (unsigned left = watch.down; left != 0; left &= left - 1) {
    const auto n = static_cast<std::size_t>(std::countr_zero(left));
    down_.push_back({BallId(static_cast<std::uint8_t>(n)), watch.pocket[n]});
  }
  return judged(before, call, watch, loop_->loop.balls(), hall_.table, hall_.radius());
}

Position Trial::exact(const Position& before, const protocol::ShotParams& stroke,
                      const rules::Call& call) {
  return play(before, physics::cue_shot(stroke), call);
}

Position Trial::noisy(const Position& before, const protocol::ShotParams& stroke,
                      const rules::Call& call, const physics::NoiseLevel& noise,
                      const physics::ShotDeviates& deviates) {
  const auto wanted = physics::with_noise(physics::cue_shot(stroke), noise, deviates);
  const auto balls = ball_set(before);
  return play(before,
              physics::nearest_possible_shot(wanted, balls, hall_.table, hall_.materials).shot,
              call);
}

std::optional<double> Trial::miss(const PotLine& line, const protocol::ShotParams& stroke) {
  physics::BallSet<double> balls;
  balls.count = 2;
  balls[0].position = line.cue;
  balls[1].id = line.ball;
  balls[1].position = line.object;
  CourseWatch watch;
  loop_->loop.run(balls, physics::cue_shot(stroke), {}, watch);
  events_ += loop_->loop.events();
  if (!watch.velocity) {
    return std::nullopt;
  }
  const Point v = *watch.velocity;
  return std::atan2(line.course.x * v.y - line.course.y * v.x, dot(line.course, v));
}

std::optional<Position> with_cue_ball(const Position& position, Point place, const Hall& hall) {
  // Clear of rails and balls by a hair, so that the referee and the simulator agree.
  const double radius = hall.radius() + 1e-6;
  const bool kitchen = position.kind == rules::TurnKind::break_shot ||
                       position.kind == rules::TurnKind::ball_in_hand_behind_head_string;
  const double y_end = kitchen ? hall.table.head_string - 1e-6 : hall.table.length - radius;
  if (place.x < radius || place.x > hall.table.width - radius || place.y < radius ||
      place.y > y_end) {
    return std::nullopt;
  }
  for (unsigned left = position.on_table & ~1U; left != 0; left &= left - 1) {
    const Point off = position.at[static_cast<std::size_t>(std::countr_zero(left))] - place;
    if (dot(off, off) < 4 * radius * radius) {
      return std::nullopt;
    }
  }
  for (const PocketTarget& pocket : hall.pockets) {
    if (dot(place - pocket.centre, pocket.outward) > -hall.radius() / 4 &&
        dot(place - pocket.centre, place - pocket.centre) < 16 * radius * radius) {
      return std::nullopt;
    }
  }
  Position placed = position;
  placed.on_table |= 1;
  placed.at[0] = place;
  return placed;
}

std::vector<physics::ShotDeviates> stratified_deviates(std::size_t count, Dice& dice) {
  constexpr std::size_t block = 16;
  std::vector<physics::ShotDeviates> all;
  std::array<std::array<std::size_t, block>, 5> strata{};
  while (all.size() < count) {
    for (auto& order : strata) {
      std::iota(order.begin(), order.end(), std::size_t{0});
      for (std::size_t i = block; i > 1; --i) {
        std::swap(order[i - 1], order[dice.below(i)]);
      }
    }
    for (std::size_t i = 0; i < block; ++i) {
      physics::ShotDeviates deviates{};
      for (std::size_t k = 0; k < deviates.size(); ++k) {
        const double p = (static_cast<double>(strata[k][i]) + dice.uniform(0, 1)) / block;
        deviates[k] = physics::normal_quantile(std::clamp(p, 1e-12, 1 - 1e-12));
      }
      all.push_back(deviates);
    }
  }
  all.resize(count);
  return all;
}

}  // namespace poolhall::bots
