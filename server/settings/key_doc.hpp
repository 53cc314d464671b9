// A key of a settings file as its documentation shows it.
#pragma once

#include <optional>
#include <string>

namespace poolhall::settings {

struct KeyDoc {
  std::string name;                            // "clock.game_seconds"
  std::string expected;                        // what its values may be
  std::optional<std::string> default_value{};  // as TOML; none: unset, or must be given
};

}  // namespace poolhall::settings
