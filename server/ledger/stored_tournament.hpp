// A tournament as a database has it: its results, and the schedule and tables that follow.
//
//   auto stored = stored_tournament(reader, "cup");
//   if (stored && *stored) print((*stored)->book.schedule());
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/ledger/tournament_book.hpp"
#include "server/storage/database.hpp"

namespace poolhall::ledger {

struct StoredTournament {
  storage::TournamentRecord record;
  TournamentBook book;
};

// What it takes for whoever is told of everything later.
inline constexpr storage::UnixMicros no_horizon{INT64_MAX};

// Nothing: there is no such tournament. Settings that cannot be read are an error. Games and
// matches that ended after `until` have not ended yet.
[[nodiscard]] storage::Expected<std::optional<StoredTournament>> stored_tournament(
    storage::Reader& reader, std::string_view id, storage::UnixMicros until = no_horizon);

}  // namespace poolhall::ledger
