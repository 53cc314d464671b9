// The long texts of a turn as one compressed value. States, ruling and events are nearly all of a
// row, and most of them is said again and again: together they take about a third.
//
//   if (const auto packed = packed_texts(turn)) bind(*packed);
//   unpack_texts(packed, turn);   // what packed_texts was given
//
// The value is a Zstandard frame of four lines: state_before, state_after, ruling, events; the last
// two may be empty. README.md tells how to read a row by hand.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/storage/records.hpp"

namespace poolhall::storage {

// Nothing where a text would not be a line of its own: it has an end of line in it, or is a ruling
// that is there and empty.
[[nodiscard]] std::optional<std::string> packed_texts(const TurnRecord& turn);

// Sets the four texts; the turn's shot must be set before. False: not a value that packed_texts
// gives for such a turn.
[[nodiscard]] bool unpack_texts(std::string_view packed, TurnRecord& turn);

}  // namespace poolhall::storage
