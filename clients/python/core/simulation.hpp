// poolhall.simulate and what it returns; the event log as NumPy records; where every ball is at
// any instant.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "clients/python/core/arguments.hpp"
#include "clients/python/core/table.hpp"
#include "physics/coefficients.hpp"
#include "physics/motion.hpp"
#include "physics/simulator.hpp"

namespace poolhall::python {

// An entry of the event log as a NumPy record (poolhall.EVENT).
struct EventRow {
  double t;          // s
  double until;      // s, last of the hops that the entry stands for; t if it is one
  BallRow after[2];  // right after the event (right after `until`)
  std::uint32_t count;
  std::uint8_t type;       // index into poolhall.EVENT_TYPES
  std::uint8_t balls[2];   // 255: none
  std::int8_t rail;        // index into poolhall.RAILS, -1: none
  std::int8_t pocket;      // index into poolhall.POCKETS, -1: none
  std::uint8_t unused[3];  // fills the record up
};

// A scene as it was given, which is all that is needed to play it again.
struct PlayedScene {
  py::object table;  // a PlayTable or None, kept alive
  Balls balls;
  std::optional<physics::ShotParameters<double>> shot{};
  physics::SimulationOptions options{};
};

// The way of one ball through the log: closed forms between its events.
struct TrackPiece {
  double start = 0;  // s
  physics::Segment<double> motion;
  physics::BallId id{};
  bool is_hops = false;  // many tiny hops in one entry: a cubic to `to` at `end`
  double end = 0;
  physics::Ball<double> to{};
};
using Track = std::vector<TrackPiece>;

class SimulationResult {
 public:
  SimulationResult(PlayedScene scene, physics::Simulation<double> done)
      : scene_(std::move(scene)), done_(std::move(done)) {}

  [[nodiscard]] const PlayedScene& scene() const { return scene_; }
  [[nodiscard]] const physics::Simulation<double>& done() const { return done_; }
  // In the order of the scene; t from 0 to `end`, beyond which nothing is known to change.
  [[nodiscard]] std::vector<physics::Ball<double>> balls_at(double t) const;
  [[nodiscard]] double end() const;

 private:
  [[nodiscard]] const std::vector<Track>& tracks() const;

  PlayedScene scene_;
  physics::Simulation<double> done_;
  mutable std::vector<Track> tracks_;  // made when first asked for, under the interpreter's lock
};

[[nodiscard]] physics::Scene<double> scene_of(const PlayedScene& scene);

// One row a ball of the argument, x and y; NaN where it is not on the table.
[[nodiscard]] py::array_t<double> positions_of(const Balls& balls,
                                               const physics::Ball<double>* begin);
[[nodiscard]] py::array_t<BallRow> rows_of(const std::vector<physics::Ball<double>>& balls);

void bind_simulation(py::module_& module);
void bind_evaluation(py::module_& module);
void bind_timing(py::module_& module);

}  // namespace poolhall::python
