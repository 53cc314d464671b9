// The tables of a tournament over HTTP, as text, CSV and JSON:
// /api/tournaments/{id}/standings, /crosstable, each also with .csv and .txt, /trf and /status.txt;
// and /api/tournaments.txt.
//
//   Page page = table_page(reader, "cup", "standings.csv");
#pragma once

#include <string_view>

#include "server/web/pages.hpp"

namespace poolhall::web {

[[nodiscard]] Page table_page(storage::Reader& reader, std::string_view tournament,
                              std::string_view what);
[[nodiscard]] Page tournament_list_page(storage::Reader& reader);

}  // namespace poolhall::web
