// Settings files, before anybody looks into them.
#pragma once

#include <string>

#include "server/settings/settings_error.hpp"

namespace poolhall::settings {

// The text of a file, at most 1 MiB.
[[nodiscard]] Expected<std::string> read_file(const std::string& file);

}  // namespace poolhall::settings
