// The kinds of values that keys take: what they accept, how that is said to a person, and how a
// value is written back. A kind reads a Node or refuses it; the caller makes the message.
//
//   WholeNumber kind{1, 1024};
//   kind.expected();                  // "a whole number from 1 to 1024"
//   kind.read(node);                  // std::optional<std::int64_t>
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/settings/document.hpp"
#include "server/settings/units.hpp"

namespace poolhall::settings {

struct WholeNumber {
  using Value = std::int64_t;
  std::int64_t lowest;
  std::int64_t highest;

  [[nodiscard]] std::string expected() const;
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(Value value);
};

template <class Unit>
struct Quantity {
  using Value = typename Unit::Value;
  double lowest;  // as in the file
  double highest;

  [[nodiscard]] std::string expected() const;
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(Value value);
};
using Number = Quantity<PlainUnit>;
using Seconds = Quantity<SecondsUnit>;
using Millimetres = Quantity<MillimetresUnit>;

struct Flag {
  using Value = bool;
  [[nodiscard]] static std::string expected() { return "true or false"; }
  [[nodiscard]] static std::optional<Value> read(const Node& node);
  [[nodiscard]] static std::string write(Value value) { return value ? "true" : "false"; }
};

// Any text of a line without control characters, not empty.
struct Line {
  using Value = std::string;
  std::string what;  // "a command line"
  std::size_t longest = 4096;

  [[nodiscard]] std::string expected() const;
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(const Value& value);
};

// A name as agents and tournaments have it: 1-32 of [A-Za-z0-9._-].
struct Name {
  using Value = std::string;
  [[nodiscard]] static std::string expected();
  [[nodiscard]] static std::optional<Value> read(const Node& node);
  [[nodiscard]] static std::string write(const Value& value);
};

// "127.0.0.1:7777", "[::1]:7777"; port 0 picks a free one.
struct HostPort {
  using Value = std::string;
  [[nodiscard]] static std::string expected();
  [[nodiscard]] static std::optional<Value> read(const Node& node);
  [[nodiscard]] static std::string write(const Value& value);
};

// Another kind of text, or "" where nothing is wanted.
template <class Kind>
struct OrNone {
  using Value = std::string;
  Kind kind;

  [[nodiscard]] std::string expected() const { return kind.expected() + "; \"\" for none"; }
  [[nodiscard]] std::optional<Value> read(const Node& node) const {
    const auto* text = std::get_if<std::string>(&node.value);
    return text != nullptr && text->empty() ? std::optional(*text) : kind.read(node);
  }
  [[nodiscard]] std::string write(const Value& value) const { return kind.write(value); }
};

struct OneOf {
  using Value = std::string;
  std::vector<std::string> choices;

  [[nodiscard]] std::string expected() const;
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(const Value& value);
};

// One of the names that another room knows; the list grows without the documentation changing.
struct Preset {
  using Value = std::string;
  std::string what;  // "the name of a table in config/tables"
  std::vector<std::string> names;

  [[nodiscard]] std::string expected() const { return what; }
  [[nodiscard]] std::string expected_now() const;  // with the names, for a refusal
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(const Value& value);
};

// An array without repetitions of some of the choices; the order means something.
struct SomeOf {
  using Value = std::vector<std::string>;
  std::vector<std::string> choices;

  [[nodiscard]] std::string expected() const;
  [[nodiscard]] std::optional<Value> read(const Node& node) const;
  [[nodiscard]] static std::string write(const Value& value);
};

// The candidate that is most like `word`, if any is like it at all.
[[nodiscard]] std::optional<std::string> nearest(std::string_view word,
                                                 const std::vector<std::string>& candidates);

}  // namespace poolhall::settings
