// Whether an event log can be that of a shot from a state. The referee judges nothing that did
// not happen on this table.
//
//   if (auto fits = check_log(ready, events, table, materials); !fits) return fits.error();
#pragma once

#include "physics/event_log.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules {

[[nodiscard]] Expected<void> check_log(const GameState& ready,
                                       const physics::EventLog<double>& events,
                                       const physics::Table& table,
                                       const physics::Materials& materials);

}  // namespace poolhall::rules
