// What the server says of itself to people and their graphs.
//
//   std::string text = metrics_of(arena.figures(), writer.statistics());
#pragma once

#include <string>

#include "server/net/arena.hpp"
#include "server/web/pages.hpp"

namespace poolhall::net {

// 200, or 503 while the database takes nothing.
[[nodiscard]] web::Page health_page(const ArenaFigures& figures);
// Prometheus' text format.
[[nodiscard]] std::string metrics_of(const ArenaFigures& figures,
                                     const storage::WriterStatistics& writing);
// The games that go on, as JSON.
[[nodiscard]] std::string live_json(const Arena& arena);

}  // namespace poolhall::net
