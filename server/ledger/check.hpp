// Checks a stored tournament against itself: that its matches are those of the schedule that its
// settings, entries and games give, and that its final table is theirs. What is in the games is
// match::verify's business.
//
//   for (const std::string& difference : check_tournaments(*reader).value()) say(difference);
#pragma once

#include <string>
#include <vector>

#include "server/ledger/stored_tournament.hpp"

namespace poolhall::ledger {

// One line each, with the tournament and what of it differs; empty: all is as it should be.
[[nodiscard]] storage::Expected<std::vector<std::string>> check_tournaments(
    storage::Reader& reader);

}  // namespace poolhall::ledger
