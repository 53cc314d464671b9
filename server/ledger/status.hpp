// How tournaments stand, as lines for people.
//
//   std::cout << status_text(stored);
#pragma once

#include <string>

#include "server/ledger/stored_tournament.hpp"

namespace poolhall::ledger {

// Format, status, matches and games so far, the round, and an SPRT's line.
[[nodiscard]] std::string status_text(const StoredTournament& tournament);

// One line a tournament: its id, status, format and entries.
[[nodiscard]] storage::Expected<std::string> list_text(storage::Reader& reader);

}  // namespace poolhall::ledger
