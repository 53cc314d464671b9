// What a shot was worth by the rules, from a watch instead of an event log: a hundred times faster
// than rules::judge, for plans. It agrees with the referee but where balls frozen to a rail or
// first contacts within a nanosecond decide.
//
//   ShotWatch watch(frozen_balls(before, table, radius));
//   loop.run(ball_set(before), stroke, {}, watch);
//   Position next = judged(before, call, watch, loop.balls(), table, radius);
#pragma once

#include <array>
#include <optional>

#include "clients/bots/position.hpp"
#include "physics/watch.hpp"
#include "rules/referee.hpp"

namespace poolhall::bots {

// Balls that touch a straight rail: of them a rail does not count as one that they were driven to.
[[nodiscard]] BallMask frozen_balls(const Position& position, const physics::Table& table,
                                    double radius);

struct ShotWatch {
  static constexpr bool records = false;

  explicit ShotWatch(BallMask frozen) : frozen_to_rail(frozen) {}

  [[nodiscard]] physics::Go see(const physics::Sighting& seen);

  BallMask frozen_to_rail;
  std::optional<BallId> first_contact{};
  bool rail_after_contact = false;
  BallMask railed = 0;  // driven to a rail
  BallMask down = 0;
  std::array<PocketId, physics::max_balls> pocket{};  // by number, of those that are down
};

[[nodiscard]] Position judged(const Position& before, const rules::Call& call,
                              const ShotWatch& watch, const physics::BallSet<double>& balls,
                              const physics::Table& table, double radius);

}  // namespace poolhall::bots
