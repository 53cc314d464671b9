// Whether an event log can be that of a shot from a state. The referee judges nothing that did
// not happen on this table: form, order, balls that are there, where a ball was struck, the motion
// laws between a ball's events, everything at rest at the end. A log without the balls' states (a
// summary) is read for what it says; a ball then stays where it was.
//
//   if (auto fits = check_log(ready, events, materials); !fits) return fits.error();
#pragma once

#include "physics/event_log.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules {

[[nodiscard]] Expected<void> check_log(const GameState& ready,
                                       const physics::EventLog<double>& events,
                                       const physics::Materials& materials);

}  // namespace poolhall::rules
