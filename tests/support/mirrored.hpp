// A game seen in a mirror: left and right exchanged, x -> W - x. The rules know no side, so a
// mirrored shot has the mirrored ruling.
//
//   EXPECT_TRUE(same_in_mirror(ruling, mirrored_ruling, table));
#pragma once

#include "physics/event_log.hpp"
#include "physics/table.hpp"
#include "rules/referee.hpp"

namespace poolhall::test_support {

[[nodiscard]] physics::PocketId mirrored(physics::PocketId pocket);
[[nodiscard]] physics::RailId mirrored(physics::RailId rail);
[[nodiscard]] rules::GameState mirrored(rules::GameState state, const physics::Table& table);
[[nodiscard]] rules::Call mirrored(rules::Call call);
[[nodiscard]] physics::EventLog<double> mirrored(physics::EventLog<double> events,
                                                 const physics::Table& table);

// Whether one ruling is the other's mirror image, places to 1e-9 m. A new rack is not mirrored.
[[nodiscard]] bool same_in_mirror(const rules::Ruling& ruling, const rules::Ruling& other,
                                  const physics::Table& table);

}  // namespace poolhall::test_support
