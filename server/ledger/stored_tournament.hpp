// A tournament as a database has it: its results, and the schedule and tables that follow.
//
//   auto stored = stored_tournament(reader, "cup");
//   if (stored && *stored) print((*stored)->book.schedule());
#pragma once

#include <optional>
#include <string_view>

#include "server/ledger/tournament_book.hpp"
#include "server/storage/database.hpp"

namespace poolhall::ledger {

struct StoredTournament {
  storage::TournamentRecord record;
  TournamentBook book;
};

// Nothing: there is no such tournament. Settings that cannot be read are an error.
[[nodiscard]] storage::Expected<std::optional<StoredTournament>> stored_tournament(
    storage::Reader& reader, std::string_view id);

// Nothing: it is void or goes on.
[[nodiscard]] std::optional<ScoredGame> scored_game(const storage::MatchRecord& match,
                                                    const storage::GameRecord& game);

}  // namespace poolhall::ledger
