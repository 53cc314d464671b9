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
                                     const storage::WriterStatistics& writing,
                                     std::size_t spectators);
// The games that go on, as JSON.
enum class States : std::uint8_t { included, left_out };  // where the balls lie, whose turn it is
[[nodiscard]] std::string live_json(const Arena& arena, States states);

}  // namespace poolhall::net
