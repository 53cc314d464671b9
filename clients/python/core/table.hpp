// poolhall.Table: a table to play on, its geometry and what everything is made of; and the names
// and numbers that the other parts of the module share.
#pragma once

#include "clients/python/core/arguments.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"

namespace poolhall::python {

struct PlayTable {
  physics::Table table;
  physics::Materials materials;
};

// None is the Olympiad's.
[[nodiscard]] const PlayTable& table_or_default(py::handle argument);

void bind_table(py::module_& module);

}  // namespace poolhall::python
