// A database, or a part of it, as JSON lines for other programs and for import_lines. The lines are
// described in README.md of this folder. Tokens are never exported; keys, agents' secrets and the
// level of hidden noise not before their time.
//
//   export_lines(*reader, {.tournament = "cup"},
//                [](const std::string& line) { std::puts(line.c_str()); });
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/storage/database.hpp"

namespace poolhall::match {

// What to export; with nothing set all of it. A part brings along what it refers to.
struct ExportPart {
  std::optional<std::string> tournament{};  // its matches
  std::optional<protocol::MatchId> match{};
  std::optional<protocol::GameId> game{};  // its match, without the match's other games
};

// The lines come without their ends. The error of a part that is not there is a conflict.
[[nodiscard]] storage::Expected<void> export_lines(
    storage::Reader& reader, const ExportPart& part,
    const std::function<void(const std::string&)>& line);

}  // namespace poolhall::match
