// What a command reads: a file, or - for the standard input. A folder too can be opened, and only
// reading it fails.
//
//   std::ifstream file;
//   const auto text = text_of(input_of(source, file));
//   if (!text) return cannot_read(source, "a scene file");
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace poolhall::app {

// The standard input for -, else `file`, opened.
[[nodiscard]] std::istream& input_of(const std::string& source, std::ifstream& file);

// All of it; nothing if it cannot be read to its end.
[[nodiscard]] std::optional<std::string> text_of(std::istream& in);

// Says so on the standard error; returns the exit code for it.
[[nodiscard]] int cannot_read(const std::string& source, std::string_view expected);

}  // namespace poolhall::app
