#include "physics/cushion_contact.hpp"

namespace poolhall::physics {

std::optional<double> nose_height(const Table& table, const Materials& materials) {
  const std::optional<double> of_cushion = std::visit(
      [](const auto& cushion) -> std::optional<double> {
        if constexpr (requires { cushion.nose_height; }) {
          return cushion.nose_height;
        } else {
          return std::nullopt;
        }
      },
      materials.cushion);
  return of_cushion ? of_cushion : table.nose_height;
}

double nose_height_or_default(const Table& table, const Materials& materials) {
  return nose_height(table, materials).value_or(1.28 * materials.ball_radius);
}

}  // namespace poolhall::physics
