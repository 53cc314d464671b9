// What a shot's event log says, before any rule: first contact, balls down, balls off, balls
// driven to a rail, whether the cue ball left the kitchen. `events` must fit the state
// (log_check.hpp).
//
//   ShotFacts facts = shot_facts(ready, events, table, materials);
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules {

struct BallEvent {
  BallId ball{};
  std::size_t event = 0;  // index into the event log
};

struct ShotFacts {
  // Balls that the cue ball struck first: more than one when they are within 1e-9 s.
  std::vector<BallEvent> first_contacts;
  std::vector<PocketedBall> pocketed;     // cue ball too, in the order of the log
  std::vector<BallEvent> driven_off;      // cue ball too, in the order of the log
  std::vector<BallEvent> driven_to_rail;  // each time a ball was driven to a rail
  // m, largest y of the cue ball's centre up to the first contact, or in all without one.
  double cue_ball_farthest_y = 0;

  [[nodiscard]] bool is_pocketed(BallId ball) const;
  [[nodiscard]] bool is_off(BallId ball) const;
  [[nodiscard]] bool is_pocketed_in(BallId ball, PocketId pocket) const;
  // On the table no more.
  [[nodiscard]] bool is_gone(BallId ball) const { return is_pocketed(ball) || is_off(ball); }
  [[nodiscard]] bool object_ball_pocketed() const { return first_object_ball_down().has_value(); }
  // The event in which the first object ball was pocketed.
  [[nodiscard]] std::optional<std::size_t> first_object_ball_down() const;
  // The event in which `ball` was pocketed or left the table.
  [[nodiscard]] std::optional<std::size_t> gone_event(BallId ball) const;
  [[nodiscard]] std::size_t object_balls_driven_to_rail() const;  // each counts once
};

[[nodiscard]] ShotFacts shot_facts(const GameState& ready, const physics::EventLog<double>& events,
                                   const physics::Table& table,
                                   const physics::Materials& materials);

// The state with every ball where the log leaves it.
[[nodiscard]] GameState settled(const GameState& ready, const physics::EventLog<double>& events);

}  // namespace poolhall::rules
