// Who plays in a tournament: entries are numbered from 0 in the order of the tournament's file.
#pragma once

#include <cstddef>
#include <cstdint>

namespace poolhall::tournament {

enum class EntryId : std::uint32_t {};

[[nodiscard]] constexpr std::size_t index(EntryId entry) {
  return static_cast<std::size_t>(entry);
}
[[nodiscard]] constexpr EntryId entry_id(std::size_t index) {
  return static_cast<EntryId>(index);
}

}  // namespace poolhall::tournament
