// Breaks a rack and prints what the referee says of it.
#include <iostream>

#include "physics/simulator.hpp"
#include "rules/referee.hpp"

using namespace poolhall;

int main() {
  const physics::Table table = physics::preset_table("olympiad").value();
  const physics::Materials materials = physics::preset_materials("olympiad").value();
  const rules::GameState start = rules::new_game({.rack_seed = 7}, table, materials);
  const auto ready =
      rules::prepare_shot(start, {}, physics::Vec2<double>{0.558, 0.5}, table, materials);
  if (!ready) {
    std::cerr << ready.error().field << ": " << ready.error().reason << '\n';
    return 1;
  }
  const auto shot = physics::cue_shot_from_degrees(0.0, 5.0, 10.0, 90.0, 9.0);
  const auto played = physics::simulate(
      physics::Scene<double>{table, materials, rules::balls_on_table(*ready), shot}, {});
  if (!played) {
    std::cerr << played.error().field << ": " << played.error().reason << '\n';
    return 1;
  }
  const auto ruling = rules::judge(*ready, {}, played->events, table, materials);
  if (!ruling) {
    std::cerr << ruling.error().reason << '\n';
    return 1;
  }
  std::cout << played->events.size() << " events, first contact "
            << physics::number(ruling->first_contact.value()) << ", "
            << (ruling->legal ? "legal" : "a foul") << '\n';
}
