// From a scene to its event log and its final state.
//
//   Scene<double> scene{table, materials, balls, shot};
//   Expected<Simulation<double>> result = simulate(scene, {});
//
// `simulate` checks the scene first, and with any finite input it ends: at rest, at t_max, or
// with the partial log and Ending::event_limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/cue_strike.hpp"
#include "physics/event_log.hpp"

namespace poolhall::physics {

template <class Real>
struct Scene {
  Table table;
  Materials materials;
  BallSet<Real> balls{};
  std::optional<CueShot<Real>> shot{};
};

enum class ContactModel : std::uint8_t { cluster, sequential, hertz };

// `bracketed` is the project's own; the paper's closed form (Ferrari, Cardano) stands beside it,
// as it is and with its roots polished, to be measured against it.
enum class RootSolver : std::uint8_t { bracketed, closed_form, closed_form_polished };

[[nodiscard]] std::string_view name(ContactModel model);
[[nodiscard]] std::optional<ContactModel> contact_model(std::string_view name);
[[nodiscard]] std::string_view name(RootSolver solver);
[[nodiscard]] std::optional<RootSolver> root_solver(std::string_view name);

struct SimulationOptions {
  ContactModel contact = ContactModel::cluster;
  RootSolver solver = RootSolver::bracketed;
  std::optional<double> t_max{};  // s
  std::uint32_t event_limit = 1'000'000;
};

// Without an event to come a simulation is at rest, even if a ball spins on for ever without
// friction; `stopped`: the watch had its answer.
enum class Ending : std::uint8_t { at_rest, t_max, event_limit, stopped };

[[nodiscard]] std::string_view name(Ending ending);

template <class Real>
struct EnergyAccount {
  Real start{};                // J, after the cue strike
  Real end{};                  // J
  Real added_by_separation{};  // J, by which the separation speed raised the energy
};

template <class Real>
struct Simulation {
  EventLog<Real> events;
  BallSet<Real> balls;  // final, in the order of the scene
  Real duration{};      // s, time of the last event
  EnergyAccount<Real> energy;
  Ending ending = Ending::at_rest;
};

// Two balls may overlap, or a ball stand beyond a rail, by this much: what rounding of positions
// given as decimals leaves.
inline constexpr double position_tolerance = 1e-9;  // m

// Why a scene cannot be simulated; Error.field as in a scene file ("/balls/3/x").
template <class Real>
[[nodiscard]] Expected<void> check_scene(const Scene<Real>& scene);

template <class Real>
[[nodiscard]] Expected<Simulation<Real>> simulate(const Scene<Real>& scene,
                                                  const SimulationOptions& options);

}  // namespace poolhall::physics
