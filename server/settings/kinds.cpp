#include "server/settings/kinds.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "protocol/messages.hpp"

namespace poolhall::settings {
namespace {

std::optional<double> number(const Node& node, double lowest, double highest) {
  double value = 0;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*whole);
  } else if (const auto* real = std::get_if<double>(&node.value)) {
    value = *real;
  } else {
    return std::nullopt;
  }
  // Written so that NaN fails.
  if (!(value >= lowest && value <= highest)) {
    return std::nullopt;
  }
  return value;
}

std::string quoted(std::string_view value) {
  std::string escaped;
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      escaped += '\\';
    }
    escaped += c;
  }
  return fmt::format("\"{}\"", escaped);
}

bool is_port(std::string_view value) {
  unsigned port = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), port);
  return error == std::errc{} && end == value.data() + value.size() && port <= 65535;
}

bool is_host_port(std::string_view value) {
  const auto colon = value.rfind(':');
  if (colon == std::string_view::npos || !is_port(value.substr(colon + 1))) {
    return false;
  }
  const std::string_view host = value.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    return true;
  }
  return !host.empty() && host.find_first_of(":[] \t") == std::string_view::npos;
}

std::string choices_text(const std::vector<std::string>& choices) {
  std::vector<std::string> words;
  std::transform(choices.begin(), choices.end(), std::back_inserter(words), quoted);
  return fmt::format("{}", fmt::join(words, ", "));
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Levenshtein 1966: insertions, deletions and substitutions from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t substituted = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string WholeNumber::expected() const {
  return fmt::format("a whole number from {} to {}", lowest, highest);
}
std::optional<std::int64_t> WholeNumber::read(const Node& node) const {
  const auto* value = std::get_if<std::int64_t>(&node.value);
  if (value == nullptr || *value < lowest || *value > highest) {
    return std::nullopt;
  }
  return *value;
}
std::string WholeNumber::write(Value value) {
  return fmt::format("{}", value);
}

template <class Unit>
std::string Quantity<Unit>::expected() const {
  return fmt::format("{} from {} to {}", Unit::words, lowest, highest);
}
template <class Unit>
std::optional<typename Unit::Value> Quantity<Unit>::read(const Node& node) const {
  const auto value = number(node, lowest, highest);
  return value ? std::optional(Unit::from_file(*value)) : std::nullopt;
}
template <class Unit>
std::string Quantity<Unit>::write(Value value) {
  return fmt::format("{}", Unit::to_file(value));
}
template struct Quantity<PlainUnit>;
template struct Quantity<SecondsUnit>;
template struct Quantity<MillimetresUnit>;

std::optional<bool> Flag::read(const Node& node) {
  const auto* value = std::get_if<bool>(&node.value);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::string Line::expected() const {
  return what;
}
std::optional<std::string> Line::read(const Node& node) const {
  const auto* value = std::get_if<std::string>(&node.value);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (value == nullptr || value->empty() || value->size() > longest ||
      std::any_of(value->begin(), value->end(), is_control)) {
    return std::nullopt;
  }
  return *value;
}
std::string Line::write(const Value& value) {
  return quoted(value);
}

std::string Name::expected() {
  return "a name of 1 to 32 characters of A-Z a-z 0-9 . _ -";
}
std::optional<std::string> Name::read(const Node& node) {
  const auto* value = std::get_if<std::string>(&node.value);
  return value != nullptr && protocol::is_agent_name(*value, {}) ? std::optional(*value)
                                                                 : std::nullopt;
}
std::string Name::write(const Value& value) {
  return quoted(value);
}

std::string HostPort::expected() {
  return "\"HOST:PORT\" with a port from 0 to 65535, such as \"127.0.0.1:7777\" or \"[::1]:7777\"";
}
std::optional<std::string> HostPort::read(const Node& node) {
  const auto* value = std::get_if<std::string>(&node.value);
  return value != nullptr && is_host_port(*value) ? std::optional(*value) : std::nullopt;
}
std::string HostPort::write(const Value& value) {
  return quoted(value);
}

std::string OneOf::expected() const {
  return choices.size() == 1 ? choices_text(choices)
                             : fmt::format("one of {}", choices_text(choices));
}
std::optional<std::string> OneOf::read(const Node& node) const {
  const auto* value = std::get_if<std::string>(&node.value);
  return value != nullptr && contains(choices, *value) ? std::optional(*value) : std::nullopt;
}
std::string OneOf::write(const Value& value) {
  return quoted(value);
}

std::string Preset::expected_now() const {
  return fmt::format("{}: {}", what, choices_text(names));
}
std::optional<std::string> Preset::read(const Node& node) const {
  return OneOf{names}.read(node);
}
std::string Preset::write(const Value& value) {
  return quoted(value);
}

std::string SomeOf::expected() const {
  return fmt::format("an array, each at most once, of {}", choices_text(choices));
}
std::optional<std::vector<std::string>> SomeOf::read(const Node& node) const {
  const auto* elements = std::get_if<Array>(&node.value);
  if (elements == nullptr) {
    return std::nullopt;
  }
  Value chosen;
  for (const Node& element : *elements) {
    const auto* word = std::get_if<std::string>(&element.value);
    if (word == nullptr || !contains(choices, *word) || contains(chosen, *word)) {
      return std::nullopt;
    }
    chosen.push_back(*word);
  }
  return chosen;
}
std::string SomeOf::write(const Value& value) {
  return fmt::format("[{}]", choices_text(value));
}

std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    // A shared beginning or end ("games" for "games_per_match") counts as close.
    const bool part = word.size() >= 4 && candidate.find(word) != std::string::npos;
    const std::size_t distance = part ? 1 : edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace poolhall::settings
