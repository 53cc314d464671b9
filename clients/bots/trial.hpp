// Playing shots out for a plan: the server's physics, the quick referee, no logs. A workspace for
// one thread.
//
//   Trial trial(venue);
//   Position next = trial.exact(before, shot);
//   Position other = trial.noisy(before, shot, noise, noise.deviates[7]);
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "clients/bots/dice.hpp"
#include "clients/bots/position.hpp"
#include "clients/cpp/player.hpp"
#include "physics/materials.hpp"
#include "physics/noise.hpp"
#include "physics/table.hpp"

namespace poolhall::bots {

// Where a game is played, as far as plans need it.
struct Hall {
  physics::Table table;
  physics::Materials materials;
  std::vector<PocketTarget> pockets;

  Hall(const physics::Table& of_table, const physics::Materials& of_materials)
      : table(of_table),
        materials(of_materials),
        pockets(pocket_targets(of_table, of_materials.ball_radius)) {}
  [[nodiscard]] double radius() const { return materials.ball_radius; }
};

// The position with the cue ball placed; nothing where it may not lie. What the turn allows in the
// kitchen only is refused elsewhere.
[[nodiscard]] std::optional<Position> with_cue_ball(const Position& position, Point place,
                                                    const Hall& hall);

// Deviates for samples of the noise: in every block of 16 each of the five is drawn once from each
// sixteenth of the normal distribution (Latin hypercube), so that means of whole blocks vary less.
[[nodiscard]] std::vector<physics::ShotDeviates> stratified_deviates(std::size_t count, Dice& dice);

class Trial {
 public:
  explicit Trial(const Hall& hall);
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial();

  // `before` has the cue ball in its place, and the stroke must be possible.
  [[nodiscard]] Position exact(const Position& before, const protocol::ShotParams& stroke,
                               const rules::Call& call);
  [[nodiscard]] Position noisy(const Position& before, const protocol::ShotParams& stroke,
                               const rules::Call& call, const physics::NoiseLevel& noise,
                               const physics::ShotDeviates& deviates);

  // The angle in rad by which the object ball of `line` leaves to the left of its course, cue ball
  // and object ball being alone on the table; nothing if it is not met before a rail.
  [[nodiscard]] std::optional<double> miss(const PotLine& line, const protocol::ShotParams& stroke);

  // Balls down in the last exact or noisy shot, with their pockets.
  struct Down {
    BallId ball{};
    PocketId pocket{};
  };
  [[nodiscard]] const std::vector<Down>& down() const { return down_; }

  [[nodiscard]] const Hall& hall() const { return hall_; }
  // Events simulated so far: the measure of effort, the same on every machine.
  [[nodiscard]] std::uint64_t events() const { return events_; }

 private:
  struct Loop;

  [[nodiscard]] Position play(const Position& before, const physics::CueShot<double>& stroke,
                              const rules::Call& call);

  const Hall& hall_;
  std::unique_ptr<Loop> loop_;
  std::vector<Down> down_;
  std::uint64_t events_ = 0;
};

}  // namespace poolhall::bots
