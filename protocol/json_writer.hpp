// Writes JSON text straight into a string: no tree in between, because a shot's log is thousands
// of numbers, and text that is already made can be put in as it is. Numbers are the shortest
// decimals that read back as the same double; -0 keeps its sign.
//
//   JsonWriter out;
//   out.begin_object().key("t").number(0.25).key("state").raw(state_text).end_object();
//   std::string text = std::move(out).text();   // {"t":0.25,"state":...}
//
// The caller keeps the order begin, key, value, end; nothing checks it.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace poolhall::protocol {

class JsonWriter {
 public:
  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }

  // `name` is one of the protocol's own words, or is quoted like any string.
  JsonWriter& key(std::string_view name);

  JsonWriter& null() { return raw("null"); }
  JsonWriter& boolean(bool value) { return raw(value ? "true" : "false"); }
  JsonWriter& integer(std::int64_t value);
  JsonWriter& integer(std::uint64_t value);
  template <std::integral Integer>
  JsonWriter& integer(Integer value) {
    if constexpr (std::signed_integral<Integer>) {
      return integer(static_cast<std::int64_t>(value));
    } else {
      return integer(static_cast<std::uint64_t>(value));
    }
  }
  JsonWriter& number(double value);  // null if not finite
  JsonWriter& number(long double value);
  // Invalid UTF-8 comes out as U+FFFD.
  JsonWriter& string(std::string_view value);
  template <std::integral Integer>
  JsonWriter& integer_or_null(const std::optional<Integer>& value) {
    return value ? integer(*value) : null();
  }
  JsonWriter& string_or_null(const std::optional<std::string>& value) {
    return value ? string(*value) : null();
  }
  // One JSON value as it is.
  JsonWriter& raw(std::string_view json);

  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  [[nodiscard]] const std::string& text() const& { return text_; }
  [[nodiscard]] std::string text() && { return std::move(text_); }

 private:
  template <class Real>
  JsonWriter& shortest(Real value);
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  void separate();

  std::string text_;
  bool comma_due_ = false;  // the next key or value follows another one
};

}  // namespace poolhall::protocol
