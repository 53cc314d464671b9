// JSON text to a tree of values, within bounds. Parsing is nlohmann-json's (RFC 8259, UTF-8
// checked); this adds what untrusted input needs: bounded nesting and keys, no duplicate keys, no
// number that a double cannot hold.
//
//   Expected<JsonValue> document = parse_json(line, json_bounds(limits));
//
// Rooms to the right use the typed headers (codec.hpp, state_json.hpp, ...) instead.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/errors.hpp"
#include "protocol/limits.hpp"

namespace poolhall::protocol {

struct JsonValue;
using JsonArray = std::vector<JsonValue>;
using JsonObject = std::vector<std::pair<std::string, JsonValue>>;  // in the order of the text

struct JsonValue {
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, JsonArray,
               JsonObject>
      data{};

  template <class T>
  [[nodiscard]] const T* as() const {
    return std::get_if<T>(&data);
  }
  [[nodiscard]] bool is_null() const { return as<std::monostate>() != nullptr; }
  // The member of that name; null if this is no object or has none.
  [[nodiscard]] const JsonValue* member(std::string_view key) const;
};

// Error.field is the JSON Pointer of the duplicate key or of the number that overflows, Error.code
// is parse_error.
[[nodiscard]] Expected<JsonValue> parse_json(std::string_view text, JsonBounds bounds);

// One text for equal values: no spaces, numbers and strings as JsonWriter writes them.
[[nodiscard]] std::string canonical_text(const JsonValue& value);

// `key` as one more reference token of a JSON Pointer (RFC 6901), with its "/"; a key of more than
// 64 bytes is cut short.
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace poolhall::protocol
