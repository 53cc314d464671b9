#include "physics/table.hpp"

#include <string>

#include "physics/math.hpp"
#include "physics/number_check.hpp"
#include "physics/table_geometry.hpp"
#include "physics/table_presets.hpp"

namespace poolhall::physics {
namespace {

Error bad_table(std::string field, std::string reason) {
  return {Fault::bad_table, std::move(field), std::move(reason)};
}

Expected<void> check_numbers(const NoPockets&) {
  return {};
}

Expected<void> check_numbers(const MouthLines& mouths) {
  return check_all({{"/pockets/corner", mouths.corner, above(0), at_most(100)},
                    {"/pockets/side", mouths.side, above(0), at_most(100)}});
}

Expected<void> check_numbers(const JawPocket& pocket, const std::string& field) {
  return check_all({{field + "/width", pocket.width, above(0), at_most(100)},
                    {field + "/angle", pocket.angle, above(-40), below(40)},
                    {field + "/depth", pocket.depth, at_least(0), at_most(100)},
                    {field + "/radius", pocket.radius, above(0), at_most(100)},
                    {field + "/jaw_radius", pocket.jaw_radius, at_least(0), at_most(100)}});
}

Expected<void> check_numbers(const Jaws& jaws) {
  return check_all({{"/pockets/cushion_width", jaws.cushion_width, above(0), at_most(100)}})
      .and_then([&] { return check_numbers(jaws.corner, "/pockets/corner"); })
      .and_then([&] { return check_numbers(jaws.side, "/pockets/side"); });
}

std::string_view pocket_field(PocketId pocket) {
  const bool is_side = pocket == PocketId::side_left || pocket == PocketId::side_right;
  return is_side ? "/pockets/side" : "/pockets/corner";
}

// A ball that runs along a facing must be in the hole before the facing ends.
Expected<void> check_pockets(const TableGeometry<double>& geometry) {
  for (const Facing<double>& facing : geometry.facings) {
    const std::string field(pocket_field(facing.pocket));
    for (const Hole<double>& hole : geometry.holes) {
      if (hole.pocket != facing.pocket)
        continue;
      const Vec2<double> last = facing.to - geometry.ball_radius * facing.into - hole.centre;
      if (dot(last, last) > hole.radius * hole.radius) {
        return tl::unexpected(
            bad_table(field,
                      "a ball at the end of the facing is not yet in the hole: expected a larger "
                      "radius, or a smaller depth or cushion width"));
      }
    }
  }
  return {};
}

Expected<void> check_rails(const TableGeometry<double>& geometry) {
  for (const StraightRail<double>& rail : geometry.rails) {
    if (!(rail.begin < rail.end)) {
      return tl::unexpected(
          bad_table("/pockets", "the pockets leave nothing of the " + std::string(name(rail.rail)) +
                                    " rail: expected narrower mouths or a larger table"));
    }
  }
  return {};
}

}  // namespace

std::optional<Table> preset_table(std::string_view name) {
  for (Table& table : table_presets()) {
    if (table.name == name)
      return table;
  }
  return std::nullopt;
}

std::vector<std::string> preset_table_names() {
  std::vector<std::string> names;
  for (const Table& table : table_presets())
    names.push_back(table.name);
  return names;
}

Expected<void> check_table(const Table& table, double ball_radius) {
  const double nose = table.nose_height.value_or(ball_radius);
  return check_all({{"/width", table.width, above(2 * ball_radius), at_most(100)},
                    {"/length", table.length, above(2 * ball_radius), at_most(100)},
                    {"/nose_height", nose, above(0), below(2 * ball_radius)},
                    {"/head_string", table.head_string, at_least(0), at_most(table.length)},
                    {"/foot_spot", table.foot_spot_x, at_least(0), at_most(table.width)},
                    {"/foot_spot", table.foot_spot_y, at_least(0), at_most(table.length)}})
      .and_then([&] {
        return std::visit([&](const auto& p) { return check_numbers(p); }, table.pockets);
      })
      .and_then([&] {
        const auto geometry = table_geometry<double>(table, ball_radius);
        return check_rails(geometry).and_then([&] { return check_pockets(geometry); });
      });
}

}  // namespace poolhall::physics
