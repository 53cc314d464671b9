// The page itself, clients/web, compiled into the program.
//
//   if (auto file = static_file("/main.js")) send(*file);
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "server/web/page.hpp"

namespace poolhall::web {

struct EmbeddedFile {
  std::string_view path;  // "/main.js"
  std::string_view text;
};
// Made from clients/web by cmake/PoolhallEmbed.cmake.
[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

// "/" is the page; nothing if there is no such file.
[[nodiscard]] std::optional<Page> static_file(std::string_view path);

}  // namespace poolhall::web
