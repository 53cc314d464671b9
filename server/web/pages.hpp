// The read-only JSON API as a pure function of the database: a path in, a page out. Noise keys are
// in no page before their match is over.
//
//   Page page = answer(*reader, "/api/games/17");
//   page.status; page.body;
#pragma once

#include <string>
#include <string_view>

#include "server/storage/database.hpp"

namespace poolhall::web {

struct Page {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body;
};

[[nodiscard]] Page answer(storage::Reader& reader, std::string_view path);

// A refusal as JSON: {"error": {"code": "not_found", "reason": "..."}}.
[[nodiscard]] Page refusal(unsigned status, std::string_view code, std::string_view reason);

}  // namespace poolhall::web
