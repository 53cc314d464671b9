// What the extreme scenes are made of: balls put on tables, and judges of what came.
//
//   out.push_back(comes_as("stun", "tran0:ro tran0:st", with(on_table(), 0, {0.5, 0.5}, {0, 1})));
#pragma once

#include <string>
#include <string_view>

#include "tests/support/scenes.hpp"

namespace poolhall::test_support {

// Of every preset.
inline constexpr double ball_radius = 0.028575;
inline constexpr double ball_diameter = 2 * ball_radius;

[[nodiscard]] physics::Scene<double> on_table(std::string_view table = "olympiad",
                                              std::string_view kind = "olympiad");
// The Olympiad's cloth without pockets.
[[nodiscard]] physics::Scene<double> closed_box();
// The same without any friction; rails and balls give back all.
[[nodiscard]] physics::Scene<double> frictionless_box();

// `scene` with another ball, in the state that its velocities imply.
[[nodiscard]] physics::Scene<double> with(physics::Scene<double> scene, unsigned id,
                                          physics::Vec2<double> at, physics::Vec2<double> v = {},
                                          physics::Vec3<double> w = {});
[[nodiscard]] physics::Scene<double> rolling(physics::Scene<double> scene, unsigned id,
                                             physics::Vec2<double> at, physics::Vec2<double> v);
// With a stroke: mm, mm, degrees, degrees, m/s.
[[nodiscard]] physics::Scene<double> struck(physics::Scene<double> scene,
                                            const physics::ShotParameters<double>& shot);

// The log in short: "stri0 ball0+1 tran0:ro rail1".
[[nodiscard]] std::string sequence(const physics::Simulation<double>& result);
[[nodiscard]] const physics::Event<double>* first_of(const physics::Simulation<double>& result,
                                                     physics::EventType type);

// A number against what it should be, to an absolute tolerance.
[[nodiscard]] Finding near(std::string_view what, double found, double expected, double tolerance);
// The first that is not as expected; else all that was found.
[[nodiscard]] Finding all_of(const std::vector<Finding>& findings);
[[nodiscard]] std::string in_words(double number);

using Check = std::function<Finding(const physics::Simulation<double>&)>;

// The scene must run and keep the invariants; then `check` decides.
[[nodiscard]] NamedScene runs(std::string name, std::string expected, physics::Scene<double> scene,
                              Check check, physics::SimulationOptions options = {});
[[nodiscard]] NamedScene comes_as(std::string name, const std::string& events,
                                  physics::Scene<double> scene,
                                  physics::SimulationOptions options = {});
[[nodiscard]] NamedScene ends(std::string name, physics::Scene<double> scene,
                              physics::Ending ending = physics::Ending::at_rest,
                              physics::SimulationOptions options = {});
[[nodiscard]] NamedScene is_refused(std::string name, physics::Fault fault, std::string field,
                                    physics::Scene<double> scene,
                                    physics::SimulationOptions options = {});

// The groups of extreme_scenes().
void add_free_motion(std::vector<NamedScene>& out);
void add_frictions_and_speeds(std::vector<NamedScene>& out);
void add_pairs(std::vector<NamedScene>& out);
void add_lines_and_followers(std::vector<NamedScene>& out);
void add_clusters(std::vector<NamedScene>& out);
void add_racks(std::vector<NamedScene>& out);
void add_symmetries(std::vector<NamedScene>& out);
void add_rails(std::vector<NamedScene>& out);
void add_pockets(std::vector<NamedScene>& out);
void add_strokes(std::vector<NamedScene>& out);
void add_refusals(std::vector<NamedScene>& out);
void add_long_runs(std::vector<NamedScene>& out);

}  // namespace poolhall::test_support
