// The table as data: the rectangle between the cushion noses, its pockets and its spots.
//
// Frame: origin at the lower left corner of that rectangle, x across the table (0..width), y
// along it (0..length), z up; the head (kitchen) is at small y, the foot (rack) at large y.
//
//   const Table& table = preset_table("olympiad").value();
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "physics/expected.hpp"

namespace poolhall::physics {

enum class PocketId : std::uint8_t {
  head_left,
  head_right,
  side_left,
  side_right,
  foot_left,
  foot_right,
};
inline constexpr std::size_t pocket_count = 6;

// The six cushions. The side pockets part each long rail in a half at the head and one at the
// foot; a table without pockets parts them at length / 2 all the same.
enum class RailId : std::uint8_t { head, head_left, head_right, foot_left, foot_right, foot };
inline constexpr std::size_t rail_count = 6;

[[nodiscard]] std::string_view name(PocketId pocket);
[[nodiscard]] std::string_view name(RailId rail);
[[nodiscard]] std::optional<PocketId> pocket_id(std::string_view name);
[[nodiscard]] std::optional<RailId> rail_id(std::string_view name);

// No pockets: a closed rectangle.
struct NoPockets {};

// The paper's pockets: no jaws; a ball is pocketed when its centre reaches the line
// x + y = corner / sqrt(2) + R (and its mirror images) or, between the ends of a side mouth,
// the line x = R.
struct MouthLines {
  double corner = 0.11;  // m, width of a corner mouth
  double side = 0.12;    // m, width of a side mouth
};

// Pockets with jaws (arcs and facings) and holes.
struct JawPocket {
  double width = 0;       // m, p: the mouth, nose to nose
  double angle = 0;       // degrees, f: facing angle
  double depth = 0;       // m, d: from the mouth to the hole's centre
  double radius = 0;      // m, of the hole
  double jaw_radius = 0;  // m, j: of the arc between rail and facing
};
struct Jaws {
  double cushion_width = 0.0508;  // m, k
  JawPocket corner;
  JawPocket side;
};

using Pockets = std::variant<NoPockets, MouthLines, Jaws>;

struct Table {
  std::string name;       // of the preset, "" when given inline
  double width = 1.116;   // m, between the noses
  double length = 2.236;  // m, between the noses
  Pockets pockets = MouthLines{};
  std::optional<double> nose_height{};  // m above the cloth; unset: the material's
  double head_string = 0;               // m, y of the head string (length / 4)
  double foot_spot_x = 0;               // m (width / 2)
  double foot_spot_y = 0;               // m (3 length / 4)
};

// The table of that name, compiled in from config/tables; nothing if there is none.
[[nodiscard]] std::optional<Table> preset_table(std::string_view name);
[[nodiscard]] std::vector<std::string> preset_table_names();

// Whether each number is finite and in its range (Fault::not_finite, out_of_range) and balls of
// this radius can play on it (Fault::bad_table); Error.field is the key in scenes and config
// files ("/width", "/pockets/corner").
[[nodiscard]] Expected<void> check_table(const Table& table, double ball_radius);

}  // namespace poolhall::physics
