#include "server/app/input.hpp"

#include <array>
#include <fstream>
#include <iostream>

#include "server/app/exit_codes.hpp"

namespace poolhall::app {

std::istream& input_of(const std::string& source, std::ifstream& file) {
  if (source == "-") {
    // Synchronized, it takes what cannot be read for an empty file.
    std::ios::sync_with_stdio(false);
    return std::cin;
  }
  file.open(source, std::ios::binary);
  return file;
}

std::optional<std::string> text_of(std::istream& in) {
  std::string text;
  std::array<char, 65536> part{};
  while (in) {
    // Unlike std::istreambuf_iterator, notes errors and does not throw them.
    in.read(part.data(), static_cast<std::streamsize>(part.size()));
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  }
  return in.eof() && !in.bad() ? std::optional(std::move(text)) : std::nullopt;
}

int cannot_read(const std::string& source, std::string_view expected) {
  std::cerr << source << ": cannot be read, expected " << expected << " or -\n";
  return wrong_input;
}

}  // namespace poolhall::app
