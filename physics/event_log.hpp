// What happened in a shot: each event with the state of every ball that it touched, right after
// it. With the motion laws the log gives every instant of the shot in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "physics/ball.hpp"

namespace poolhall::physics {

enum class EventType : std::uint8_t {
  cue_strike,
  ball_collision,
  rail_collision,
  pocketed,
  transition,
  off_table,  // the ball left the table; the two-dimensional simulator has none, the referee knows
              // it
};

[[nodiscard]] std::string_view name(EventType type);
[[nodiscard]] std::optional<EventType> event_type(std::string_view name);

template <class Real>
struct Event {
  Real t{};  // s since the cue strike
  EventType type = EventType::transition;
  std::uint8_t ball_count = 1;        // 2 for ball_collision, else 1
  std::array<Ball<Real>, 2> after{};  // the balls that took part, right after the event
  std::optional<RailId> rail{};       // rail_collision
  std::optional<PocketId> pocket{};   // pocketed
  std::uint32_t count = 1;            // hops that this entry stands for (physics.md 7)
  std::optional<Real> until{};        // s, time of the last of those hops

  [[nodiscard]] bool involves(BallId id) const {
    return after[0].id == id || (ball_count == 2 && after[1].id == id);
  }
};

template <class Real>
using EventLog = std::vector<Event<Real>>;

}  // namespace poolhall::physics
