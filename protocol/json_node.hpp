// Reads typed values out of a parsed document and remembers the first thing that did not fit, with
// its JSON Pointer, what was expected and what came. Reading goes on after a failure with plain
// defaults, so that a decoder is a list of fields and one look at the end.
//
//   Reading reading(document);
//   JsonNode params = reading.root().at("params");
//   message.turn = params.at("turn").integer<std::uint32_t>(1);
//   message.rules = params.at("rules").one_of(rules::rule_set, "\"8-ball\" or \"9-ball\"");
//   if (!reading.ok()) return tl::unexpected(reading.error());
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "protocol/errors.hpp"
#include "protocol/json_value.hpp"

namespace poolhall::protocol {

class Reading;

class JsonNode {
 public:
  // Nothing is there; what is read from it are defaults.
  explicit JsonNode(Reading& reading) : reading_(&reading) {}
  JsonNode(Reading& reading, const JsonValue& value) : reading_(&reading), value_(&value) {}

  // A member that must be there.
  [[nodiscard]] JsonNode at(std::string_view key) const;
  // A member that may be missing or null.
  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
  // A member that must be there and may be null.
  [[nodiscard]] std::optional<JsonNode> nullable(std::string_view key) const;

  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string string() const;
  // Whole numbers within the range; 7.0 is one.
  template <class Integer>
  [[nodiscard]] Integer integer(Integer least = std::numeric_limits<Integer>::min(),
                                Integer most = std::numeric_limits<Integer>::max()) const {
    return static_cast<Integer>(whole(static_cast<std::int64_t>(least), clamp(most)));
  }
  // Whether it is that string, without refusing anything else.
  [[nodiscard]] bool is_string(std::string_view text) const;
  [[nodiscard]] bool is_object() const;

  // The value that `from_name` has for this string; `expected` lists the names for the reason.
  template <class FromName>
  [[nodiscard]] auto one_of(FromName from_name, std::string_view expected) const {
    using Value = typename std::invoke_result_t<FromName, std::string_view>::value_type;
    const std::string* text = text_or_refuse(expected);
    if (text == nullptr) {
      return Value{};
    }
    const auto value = from_name(*text);
    if (!value) {
      refuse_expecting(expected);
      return Value{};
    }
    return *value;
  }

  [[nodiscard]] std::vector<JsonNode> elements() const;                   // any number
  [[nodiscard]] std::vector<JsonNode> elements(std::size_t count) const;  // exactly `count`

  // An object in a file: another key is an error that names it.
  void only(std::initializer_list<std::string_view> known) const;

  [[nodiscard]] const JsonValue* value() const { return value_; }

  void refuse(std::string reason) const;
  void refuse_expecting(std::string_view expected) const;  // "expected X, got Y"
  // As refuse, with another code and without repeating what came (it may be a secret).
  void refuse_as(ErrorCode code, std::string reason) const;

 private:
  template <class Integer>
  [[nodiscard]] static constexpr std::int64_t clamp(Integer most) {
    constexpr auto top = std::numeric_limits<std::int64_t>::max();
    if constexpr (std::is_unsigned_v<Integer> && sizeof(Integer) == sizeof(std::int64_t)) {
      return most > static_cast<Integer>(top) ? top : static_cast<std::int64_t>(most);
    } else {
      return static_cast<std::int64_t>(most);
    }
  }
  [[nodiscard]] std::int64_t whole(std::int64_t least, std::int64_t most) const;
  [[nodiscard]] const std::string* text_or_refuse(std::string_view expected) const;
  [[nodiscard]] bool object_or_refuse() const;

  Reading* reading_;
  const JsonValue* value_ = nullptr;
};

class Reading {
 public:
  // `code` is what a value that does not fit is called.
  explicit Reading(const JsonValue& document, ErrorCode code = ErrorCode::invalid_params)
      : document_(document), code_(code) {}
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  [[nodiscard]] JsonNode root() { return JsonNode(*this, document_); }
  [[nodiscard]] bool ok() const { return !error_; }
  [[nodiscard]] const Error& error() const { return *error_; }

  // Only the first refusal is kept. `below` is what follows the value's own pointer.
  void refuse(const JsonValue& value, std::string_view below, std::string reason);
  void refuse_as(ErrorCode code, const JsonValue& value, std::string reason);

 private:
  const JsonValue& document_;
  ErrorCode code_;
  std::optional<Error> error_;
};

// A value in a few words, for "got ...".
[[nodiscard]] std::string described(const JsonValue& value);

// Parses and reads a whole text: `read` takes the root node and gives the value.
template <class Read>
[[nodiscard]] auto read_document(std::string_view text, JsonBounds bounds, Read read)
    -> Expected<std::invoke_result_t<Read, JsonNode>> {
  const Expected<JsonValue> document = parse_json(text, bounds);
  if (!document) {
    return tl::unexpected(document.error());
  }
  Reading reading(*document);
  auto value = read(reading.root());
  if (!reading.ok()) {
    return tl::unexpected(reading.error());
  }
  return value;
}

// What the project wrote itself, and files: large, but not without bounds.
inline constexpr JsonBounds document_bounds{16, 1'000'000};

}  // namespace poolhall::protocol
