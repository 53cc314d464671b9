#include "server/settings/keys.hpp"

#include <fmt/format.h>

namespace poolhall::settings::detail {

SettingsError wrong_value(const std::string& file, const Node& node, const std::string& key,
                          const std::string& expected) {
  return {file, node.at.line, node.at.column,
          fmt::format("{}: {} came, expected {}", key, describe(node), expected)};
}

SettingsError unknown_key(const std::string& file, const Member& member, const std::string& key,
                          const std::vector<std::string>& known) {
  const auto suggestion = nearest(key, known);
  return {file, member.key_at.line, member.key_at.column,
          suggestion ? fmt::format("unknown key \"{}\"; did you mean \"{}\"?", key, *suggestion)
                     : fmt::format("unknown key \"{}\"; expected a key of config/README.md", key)};
}

}  // namespace poolhall::settings::detail
