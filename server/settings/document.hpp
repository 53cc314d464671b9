// A TOML file as a tree of plain values that know where they stand. The one place that knows the
// TOML library is document.cpp.
//
//   Expected<Node> root = parse_document(text, "poolhall.toml");
//   const Node* port = root->find("listen");
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "server/settings/settings_error.hpp"

namespace poolhall::settings {

struct Node;
struct Member;

struct Position {
  std::uint32_t line = 0;    // 1-based
  std::uint32_t column = 0;  // 1-based
};

// A date or a time: no key takes one.
struct DateOrTime {};

using Array = std::vector<Node>;
using Table = std::vector<Member>;  // in the order of the file

struct Node {
  Position at;
  std::variant<Table, Array, std::string, std::int64_t, double, bool, DateOrTime> value;

  // The member of that name, if this is a table that has it.
  [[nodiscard]] const Node* find(std::string_view key) const;
};

struct Member {
  std::string key;
  Position key_at;
  Node node;
};

// What a value is, for a reader: `the string "abc"`, `the number 0.5`, `a table`.
[[nodiscard]] std::string describe(const Node& node);

[[nodiscard]] Expected<Node> parse_document(std::string_view text, const std::string& file);

}  // namespace poolhall::settings
