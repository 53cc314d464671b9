// The tables of config/tables, compiled in. For use through preset_table (table.hpp).
#pragma once

#include <vector>

#include "physics/table.hpp"

namespace poolhall::physics {

[[nodiscard]] std::vector<Table> table_presets();

}  // namespace poolhall::physics
