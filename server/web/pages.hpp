// The read-only JSON API as a pure function of the database: a path in, a page out. Noise keys are
// in no page before their match is over.
//
//   Page page = answer(*reader, "/api/games/17", delay);
//   page.status; page.body;
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "server/storage/database.hpp"
#include "server/web/page.hpp"

namespace poolhall::web {

// What happened less than `delay` ago is not told.
[[nodiscard]] Page answer(storage::Reader& reader, std::string_view path,
                          std::chrono::milliseconds delay);

// A stored turn as /api/games/N/shots/M and spectators have it.
[[nodiscard]] std::string turn_text(const storage::TurnRecord& turn);

}  // namespace poolhall::web
