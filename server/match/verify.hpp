// Checks a database against itself and against the simulator: every stored shot is run again and
// compared bit for bit, the noise recomputed from the key and the agents' parts, every turn judged
// again, checksums, commitments and seals recomputed, and the games compared with their match.
//
//   VerifyReport report = verify(*reader, {}).value();
//   if (!report.differences.empty()) say(report.differences.front());
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/storage/database.hpp"

namespace poolhall::match {

struct Difference {
  protocol::GameId game{};
  std::optional<std::uint32_t> turn{};       // unset: the game's own row
  std::string field;                         // column
  std::string reason;                        // one line: what is stored, what it should be
  std::optional<protocol::MatchId> match{};  // set: its match's row, not the game's
};

struct VerifyReport {
  std::uint64_t games = 0;
  std::uint64_t unfinished = 0;  // of them
  std::uint64_t turns = 0;
  std::uint64_t shots = 0;          // run again and the same
  std::uint64_t other_version = 0;  // turns of another physics or rules version: chain, and what of
                                    // them this version can judge
  std::vector<std::string> structure;   // what the database finds wrong with itself
  std::vector<Difference> differences;  // the first of each game that has one

  [[nodiscard]] bool same() const { return structure.empty() && differences.empty(); }
};

struct VerifyOptions {
  std::optional<protocol::GameId> only{};
  std::function<void(const VerifyReport&)> progress{};  // after each game
};
[[nodiscard]] storage::Expected<VerifyReport> verify(storage::Reader& reader,
                                                     const VerifyOptions& options);

// The first difference in one game; counts into `report`.
void verify_game(storage::Reader& reader, protocol::GameId id, VerifyReport& report);

}  // namespace poolhall::match
