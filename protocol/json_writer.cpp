#include "protocol/json_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace poolhall::protocol {
namespace {

bool is_plain(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
}

template <class Number>
void append(std::string& text, Number value) {
  // The longest shortest double has 24, long double 30.
  std::array<char, 64> digits;  // NOLINT(*-member-init): to_chars writes what is read
  const auto [end, failure] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  static_cast<void>(failure);
  text.append(digits.data(), end);
}

}  // namespace

JsonWriter& JsonWriter::key(std::string_view name) {
  string(name);
  text_ += ':';
  comma_due_ = false;
  return *this;
}

JsonWriter& JsonWriter::integer(std::int64_t value) {
  separate();
  append(text_, value);
  return *this;
}

JsonWriter& JsonWriter::integer(std::uint64_t value) {
  separate();
  append(text_, value);
  return *this;
}

template <class Real>
JsonWriter& JsonWriter::shortest(Real value) {
  if (!std::isfinite(value)) {
    return null();
  }
  separate();
  // Readers take "-0" for an integer, which has no sign to keep.
  if (value == 0 && std::signbit(value)) {
    text_ += "-0.0";
  } else {
    append(text_, value);
  }
  return *this;
}

JsonWriter& JsonWriter::number(double value) {
  return shortest(value);
}

JsonWriter& JsonWriter::number(long double value) {
  return shortest(value);
}

JsonWriter& JsonWriter::string(std::string_view value) {
  separate();
  if (is_plain(value)) {
    text_ += '"';
    text_ += value;
    text_ += '"';
  } else {
    text_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

JsonWriter& JsonWriter::open(char bracket) {
  separate();
  text_ += bracket;
  comma_due_ = false;
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  text_ += bracket;
  comma_due_ = true;
  return *this;
}

void JsonWriter::separate() {
  if (comma_due_) {
    text_ += ',';
  }
  comma_due_ = true;
}

}  // namespace poolhall::protocol
