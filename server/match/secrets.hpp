// What may be told of a match at this moment: keys not before it is over, a hidden level not before
// its tournament is.
//
//   storage::Expected<Secrets> secrets = secrets_of(reader, match);
//   if (tells_keys(*secrets)) ...
#pragma once

#include <cstdint>

#include "server/storage/database.hpp"

namespace poolhall::match {

enum class Secrets : std::uint8_t {
  kept,        // the match goes on: no keys, no hidden level
  level_kept,  // the match is over, a tournament with hidden noise goes on: keys, no level
  told,
};

[[nodiscard]] storage::Expected<Secrets> secrets_of(storage::Reader& reader,
                                                    const storage::MatchRecord& match);

[[nodiscard]] constexpr bool tells_keys(Secrets secrets) {
  return secrets != Secrets::kept;
}
[[nodiscard]] inline bool tells_level(const storage::TermsRecord& terms, Secrets secrets) {
  return secrets == Secrets::told || !terms.noise_hidden;
}

// Nothing more is played in it.
[[nodiscard]] constexpr bool is_over(storage::TournamentStatus status) {
  return status == storage::TournamentStatus::finished ||
         status == storage::TournamentStatus::aborted;
}

}  // namespace poolhall::match
