// Stored turns in words, and a table in characters.
//
//   fmt::print("{}\n", turn_words(turn, {"Anna", "Bob"}));
//   fmt::print("{}", table_text(state, table));
#pragma once

#include <array>
#include <string>

#include "physics/table.hpp"
#include "rules/game_state.hpp"
#include "server/storage/records.hpp"

namespace poolhall::app {

// One line: who did what, and what came of it.
[[nodiscard]] std::string turn_words(const storage::TurnRecord& turn,
                                     const std::array<std::string, 2>& players);

// The table on its side, head rail left: o the cue ball, 1-9 and A-F the object balls.
[[nodiscard]] std::string table_text(const rules::GameState& state, const physics::Table& table);

}  // namespace poolhall::app
