#include "server/settings/document.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace poolhall::settings {
namespace {

Position position(const toml::source_region& region) {
  return {region.begin.line, region.begin.column};
}

Node convert(const toml::node& node);

Table convert_table(const toml::table& table) {
  Table members;
  for (const auto& [key, value] : table) {
    members.push_back({std::string(key.str()), position(key.source()), convert(value)});
  }
  // toml++ orders by name; a reader of errors wants the first one in the file.
  std::stable_sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return std::pair(a.key_at.line, a.key_at.column) < std::pair(b.key_at.line, b.key_at.column);
  });
  return members;
}

Array convert_array(const toml::array& array) {
  Array elements;
  for (const toml::node& element : array) {
    elements.push_back(convert(element));
  }
  return elements;
}

Node convert(const toml::node& node) {
  Node result{position(node.source()), DateOrTime{}};
  if (const auto* table = node.as_table()) {
    result.value = convert_table(*table);
  } else if (const auto* array = node.as_array()) {
    result.value = convert_array(*array);
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* whole = node.as_integer()) {
    result.value = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.value = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    result.value = flag->get();
  }
  return result;
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

std::string text(const SettingsError& error) {
  if (error.line == 0) {
    return fmt::format("{}: {}", error.file, error.reason);
  }
  return fmt::format("{}:{}:{}: {}", error.file, error.line, error.column, error.reason);
}

const Node* Node::find(std::string_view key) const {
  const auto* table = std::get_if<Table>(&value);
  if (table == nullptr) {
    return nullptr;
  }
  const auto found =
      std::find_if(table->begin(), table->end(), [&](const Member& m) { return m.key == key; });
  return found == table->end() ? nullptr : &found->node;
}

std::string describe(const Node& node) {
  return std::visit(Overloaded{
                        [](const Table&) { return std::string("a table"); },
                        [](const Array&) { return std::string("an array"); },
                        [](const std::string& s) {
                          return s.size() <= 60 ? fmt::format("the string \"{}\"", s)
                                                : fmt::format("a string of {} bytes", s.size());
                        },
                        [](std::int64_t i) { return fmt::format("the whole number {}", i); },
                        [](double d) { return fmt::format("the number {}", d); },
                        [](bool b) { return std::string(b ? "true" : "false"); },
                        [](const DateOrTime&) { return std::string("a date or time"); },
                    },
                    node.value);
}

Expected<Node> parse_document(std::string_view source, const std::string& file) {
  try {
    const toml::table root = toml::parse(source, file);
    return Node{{1, 1}, convert_table(root)};
  } catch (const toml::parse_error& error) {
    const Position at = position(error.source());
    return tl::unexpected(
        SettingsError{file, at.line, at.column, fmt::format("not TOML: {}", error.description())});
  }
}

}  // namespace poolhall::settings
