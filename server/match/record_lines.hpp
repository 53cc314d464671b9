// Records as JSON lines and back, each line an object with one member that names it; README.md in
// this folder has all members. For export_lines and import_lines.
//
//   std::string line = line_of(turn);
//   protocol::Expected<LineRecord> again = read_line(line);   // the TurnRecord, bit for bit
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/errors.hpp"
#include "server/match/secrets.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

inline constexpr std::int64_t export_format = 2;

struct ExportHeader {
  std::int64_t format = export_format;
};
struct TournamentWithEntries {
  storage::TournamentRecord tournament;
  std::vector<storage::EntryRecord> entries;

  friend bool operator==(const TournamentWithEntries&, const TournamentWithEntries&) = default;
};
using LineRecord = std::variant<ExportHeader, storage::AgentRecord, TournamentWithEntries,
                                storage::MatchRecord, storage::GameRecord, storage::TurnRecord>;

[[nodiscard]] std::string header_line();
[[nodiscard]] std::string line_of(const storage::AgentRecord& agent);
[[nodiscard]] std::string line_of(const TournamentWithEntries& tournament);
[[nodiscard]] std::string line_of(const storage::MatchRecord& match, Secrets secrets);
[[nodiscard]] std::string line_of(const storage::GameRecord& game, Secrets secrets);
[[nodiscard]] std::string line_of(const storage::TurnRecord& turn);

// Error.field is the JSON Pointer of what is missing, of another type, or not told. An agent comes
// without the hash of a token.
[[nodiscard]] protocol::Expected<LineRecord> read_line(std::string_view line);

}  // namespace poolhall::match
