// Checksums that make one changed bit in any stored value of a game noticeable.
//
//   turn.checksum = chained(previous, turn);   // previous: the row before, or first_link(game)
//   game.seal = seal(game);                    // after every change of the game's row
//
// SHA-256 over the fields in the order of records.hpp: integers as 8 bytes big-endian, reals as
// their IEEE-754 bits, texts as their length and their bytes, an optional as 1 and its value or 0.
// What came with schema 2 (parts of the agents, shared deviates) adds nothing where it is not used.
#pragma once

#include <string>
#include <string_view>

#include "server/storage/records.hpp"

namespace poolhall::match {

using storage::Digest;

// Over what is fixed in a game before its first turn.
[[nodiscard]] Digest first_link(const storage::GameRecord& game);

// Over the link before and all of this turn but its own checksum.
[[nodiscard]] Digest chained(const Digest& previous, const storage::TurnRecord& turn);

// Over all of a game's row but the seal itself.
[[nodiscard]] Digest seal(const storage::GameRecord& game);

// Over all of a match's row but the seal itself.
[[nodiscard]] Digest seal(const storage::MatchRecord& match);

// 64 hexadecimal digits in lower case, and back; zeros where there is no such digit.
[[nodiscard]] std::string to_hex(const Digest& digest);
[[nodiscard]] Digest digest_of(std::string_view hex);

}  // namespace poolhall::match
