// Tables and materials as JSON and back, with all their numbers.
//
//   RawJson table{encode_table(*physics::preset_table("olympiad"))};
//   Expected<physics::Table> again = decode_table(table.text);
//
// Reading takes a preset's name, or an object with inline values; of materials
// also {"preset": name, overrides...}. Unknown keys are errors that name the key.
#pragma once

#include <string>
#include <string_view>

#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "protocol/errors.hpp"

namespace poolhall::protocol {

[[nodiscard]] std::string encode_table(const physics::Table& table);
[[nodiscard]] Expected<physics::Table> decode_table(std::string_view text);

[[nodiscard]] std::string encode_materials(const physics::Materials& materials);
[[nodiscard]] Expected<physics::Materials> decode_materials(std::string_view text);

}  // namespace poolhall::protocol
