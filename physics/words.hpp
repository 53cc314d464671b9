// Enumerators and the words for them, on the wire and in files: one table, read both ways.
//
//   constexpr Words<RailId, 2> rails{{{RailId::head, "head"}, {RailId::foot, "foot"}}};
//   std::string_view word = word_of(rails, RailId::foot);
//   std::optional<RailId> rail = value_of(rails, "foot");
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace poolhall::physics {

template <class Enum, std::size_t n>
using Words = std::array<std::pair<Enum, std::string_view>, n>;

// "" for a value that is no enumerator; the first of several words.
template <class Enum, std::size_t n>
[[nodiscard]] constexpr std::string_view word_of(const Words<Enum, n>& words, Enum value) {
  for (const auto& [candidate, word] : words) {
    if (candidate == value) {
      return word;
    }
  }
  return {};
}

template <class Enum, std::size_t n>
[[nodiscard]] constexpr std::optional<Enum> value_of(const Words<Enum, n>& words,
                                                     std::string_view word) {
  for (const auto& [candidate, known] : words) {
    if (known == word) {
      return candidate;
    }
  }
  return std::nullopt;
}

}  // namespace poolhall::physics
